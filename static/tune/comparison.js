// @ts-check

/** @typedef {import("../wire.js").Knob} Knob */

/**
 * The value and limit that a decision compared; null if it compared nothing.
 * @param {{check: string, value: number | null, limit: number | null}} decision
 * @param {Knob[]} knobs
 */
export function comparison({ check, value, limit }, knobs) {
  if (value === null || limit === null) return null;
  const knob = knobs.find(({ name }) => name === check);
  if (!knob && check !== "nearer") return null;
  return { value, limit, symbol: knob?.symbol ?? "", unit: knob?.unit ?? "m", least: knob?.floor ?? false };
}
