// @ts-check

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
