// @ts-check
// Words for how a file is read: the line in the menu, what was noticed, the panel.

export const readingText = {
  change: "Change…",
  readAs: "Read as…",
  title: (/** @type {string} */ file) => `Read ${file} as…`,
  close: "Close without a change (Esc)",
  groups: /** @type {Record<string, string>} */ ({
    numbers: "What the numbers are",
    "left out": "What to leave out",
    scans: "Which scans",
  }),
  found: (/** @type {string} */ value) => `as found: ${value}`,
  unset: "as the file says",
  degrees: "In radians; a number with ° is taken as degrees.",
  usual: "Reset",
  usualHelp: "Read the file as it says, with guesses for what it does not say",
  cancel: "Cancel",
  apply: "Apply",
  reading: "Reading…",
  beginning: "The beginning of the file is shown; all of it is read when you apply.",
  points: (/** @type {number} */ n) => (n === 1 ? "The first scan from above" : `The first ${n} scans from above`),
  firstLines: "The first lines of the file",
  noPoints: "No beam has a return.",
  guessedValue: (/** @type {string} */ field, /** @type {string} */ value) =>
    field === "columns" ? `columns ${value.replaceAll(",", " ")}` : value,
  guess: (/** @type {string} */ value, /** @type {string} */ why) => `A guess: ${value} (${why}).`,
  guessed: (/** @type {string} */ guesses) => `Guessed, because the file does not say it: ${guesses}.`,
  set: (/** @type {string} */ change) => `Set ${change}`,
  dismiss: "Dismiss",
  takenFor: "What this file was taken for",
};
