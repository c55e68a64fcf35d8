// @ts-check
// The View of this tab: the one place where it changes, its undo, and its mirror in the URL hash.

import { VIEW } from "../declared.js";
import { freshView, isPartial, merged, overlaid, resets } from "./fields.js";
import { hashOf, readHash } from "./hash.js";
import { isIn } from "./key.js";

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Method} Method */
/** What undo restores; layers: only where they were set together with thresholds, as a profile does. @typedef {Pick<View, "method" | "params" | "recording" | "topic" | "reading"> & {layers?: View["layers"]}} Chosen */
/** @typedef {import("./fields.js").Patch} Patch */
/** @typedef {import("./hash.js").Look} Look */
/** @typedef {(view: Readonly<View>, patch: Patch | null, linked: boolean) => void} Listener patch: null for what the server told; linked: a link says it, and not all of it may be possible */

export class Store {
  #fields;
  /** @type {View} */ #view;
  /** @type {Chosen[]} */ #past = [];
  /** @type {Chosen[]} */ #future = [];
  /** @type {string | null} */ #gesture = null;
  /** @type {Record<string, Params>} of each method */ #defaults = {};
  /** @type {Record<string, Params>} of each method, as they were when another was chosen */ #kept = {};
  /** @type {Listener[]} */ #listeners = [];

  /** @param {import("../wire.js").Field[]} fields */
  constructor(fields = VIEW) {
    this.#fields = fields;
    this.#view = freshView(fields);
  }

  /** @returns {Readonly<View>} */
  get view() {
    return this.#view;
  }
  /** @returns {Params} of the method */
  get defaults() {
    return this.#defaults[this.#view.method] ?? {};
  }
  get canUndo() {
    return this.#past.length > 0;
  }
  get canRedo() {
    return this.#future.length > 0;
  }

  /** The name of the recording's file if the id does not contain it; only in the hash. */
  name = "";
  /** What of the plan is looked at, where it is not all of it; a part of the hash only. @type {Look | null} */
  look = null;

  /** Whether the last hash means the most suspicious frame. */
  leads = false;

  /** Whether a person may make this change. @type {(patch: Patch) => boolean} */
  allows = () => true;

  /** @param {Listener} listener */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /**
   * The thresholds of the methods, whose defaults complete the View.
   * @param {Method[]} methods
   */
  declare(methods) {
    const defaults = (/** @type {Method} */ { name, knobs }) => [
      name,
      Object.fromEntries(knobs.map((knob) => [knob.name, knob.default])),
    ];
    this.#defaults = Object.fromEntries(methods.map(defaults));
    const known = Object.entries(this.#view.params).filter(([name]) => Object.hasOwn(this.defaults, name));
    this.#view = { ...this.#view, params: { ...this.defaults, ...Object.fromEntries(known) } };
    this.#tell(null);
  }

  /**
   * A change made by a person. Changes of thresholds and of how the file is read can be undone; those of one gesture (a
   * drag) as one. Another method
   * has the thresholds that it had before, or its defaults.
   * @param {Patch} patch
   * @param {string | null} gesture
   */
  change(patch, gesture = null) {
    // Controls that moved go back to the current View.
    if (!this.allows(patch)) return this.#tell(null);
    const afresh = resets(this.#view, patch, this.#fields).map(({ name, written, default: usual }) => [
      name,
      written === "thresholds" ? this.#thresholds(patch.method) : structuredClone(usual),
    ]);
    const full = { ...Object.fromEntries(afresh), ...patch };
    if (full.params || patch.reading)
      this.#remember(gesture, full.params && full.layers ? this.#view.layers : undefined);
    this.#view = merged(this.#view, full, this.#fields);
    this.#tell(full);
    return undefined;
  }

