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

/**
 * The knob with a slider that reaches these values: an end that is too near moves to the next round number. The same
 * object if it reaches them already.
 * @param {Knob} knob
 * @param {...number} values
 * @returns {Knob}
 */
export function reaching(knob, ...values) {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  if (least >= knob.low && most <= knob.high) return knob;
  const low = Math.max(...roundNumbers(least).filter((each) => each <= least));
  const high = Math.min(...roundNumbers(most).filter((each) => each >= most));
  return {
    ...knob,
    low: least < knob.low ? Math.max(low, knob.least) : knob.low,
    high: most > knob.high ? Math.min(high, knob.most ?? Infinity) : knob.high,
  };
}

/** On each side of a value: 1, 2 or 5 times a power of ten. @param {number} value */
function roundNumbers(value) {
  if (value <= 0) return [value];
  const power = Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => Number(`${step}e${power}`));
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
