// @ts-check
// The View as a readable link, and back: how each kind of field is written. Defaults are left out.
import { usualScore } from "./fields.js";

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Field} Field */
/** @typedef {import("./fields.js").Named} Named */
/** The middle of the plan and how high it is [m]. @typedef {{x: number, y: number, span: number}} Look */
/** What a link says besides the View. name: of the file, where its id does not tell; look: at what of the plan, where it is not all. @typedef {{name: string, look: Look | null}} Aside */

// The server accepts no message that is much longer.
const LONGEST = 25_000;
const FARTHEST = 1e6;
const EACH = "*";
const ASIDE = new Set(["follow", "name", "look"]);

/**
 * @param {Readonly<View>} view
 * @param {Field[]} fields
 * @param {Params} thresholds as they usually are
 * @param {Aside} aside
 */
export function hashOf(view, fields, thresholds, { name, look }) {
  const live = view.recording.startsWith("live:");
  /** @type {Named} */
  const values = view;
  /** @type {[string, string | number][]} */
  const pairs = [];
  for (const field of fields) {
    if (field.link === EACH) pairs.push(...differing(values[field.name], thresholds));
    else if (field.link !== null && (field.lasting || !live)) {
      const words = written({ ...field, default: usualOf(field, view.mode) }, values[field.name]);
      if (words !== "") pairs.push([field.link, words]);
    }
    if (field.name === "recording" && name && /^(file|recent|upload):/.test(view.recording)) pairs.push(["name", name]);
    if (field.name === "camera" && view.camera === field.default && look) pairs.push(["look", lookWords(look)]);
  }
  return pairs
    .map(([key, value]) => `${key}=${encodeURIComponent(value).replace(/%(3A|3B|2F|2C)/g, decodeURIComponent)}`)
    .join("&");
}

/** What a link means that leaves out a field: in Inspect, the most suspicious frame. @param {Field} field @param {View["mode"]} mode */
function usualOf({ name, default: usual }, mode) {
  if (name === "score") return usualScore(mode);
  return name === "frame" && mode === "inspect" ? null : usual;
}

/**
 * Reads a hash. patch: what fits the View; odd: the rest, so that the server can say what is wrong; leads: whether the
 * most suspicious frame is meant.
 * @param {string} hash
 * @param {Field[]} fields
 * @param {(method: string | undefined) => Params | undefined} thresholdsOf the defaults of a method, where they are known
 * @returns {{patch: Named, odd: Named, aside: Aside, empty: boolean, leads: boolean}}
 */