  /**
   * Takes over the View from the server; it is not sent back.
   * @param {Patch} patch
   */
  adopt(patch) {
    const same = patch.method === undefined || patch.method === this.#view.method;
    if (patch.params && !(same && isIn(patch.params, this.#view.params))) this.#remember(null);
    this.#view = merged(this.#view, patch, this.#fields);
    this.#tell(null);
  }

  /** The thresholds as they were, after the server refused new ones. @param {Params} params */
  restore(params) {
    this.#past.pop();
    this.#gesture = null;
    this.#view = { ...this.#view, params: { ...this.#view.params, ...params } };
    this.#tell(null);
  }

  undo() {
    this.#travel(this.#past, this.#future);
  }
  redo() {
    this.#travel(this.#future, this.#past);
  }

  get #chosen() {
    const { method, params, recording, topic, reading } = this.#view;
    return { method, params, recording, topic, reading };
  }

  /** @param {Chosen[]} from @param {Chosen[]} to */
  #travel(from, to) {
    /** @type {Chosen} */
    const now = this.#chosen;
    /** @type {Patch | null} */
    let patch = null;
    // What was changed in a recording that is no longer open stays as it is.
    while (from.length && !patch) {
      const { method, params, recording, topic, reading, layers } = /** @type {Chosen} */ (from.pop());
      const here = recording === now.recording && !alike(reading, now.reading);
      const same = method === now.method && isIn(params, now.params) && (!layers || isIn(layers, this.#view.layers));
      if (!same || here) patch = { method, params, ...(here && { topic, reading }), ...(layers && { layers }) };
    }
    if (!patch) return this.#tell(null);
    if (patch.layers) now.layers = this.#view.layers;
    to.push(now);
    this.#gesture = null;
    this.#view = merged(this.#view, patch, this.#fields);
    this.#tell(patch);
    return undefined;
  }

  /** @param {string | null} gesture @param {View["layers"]} [layers] */
  #remember(gesture, layers) {
    if (gesture === null || gesture !== this.#gesture) this.#past.push({ ...this.#chosen, layers });
    this.#kept[this.#view.method] = this.#view.params;
    if (this.#past.length > 500) this.#past.shift();
    this.#gesture = gesture;
    this.#future.length = 0;
  }

  /** The thresholds as they were when another method was selected, or else the defaults. @param {string | undefined} method */
  #thresholds(method = this.#view.method) {
    return this.#kept[method] ?? this.#defaults[method] ?? {};
  }

  /** @param {Patch | null} patch */
  #tell(patch, linked = false) {
    for (const listener of this.#listeners) listener(this.#view, patch, linked);
  }

  /** The View as a readable hash; defaults are left out. */
  get hash() {
    return hashOf(this.#view, this.#fields, this.defaults, this);
  }

  /**
   * Takes the View from a hash; what the hash leaves out gets its default, except for personal settings, which no link contains.
   * @param {string} hash
   * @returns {boolean} whether the hash names a recording
   */
  read(hash) {
    const fresh = /** @type {import("./fields.js").Named} */ (freshView(this.#fields));
    const own = /** @type {import("./fields.js").Named} */ (this.#view);
    const defaults = (/** @type {string | undefined} */ method) => this.#defaults[method ?? fresh.method];
    const { patch, odd, aside, empty, leads } = readHash(hash, this.#fields, defaults);
    if (empty) return false;
    Object.assign(this, { ...aside, leads });
    for (const { name, link, mirrored } of this.#fields) if (link === null && !mirrored) fresh[name] = own[name];
    for (const { name } of this.#fields.filter(isPartial))
      if (patch[name]) patch[name] = { ...fresh[name], ...patch[name] };
    /** @type {import("./fields.js").Named} */
    const view = { ...fresh, ...patch };
    this.#view = /** @type {View} */ ({ ...view, params: { ...defaults(view.method), ...patch.params } });
    this.#tell(overlaid(this.#view, odd, this.#fields), true);
    return Boolean(patch.recording);
  }
}

/** @param {View["reading"]} one @param {View["reading"]} other */
function alike(one, other) {
  return Object.keys({ ...one, ...other }).every((name) => (one[name] ?? null) === (other[name] ?? null));
}
