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
  notePlaceholder: "What is wrong in this frame, what it shows",
  lines: "True lines",
  list: "True lines of this frame",
  undo: "Undo (Ctrl+Z)",
  redo: "Redo (Ctrl+Shift+Z)",
  draw: "New",
  drawHelp: "Press on one point of the scan and release on another (A)",
  drawing: "Press on the first point of the line, release on its last. Esc ends this.",
  split: "Split",
  splitHelp: "Cut the chosen line in two at its middle handle (S)",
  merge: "Merge",
  mergeHelp: "Join the chosen line with the next one (M), with the one before (Shift+M)",
  remove: "Delete",
  removeHelp: "Delete the chosen line (Del)",
  hint: "Drag the ends of a line along the beams; arrow keys move the handle in use, ten beams with Shift.",
  proposed: (/** @type {number} */ n) =>
    `Nobody has said which lines are true here. Shown are the ${counted(n, "line", "lines")} of the present result; the first edit keeps them.`,
  accept: "They are right",
  acceptHelp: "Keep the lines of the present result as the true ones",
  forget: "Forget",
  forgetHelp: "Nobody has said then which lines are true in this frame; it no longer counts",
  restart: "From result",
  restartHelp: "Begin again with the lines of the present result",
  plan: "Lines are shown and edited in the view from above (V).",
  none: "There is no line in this frame.",
  choose: "Choose a line first.",
  tooShort: "A line needs two points or more.",
  alone: "There is no neighbour to merge with.",
  row: (/** @type {number} */ n, /** @type {string} */ beams, /** @type {string} */ length) =>
    `Line ${n}, beams ${beams}, ${length}`,
  columns: { number: "", beams: "beams", points: "points", length: "length" },
  m: (/** @type {number} */ value) => `${value.toFixed(2)} m`,
  handle: {
    line: (/** @type {number} */ n) => `True line ${n}`,
    first: (/** @type {number} */ beam) => `First beam, ${beam}`,
    last: (/** @type {number} */ beam) => `Last beam, ${beam}`,
    cut: (/** @type {number} */ beam) => `Place to split, beam ${beam}`,
  },
  status: {
    saved: (/** @type {string} */ place) => `Saved to ${place}`,
    nothing: (/** @type {string} */ place) => `Every edit is saved at once, to ${place}`,
    apart: (/** @type {string} */ file) => `your data folder, as ${file}`,
    saving: "Saving…",
    away: "Not saved: the server does not answer. It is tried again until it does; leave this page open.",
    refused: (/** @type {string} */ why) => `Not saved: ${why}`,
    retry: "Try again",
    conflict: (/** @type {number} */ frame) =>
      `Frame ${frame} was changed in another tab at the same time. This is what it says; your edit was not saved.`,
    mine: "Save mine instead",
    live: "A live recording cannot be labelled, because its frames come and go. Save it as a file, and open that.",
    trouble: (/** @type {string} */ why) => `${why} Nothing is saved until then, and the file stays as it is.`,
  },
  open: "Labels (E)",
  keys: { open: "label true lines, tag, note", edit: "in Labels: new line, split, merge, delete" },
};
