// @ts-check
// The values of the pseudocode's variables at a decision, and what its highlighted line compares.

import { num } from "./mathml.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("../wire.js").Knob} Knob */

/** @param {Event} event @returns {[string, string][]} */
export function variables(event) {
  const { phase, first, last, beam, points, kind, line } = event;
  const normal = line
    ? /** @type {[string, string][]} */ ([["(a, b, c)", `(${line.map((v) => num(v)).join(", ")})`]])
    : [];
  if (phase === "seed") {
    const at = beam >= 0 ? /** @type {[string, string][]} */ ([["k", String(beam)]]) : [];
    return [["i", String(first)], ["j", String(last)], ...at, ...normal];
  }
  if (phase === "growth") {
    const next = beam >= 0 ? /** @type {[string, string][]} */ ([["n", String(beam)]]) : [];
    return [["P_b", String(first)], ["P_f", String(last)], ...next, ["P_l", String(points)], ...normal];
  }
  if (kind === "overlap cut") return [["k", String(beam)], ["first line", `${first}–${last}`], ...normal];
  return [["beams", `${first}–${last}`], ["P_l", String(points)], ...normal];
}

/** @param {Event} event @param {Knob[]} knobs */
export function compared(event, knobs) {
  const { kind, check, value, limit } = event;
  if (check === "merge_angle") return `${degrees(value)} ${value < limit ? "<" : "≥"} ${degrees(limit)}`;
  if (kind === "overlap cut") return `${number(value)} ${value < limit ? "<" : "≥"} ${number(limit)} m`;
  if (kind === "line kept") return `${number(value)} ≥ ${number(limit)} m`;
  if (kind === "endpoints") return `${number(value)} m long`;
  if (check === "" || check === "end" || check === "nearer") return "";
  const sign = value < limit ? "<" : value > limit ? ">" : "=";
  const unit = knobs.find(({ name }) => name === check)?.unit ?? "";
  return `${number(value)} ${sign} ${number(limit)} ${unit}`.trim();
}

/** @param {number} value */
export function number(value) {
  if (!Number.isFinite(value)) return "∞";
  return Number.isInteger(value) ? String(value) : value.toFixed(3);
}

/** @param {number} radians */
export function degrees(radians) {
  return `${((radians * 180) / Math.PI).toFixed(1)}°`;
}
