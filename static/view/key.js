// @ts-check

/**
 * What results belong to: those parts of a View, as words that are equal where all of them are; of thresholds the order
 * does not matter.
 * @template {string} Name
 * @param {Record<Name, any>} view
 * @param {...Name} names
 */
export function keyOf(view, ...names) {
  return JSON.stringify(names.map((name) => (name === "params" ? Object.entries(view[name]).sort() : view[name])));
}
