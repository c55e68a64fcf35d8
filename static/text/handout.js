// @ts-check
// Words of the pages that stand alone.

export const handoutText = {
  notHere: "This needs the running program: open the lesson in lineseg.",
  opening: "Opening…",
  tooOld: "This browser is too old to open this page. It needs Chrome 80, Firefox 113, Safari 16.4 or newer.",
  broken: "This file is damaged: a part of it is missing. Save or download it again.",
  frame: (/** @type {string} */ label, /** @type {number} */ frame) => `${label}, frame ${frame.toLocaleString("en")}`,
  restart: "Start again",
  index: "All lessons",
  save: "Save my progress",
  missing: (/** @type {string} */ id) => `The lesson “${id}” is not in this file.`,
  zoomIn: "Zoom in",
  zoomOut: "Zoom out",
  fit: "Show the whole frame (F)",
  why: "Why",
  close: "Close",
  ranges: "Thresholds",
  rangesHint:
    "Move one threshold; the others stay as they were. Of values between two stored ones, the nearest is shown.",
  resultOnly: (/** @type {number} */ lines) =>
    `The result: ${lines} ${lines === 1 ? "line" : "lines"}. You can step through the decisions of the original thresholds only.`,
  back: "Back to the original thresholds",
  keys: {
    step: "one decision back, forward",
    ends: "first, last decision",
    play: "play or pause",
    jumps: "next seed, line, drop",
    learnJumps: "next refusal, merge, cut",
    closeUp: "show decisions from near by, or the whole frame",
    answer: "answer a prediction",
    fit: "show the whole frame",
    escape: "deselect, leave the steps",
    help: "this help",
  },
  mouse: [
    ["Drag", "move the plan"],
    ["Wheel, two fingers", "zoom in or out"],
    ["Click a point", "why it is, or is not, in a line"],
  ],
};
