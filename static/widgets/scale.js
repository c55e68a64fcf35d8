// @ts-check
// Converts between the value of a threshold, its place on a slider (0 to 1) and its text.

/** @typedef {import("../wire.js").Knob} Knob */

/** @param {number} value @param {number} low @param {number} high */
export function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/**
 * Place of a value between low and high, on the scale of a slider.
 * @param {{low: number, high: number, log: boolean}} range
 * @param {number} value
 */
export function placeOf({ low, high, log }, value) {
  if (high <= low) return 0;
  const place = log ? Math.log(Math.max(value, 1e-12) / low) / Math.log(high / low) : (value - low) / (high - low);
  return clamp(place, 0, 1);
}

/**
 * The value at a place, on the slider's steps.
 * @param {Knob} knob
 * @param {number} place
 */
export function valueAt(knob, place) {
  const { low, high, log } = knob;
  return snap(knob, log ? low * (high / low) ** place : low + place * (high - low));
}

/**
 * The nearest step within the slider's range.
 * @param {Knob} knob
 * @param {number} value
 */
export function snap(knob, value) {
  const stepped = Math.round(value / knob.step) * knob.step;
  return clamp(Number(stepped.toFixed(decimals(knob) + 2)), knob.low, knob.high);
}

/** @param {Knob} knob */
function decimals(knob) {
  return knob.kind === "int" ? 0 : Math.max(0, Math.ceil(-Math.log10(knob.step) - 1e-9));
}

/**
 * A value as text: with the digits of the step, and with more only if more were typed.
 * @param {Knob} knob
 * @param {number} value
 */
export function format(knob, value) {
  const short = value.toFixed(decimals(knob));
  return Math.abs(Number(short) - value) < 1e-9 * Math.max(1, Math.abs(value))
    ? short
    : String(Number(value.toPrecision(6)));
}

/** @param {Knob} knob @param {number} value */
export function withUnit(knob, value) {
  return knob.unit ? `${format(knob, value)} ${knob.unit}` : format(knob, value);
}
