// @ts-check
// The values that may be typed for a threshold.

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {typeof import("../text/page.js").pageText.tune} Text */

/** Why a typed value is not allowed, or null. @param {Knob} knob @param {string} typed @param {Text} text */
export function refused(knob, typed, text) {
  const value = typed === "" ? NaN : Number(typed);
  const range = allowedRange(knob, text);
  if (Number.isNaN(value)) return `${text.notANumber(typed)} ${text.allowed(range, "")}`;
  if (knob.kind === "int" && !Number.isInteger(value)) return `${text.notWhole} ${text.allowed(range, "")}`;
  if (value < knob.least || value > (knob.most ?? Infinity)) return text.allowed(range, knob.why);
  return null;
}

/** @param {Knob} knob @param {Text} text */
export function allowedRange(knob, text) {
  const least = String(knob.least);
  return text.range(least, knob.most === null ? null : String(Number(knob.most.toPrecision(4))), knob.unit);
}
