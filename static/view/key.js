// @ts-check
// Comparisons of parts of a View.

/**
 * Key of results: a text that is equal if these parts of two Views are equal; the order of thresholds
 * does not matter.
 * @template {string} Name
 * @param {Record<Name, any>} view
 * @param {...Name} names
 */
export function keyOf(view, ...names) {
  return JSON.stringify(names.map((name) => (name === "params" ? Object.entries(view[name]).sort() : view[name])));
}

/**
 * Whether `all` has every entry of `some`: thresholds, or switches.
 * @template {Record<string, unknown>} T
 * @param {T} some
 * @param {T} all
 */
export function isIn(some, all) {
  return Object.entries(some).every(([name, value]) => all[name] === value);
}