export function readHash(hash, fields, thresholdsOf) {
  const words = new URLSearchParams(hash.replace(/^#/, "").slice(0, LONGEST).replaceAll("+", "%2B"));
  const byKey = new Map(fields.map((field) => [field.link, field]));
  const [patch, odd] = [/** @type {Named} */ ({}), /** @type {Named} */ ({})];
  /** @type {[string, string][]} */
  const others = [];
  for (const [key, text] of words) {
    const field = key === EACH ? undefined : byKey.get(key);
    if (field) take(patch, odd, field, parsed(field, text));
    else if (!ASIDE.has(key)) others.push([key, text]);
  }
  const thresholds = byKey.get(EACH);
  const known = thresholdsOf(patch.method);
  if (thresholds && others.length)
    take(
      patch,
      odd,
      thresholds,
      sorted(others, (name, text) => Number.isFinite(numberOf(text)) && (!known || Object.hasOwn(known, name))),
    );
  const aside = { name: words.get("name") ?? "", look: lookOf(words.get("look")) };
  if (patch.mode) patch.score ??= usualScore(patch.mode);
  const leads = patch.mode === "inspect" && ["frame", "step", "beam"].every((key) => !words.has(key));
  return { patch, odd, aside, empty: words.size === 0, leads };
}

/** @typedef {{good?: any, bad?: any}} Parsed what fits, and what does not */

/** @param {Named} patch @param {Named} odd @param {Field} field @param {Parsed} parsed */
function take(patch, odd, { name }, { good, bad }) {
  if (good !== undefined) patch[name] = good;
  if (bad !== undefined) odd[name] = bad;
}

/** @param {Field} field @param {any} value */
function written(field, value) {
  if (field.written === "pinned") return value ? [value.method, ...pairs(value.params)].join(",") : "";
  if (field.written === "numbers") return pairs(Object.fromEntries(differing(value, field.default))).join(",");
  if (field.written === "reading")
    return differing(value, field.default)
      .map(([name, given]) => `${name}:${String(given).replace(/[%;]/g, encodeURIComponent)}`)
      .join(";");
  if (field.written === "switches")
    return differing(value, field.default)
      .map(([name, on]) => (on ? name : `-${name}`))
      .join(",");
  return value === field.default || value === null ? "" : value;
}

/** @param {Field} field @param {string} text @returns {Parsed} */
function parsed(field, text) {
  const { written: kind, default: usual, most, choices } = field;
  const number = numberOf(text);
  if (kind === "whole")
    return Number.isInteger(number) && number >= 0 && number <= (most ?? Infinity)
      ? { good: number }
      : { bad: Number.isFinite(number) ? number : text };
  if (kind === "choice") return choices.includes(text) ? { good: text } : { bad: text };
  if (kind === "pinned") return pinnedOf(text);
  // The server knows which fields a Reading has.
  if (kind === "reading") return { good: readingOf(text) };
  if (kind === "switches")
    return sorted(
      text.split(",").map((word) => [word.replace(/^-/, ""), !word.startsWith("-")]),
      (name) => Object.hasOwn(usual, name),
    );
  if (kind === "numbers") {
    const fits = (/** @type {number} */ value) => value >= 0 && value <= (most ?? Infinity);
    return sorted(colons(text.split(",")), (name, value) => Object.hasOwn(usual, name) && fits(numberOf(value)));
  }
  return text.length <= (most ?? Infinity) ? { good: text } : { bad: text };
}

/**
 * Separates the entries that fit from the others.
 * @param {[string, any][]} entries
 * @param {(name: string, value: any) => boolean} fits
 * @returns {Parsed}
 */
function sorted(entries, fits) {
  const asValues = (/** @type {[string, any][]} */ some) =>
    some.length ? Object.fromEntries(some.map(([name, value]) => [name, spoken(value)])) : undefined;
  const named = entries.filter(([name]) => name !== "");
  return {
    good: asValues(named.filter(([name, value]) => fits(name, value))),
    bad: asValues(named.filter(([name, value]) => !fits(name, value))),
  };
}

/** "unit:mm;sector:-90:90" @param {string} text @returns {Record<string, string>} */
function readingOf(text) {
  const entries = text.split(";").map((entry) => {
    const [name, ...rest] = entry.split(":");
    return [name, rest.join(":").replace(/%(25|3B)/g, decodeURIComponent)];
  });
  return Object.fromEntries(entries.filter(([name]) => name));
}

/** "region-growing,epsilon:0.03,…"; half of A would be another result. @param {string} text @returns {Parsed} */
function pinnedOf(text) {
  const [method, ...words] = text.split(",");
  const { good = {}, bad } = sorted(colons(words), (_, value) => Number.isFinite(numberOf(value)));
  return bad ? { bad: { method, params: { ...good, ...bad } } } : { good: { method, params: good } };
}

/** @param {string[]} words @returns {[string, string][]} */
function colons(words) {
  return words.map((word) => /** @type {[string, string]} */ ([...word.split(":"), ""].slice(0, 2)));
}

/** @param {any} value a number, if it says one */
function spoken(value) {
  return typeof value === "string" && Number.isFinite(numberOf(value)) ? numberOf(value) : value;
}

/** @param {string} text */
function numberOf(text) {
  return text.trim() === "" ? NaN : Number(text);
}

/** @param {Record<string, any>} values */
function pairs(values) {
  return Object.entries(values).map(([name, value]) => `${name}:${value}`);
}

/** @param {Record<string, any>} values @param {Record<string, any>} usual */
function differing(values, usual) {
  return Object.entries(values).filter(([name, value]) => value !== usual[name]);
}

/** @param {Look} look */
function lookWords({ x, y, span }) {
  return [x, y, span].map((metres) => metres.toFixed(2)).join();
}

/** @param {string | null} text "1.50,-2.00,8.00" @returns {Look | null} */
function lookOf(text) {
  const [x, y, span] = (text ?? "").split(",").map(numberOf);
  return [x, y, span].every((metres) => Math.abs(metres) <= FARTHEST) && span > 0 ? { x, y, span } : null;
}
