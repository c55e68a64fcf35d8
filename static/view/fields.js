// @ts-check
// The fields of the View as the server declares them (app/view.py), and what the page derives from them.
import { VIEW } from "../declared.js";

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Field} Field */
/** @typedef {Partial<View>} Patch */
/** A View or a patch of one, by the names of its fields. @typedef {Record<string, any>} Named */

/** The fields that a follower keeps for itself. */
export const OWN = new Set(VIEW.filter(({ mirrored }) => !mirrored).map(({ name }) => name));

/** @param {string} name */
export function fieldOf(name) {
  const field = VIEW.find((each) => each.name === name);
  if (!field) throw new Error(`the View has no ${name}`);
  return field;
}

/** The score that a mode begins with. @param {View["mode"]} mode @returns {View["score"]} */
export const usualScore = (mode) => (mode === "inspect" ? "suspicion" : fieldOf("score").default);

/** The default View. @param {Field[]} [fields] @returns {View} */
export function freshView(fields = VIEW) {
  const fresh = Object.fromEntries(fields.map(({ name, default: value }) => [name, structuredClone(value)]));
  return /** @type {any} */ (fresh);
}

/** Whether a patch may name only some of its entries. @param {Field} field */
export const isPartial = ({ written }) => ["thresholds", "numbers", "switches", "reading"].includes(written);

/** The fields that this change resets. @param {Named} before @param {Named} after @param {Field[]} [fields] */
export function resets(before, after, fields = VIEW) {
  const changed = (/** @type {string} */ name) => after[name] !== undefined && after[name] !== before[name];
  return fields.filter(({ resetBy }) => resetBy.some(changed));
}

/**
 * `after` on top of `before`: partial fields are merged, and fields that are reset are left out unless `after` has them.
 * @template {Patch} T
 * @param {T} before
 * @param {Patch} after
 * @param {Field[]} [fields]
 * @returns {T}
 */
export function merged(before, after, fields = VIEW) {
  /** @type {Named} */
  const base = { ...before };
  for (const { name } of resets(before, after, fields)) delete base[name];
  return /** @type {T} */ (overlaid(base, after, fields));
}

/** `after` on top of `before`, without resetting any field. @param {Named} before @param {Named} after @param {Field[]} [fields] */
export function overlaid(before, after, fields = VIEW) {
  const result = { ...before, ...after };
  for (const { name } of fields.filter(isPartial))
    if (before[name] && after[name]) result[name] = { ...before[name], ...after[name] };
  return result;
}
