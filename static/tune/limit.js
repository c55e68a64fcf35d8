// @ts-check
// How far from its line a threshold allows a point to lie.

/** @typedef {import("../wire.js").Params} Params */

/**
 * The limit [m] for a point at a range [m].
 * @param {string} name of the threshold
 * @param {Params} params
 * @param {number} range
 */
export function limitAt(name, params, range) {
  // The limit of every method is the same at any range so far.
  return range < 0 ? 0 : params[name];
}
