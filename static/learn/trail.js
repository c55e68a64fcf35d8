// @ts-check
// Every fit of a growing line up to a decision.
import { stretch } from "./geometry.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {[[number, number], [number, number]]} Part */

// More than some hundred could not be distinguished.
const MOST = 120;

/** @param {Trace} trace @param {Event} event @returns {{lines: Part[]} | null} null where no line grows */
export function trailOf(trace, { index, phase, kind, candidate }) {
  if (phase !== "growth" && kind !== "seed found") return null;
  /** @type {Part[]} */
  const lines = [];
  for (let k = index; k >= 0 && trace.columns.candidate[k] === candidate; k--) {
    const part = fitOf(trace, trace.at(k));
    if (part) lines.push(longer(part));
  }
  const every = Math.ceil(lines.length / MOST);
  return { lines: lines.filter((_, k) => k % every === 0) };
}

/** @param {Trace} trace @param {Event} event @returns {Part | null} */
function fitOf(trace, { kind, first, last, line }) {
  if (!line || (kind !== "seed found" && kind !== "point added")) return null;
  return stretch(trace, trace.span(first, last), line);
}

/** The segment, extended at both ends so that its direction is visible. @param {Part} part @returns {Part} */
function longer([[x1, y1], [x2, y2]]) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const reach = Math.max(0.25 * length, 0.2) / length;
  return [
    [x1 - reach * (x2 - x1), y1 - reach * (y2 - y1)],
    [x2 + reach * (x2 - x1), y2 + reach * (y2 - y1)],
  ];
}
