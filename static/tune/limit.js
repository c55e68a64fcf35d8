// @ts-check
// How far from its line a threshold allows a point to lie.

/** @typedef {import("../wire.js").Params} Params */

/**
 * The limit [m] for a point at a range [m]; that of ε grows with the range if κ is set.
 * @param {string} name of the threshold
 * @param {Params} params
 * @param {number} range
 */
export function limitAt(name, params, range) {
  const growth = name === "epsilon" ? (params.epsilon_growth ?? 0) : 0;
  return Math.hypot(params[name], growth * range);
}
