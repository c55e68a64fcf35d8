// @ts-check

/** @typedef {import("../wire.js").Knob} Knob */

/**
 * The value and limit that a decision compared; null if it compared nothing.
 * @param {{kind?: string, check: string, value: number | null, limit: number | null}} decision
 * @param {Knob[]} knobs
 */
export function comparison({ kind, check, value, limit }, knobs) {
  if (value === null || limit === null || !Number.isFinite(value + limit)) return null;
  const name = kind === "line kept" ? "min_length" : check;
  const knob = knobs.find((each) => each.name === name);
  if (!knob && check !== "nearer") return null;
  return { value, limit, symbol: knob?.symbol ?? "", unit: knob?.unit ?? "m", least: knob?.floor ?? false };
}
