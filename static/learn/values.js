// @ts-check
// The values of the pseudocode's variables at a decision, and what its highlighted line compares.

import { num } from "./mathml.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */

const SYMBOL = /** @type {Record<string, string>} */ ({
  epsilon: "ε",
  delta: "δ",
  min_points: "P_min",
  min_length: "L_min",
  max_dropout: "D_max",
  max_gap: "G_max",
  max_void: "V_max",
});

const LEAST = new Set(["min_points", "min_length"]);
const WITHOUT_BAR = new Set(["lines merged", "lines kept apart", "overlap cut", "endpoints"]);

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

/** @param {Event} event */
export function compared(event) {
  const { kind, check, value, limit } = event;
  if (check === "merge_angle") return `${degrees(value)} ${value < limit ? "<" : "≥"} ${degrees(limit)}`;
  if (kind === "overlap cut") return `${number(value)} ${value < limit ? "<" : "≥"} ${number(limit)} m`;
  if (kind === "line kept") return `${number(value)} ≥ ${number(limit)} m`;
  if (kind === "endpoints") return `${number(value)} m long`;
  if (check === "" || check === "end" || check === "nearer") return "";
  const sign = value < limit ? "<" : value > limit ? ">" : "=";
  const unit = check === "min_points" || check === "max_dropout" ? "" : " m";
  return `${number(value)} ${sign} ${number(limit)}${unit}`;
}

/** @param {string} check */
export function symbolOf(check) {
  return SYMBOL[check] ?? "";
}

/** The value and limit that a decision compared; null if its sentence is enough. @param {Event} event */
export function comparedOf({ kind, check: refused, value, limit }) {
  if (WITHOUT_BAR.has(kind)) return null;
  const check = kind === "line kept" ? "min_length" : refused;
  if (!symbolOf(check)) return null;
  const unit = check === "min_points" || check === "max_dropout" ? "" : "m";
  return { value, limit, symbol: symbolOf(check).replace("_", " "), unit, least: LEAST.has(check) };
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
