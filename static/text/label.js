// @ts-check
// Words of the labels: true lines, tags, notes.

/** @param {number} n @param {string} one @param {string} many */
const counted = (n, one, many) => `${n.toLocaleString("en")} ${n === 1 ? one : many}`;

export const labelText = {
  tab: "Labels",
  tags: "Tags",
  addTag: "Add a tag",
  removeTag: (/** @type {string} */ tag) => `Remove the tag ${tag}`,
  note: "Note",
  notePlaceholder: "What this frame shows, or what is wrong in it",
  lines: "True lines",
  list: "True lines of this frame",
  undo: "Undo (Ctrl+Z)",
  redo: "Redo (Ctrl+Shift+Z)",
  draw: "New",
  drawHelp: "Draw a line: press on its first point and release on its last (A)",
  drawing: "Press on the first point of the line and release on its last. Esc cancels.",
  split: "Split",
  splitHelp: "Cut the selected line in two at its middle handle (S)",
  merge: "Merge",
  mergeHelp: "Join the selected line with the next one (M) or the previous one (Shift+M)",
  remove: "Delete",
  removeHelp: "Delete the selected line (Del)",
  hint: "Drag the ends of a line along the beams. Arrow keys move the active handle by one beam, with Shift by ten.",
  proposed: (/** @type {number} */ n) =>
    `This frame has no labelled lines yet. Shown: the ${counted(n, "line", "lines")} of the current result. Your first edit saves them as true lines.`,
  accept: "They are right",
  acceptHelp: "Save the lines of the current result as the true lines",
  forget: "Forget",
  forgetHelp: "Remove the true lines of this frame. It then no longer counts in Truth.",
  restart: "From result",
  restartHelp: "Start over with the lines of the current result",
  plan: "Go back to the plan view (V) to see and edit the lines.",
  none: "This frame has no true line. Draw one with New (A).",
  choose: "Select a line first.",
  tooShort: "Each line needs at least two points. Choose another place.",
  alone: "There is no neighbouring line to merge with.",
  row: (/** @type {number} */ n, /** @type {string} */ beams, /** @type {string} */ length) =>
    `Line ${n}, beams ${beams}, ${length}`,
  columns: { number: "", beams: "beams", points: "points", length: "length" },
  m: (/** @type {number} */ value) => `${value.toFixed(2)} m`,
  handle: {
    line: (/** @type {number} */ n) => `True line ${n}`,
    first: (/** @type {number} */ beam) => `First beam, ${beam}`,
    last: (/** @type {number} */ beam) => `Last beam, ${beam}`,
    cut: (/** @type {number} */ beam) => `Where to split, beam ${beam}`,
  },
  status: {
    saved: (/** @type {string} */ place) => `Saved to ${place}`,
    nothing: (/** @type {string} */ place) => `Every edit is saved at once to ${place}`,
    apart: (/** @type {string} */ file) => `your data folder, as ${file}`,
    saving: "Saving…",
    away: "Not saved: the server does not answer. Keep this page open; it tries again until the server answers.",
    refused: (/** @type {string} */ why) => `Not saved: ${why}`,
    retry: "Try again",
    conflict: (/** @type {number} */ frame) =>
      `Another tab changed frame ${frame} at the same time. You see its version; yours was not saved.`,
    mine: "Save mine instead",
    live: "A live recording cannot be labelled, because old frames are dropped. Save it as a file and open the file.",
    trouble: (/** @type {string} */ why) => `${why} Nothing is saved until then, and the file stays as it is.`,
  },
  open: "Labels (E)",
  keys: { open: "mark true lines, add tags and a note", edit: "in Labels: new line, split, merge, delete" },
};
