// @ts-check
// The View of this tab: the one place where it changes, its undo, and its mirror in the URL hash.

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Method} Method */
/** @typedef {Pick<View, "method" | "params">} Chosen */
/** @typedef {Partial<View>} Patch */
/** The middle of the plan and how high it is [m]. @typedef {{x: number, y: number, span: number}} Look */
/** @typedef {(view: Readonly<View>, patch: Patch | null) => void} Listener patch is null for what the server told */

export const LAYERS = Object.freeze({
  points: true,
  invalid: false,
  seeds: true,
  segments: true,
  endpoints: true,
  normals: false,
  dropped: true,
  truth: false,
  verdicts: false,
  laser: true,
  grid: true,
  replay: true,
});

/** @returns {View} */
function freshView() {
  return {
    recording: null,
    topic: null,
    frame: 0,
    method: "region-growing",
    params: {},
    step: null,
    layers: { ...LAYERS },
    selected: null,
    camera: "plan",
    dark: false,
    mode: "tune",
    score: "coverage",
    against: null,
    weights: {},
    reference: "labels",
    live: true,
  };
}

/**
 * `after` on top of `before`; params and layers are merged, and another recording forgets the place in the former one,
 * another method its params.
 * @template {Patch} T
 * @param {T} before
 * @param {Patch} after
 * @returns {T}
 */
export function merged(before, after) {
  const base = /** @type {T} */ ({ ...before });
  if (after.recording !== undefined && after.recording !== before.recording) {
    for (const name of /** @type {const} */ (["topic", "frame", "step", "selected", "live"])) delete base[name];
  }
  const result = { ...base, ...after };
  // Another method has other thresholds.
  const same = after.method === undefined || after.method === before.method;
  if (same && before.params && after.params) result.params = { ...before.params, ...after.params };
  if (before.layers && after.layers) result.layers = { ...before.layers, ...after.layers };
  return result;
}

const RESET_BY_RECORDING = { topic: null, frame: 0, step: null, selected: null, live: true };

export class Store {
  /** @type {View} */ #view = freshView();
  /** @type {Chosen[]} */ #past = [];
  /** @type {Chosen[]} */ #future = [];
  /** @type {string | null} */ #gesture = null;
  /** @type {Record<string, Params>} of each method */ #defaults = {};
  /** @type {Record<string, Params>} of each method, as they were when another was chosen */ #kept = {};
  /** @type {Listener[]} */ #listeners = [];

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

  /** What the file of the recording is called, where its id does not tell; a part of the hash only. */
  name = "";
  /** What of the plan is looked at, where it is not all of it; a part of the hash only. @type {Look | null} */
  look = null;

  /** Whether a person may make this change. @type {(patch: Patch) => boolean} */
  allows = () => true;

  /** @param {Listener} listener */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /**
   * The thresholds of the methods, whose defaults fill what the View leaves open.
   * @param {Method[]} methods
   */
  declare(methods) {
    const defaults = (/** @type {Method} */ { name, knobs }) => [
      name,
      Object.fromEntries(knobs.map((knob) => [knob.name, knob.default])),
    ];
    this.#defaults = Object.fromEntries(methods.map(defaults));
    const known = Object.entries(this.#view.params).filter(([name]) => name in this.defaults);
    this.#view = { ...this.#view, params: { ...this.defaults, ...Object.fromEntries(known) } };
    this.#tell(null);
  }

  /**
   * A change made by a person. Changes of thresholds can be undone; those of one gesture (a drag) as one. Another method
   * has the thresholds that it had before, or its defaults.
   * @param {Patch} patch
   * @param {string | null} gesture
   */
  change(patch, gesture = null) {
    // Controls that moved go back to what is.
    if (!this.allows(patch)) return this.#tell(null);
    const { method, recording } = patch;
    let full = recording && recording !== this.#view.recording ? { ...RESET_BY_RECORDING, ...patch } : patch;
    if (method && method !== this.#view.method)
      full = { params: this.#kept[method] ?? this.#defaults[method] ?? {}, ...full };
    if (full.params) this.#remember(gesture);
    this.#view = merged(this.#view, full);
    this.#tell(full);
    return undefined;
  }

  /**
   * What the server says the View is; not sent back.
   * @param {Patch} patch
   */
  adopt(patch) {
    const same = patch.method === undefined || patch.method === this.#view.method;
    if (patch.params && !(same && equal(patch.params, this.#view.params))) this.#remember(null);
    this.#view = merged(this.#view, patch);
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
    return { method: this.#view.method, params: this.#view.params };
  }

  /** @param {Chosen[]} from @param {Chosen[]} to */
  #travel(from, to) {
    const chosen = from.pop();
    if (!chosen) return;
    to.push(this.#chosen);
    this.#gesture = null;
    this.#view = { ...this.#view, ...chosen };
    this.#tell(chosen);
  }

  /** @param {string | null} gesture */
  #remember(gesture) {
    if (gesture === null || gesture !== this.#gesture) this.#past.push(this.#chosen);
    this.#kept[this.#view.method] = this.#view.params;
    if (this.#past.length > 500) this.#past.shift();
    this.#gesture = gesture;
    this.#future.length = 0;
  }

  /** @param {Patch | null} patch */
  #tell(patch) {
    for (const listener of this.#listeners) listener(this.#view, patch);
  }

  /** The View as a readable hash; what is as usual is left out. */
  get hash() {
    const view = this.#view;
    /** @type {[string, string | number][]} */
    const pairs = [];
    if (view.mode !== "tune") pairs.push(["mode", view.mode]);
    if (view.recording !== null) pairs.push(["recording", view.recording]);
    if (this.name && /^(file|recent|upload):/.test(view.recording ?? "")) pairs.push(["name", this.name]);
    if (view.topic !== null) pairs.push(["topic", view.topic]);
    // The frames of a live recording are gone when the link is opened.
    if (view.frame !== 0 && !view.recording?.startsWith("live:")) pairs.push(["frame", view.frame]);
    if (view.method !== "region-growing") pairs.push(["method", view.method]);
    for (const [name, value] of Object.entries(view.params)) {
      if (value !== this.defaults[name]) pairs.push([name, value]);
    }
    if (view.step !== null) pairs.push(["step", view.step]);
    if (view.selected !== null) pairs.push(["beam", view.selected]);
    if (view.camera !== "plan") pairs.push(["camera", view.camera]);
    else if (this.look)
      pairs.push(["look", [this.look.x, this.look.y, this.look.span].map((metres) => metres.toFixed(2)).join()]);
    if (view.score !== "coverage") pairs.push(["score", view.score]);
    if (view.against) pairs.push(["against", pinnedWords(view.against)]);
    const weights = Object.entries(view.weights);
    if (weights.length) pairs.push(["weights", weights.map(([name, value]) => `${name}:${value}`).join(",")]);
    if (view.reference !== "labels") pairs.push(["reference", view.reference]);
    const switched = Object.entries(LAYERS).filter(([name, usual]) => view.layers[name] !== usual);
    if (switched.length) pairs.push(["layers", switched.map(([name, usual]) => (usual ? "-" : "") + name).join(",")]);
    return pairs
      .map(([name, value]) => `${name}=${encodeURIComponent(value).replace(/%(3A|3B|2F|2C)/g, decodeURIComponent)}`)
      .join("&");
  }

  /**
   * Takes the View from a hash; what the hash leaves out is as usual.
   * @param {string} hash
   * @returns {boolean} false if the hash says nothing
   */
  read(hash) {
    const patch = parseHash(hash);
    const words = new URLSearchParams(hash.replace(/^#/, ""));
    this.name = words.get("name") ?? "";
    this.look = parseLook(words.get("look"));
    const dark = this.#view.dark;
    const params = { ...this.#defaults[patch.method ?? freshView().method], ...patch.params };
    this.#view = { ...freshView(), ...patch, params, layers: { ...LAYERS, ...patch.layers }, dark };
    if (!patch.recording) return false;
    this.#tell(this.#view);
    return true;
  }
}

/** @param {Params} one @param {Params} other */
function equal(one, other) {
  return Object.entries(one).every(([name, value]) => other[name] === value);
}

/**
 * @param {string} hash
 * @returns {Patch}
 */
function parseHash(hash) {
  /** @type {Patch} */
  const patch = {};
  /** @type {Params} */
  const params = {};
  for (const [name, value] of new URLSearchParams(hash.replace(/^#/, "").replaceAll("+", "%2B"))) {
    const number = value.trim() === "" ? NaN : Number(value);
    if (name === "mode" || name === "recording" || name === "topic" || name === "method" || name === "score")
      patch[name] = value;
    else if (name === "follow" || name === "name" || name === "look") continue;
    else if (name === "weights") patch.weights = parsePinned(`,${value}`).params;
    else if (name === "against") patch.against = parsePinned(value);
    else if (name === "camera") patch.camera = value === "free" ? "free" : "plan";
    else if (name === "reference") patch.reference = value === "wall" ? "wall" : "labels";
    else if (name === "layers") patch.layers = parseLayers(value);
    else if (name === "frame" || name === "step" || name === "beam") {
      if (Number.isInteger(number) && number >= 0) patch[name === "beam" ? "selected" : name] = number;
    } else if (Number.isFinite(number)) params[name] = number;
  }
  if (Object.keys(params).length) patch.params = params;
  return patch;
}

/** @param {import("../wire.js").Against} pinned "region-growing,epsilon:0.03,…" */
function pinnedWords({ method, params }) {
  return [method, ...Object.entries(params).map(([name, value]) => `${name}:${value}`)].join(",");
}

/** @param {string} value */
function parsePinned(value) {
  const [method, ...pairs] = value.split(",");
  const params = pairs.map((pair) => pair.split(":")).filter(([, number]) => Number.isFinite(Number(number ?? NaN)));
  return { method, params: Object.fromEntries(params.map(([name, number]) => [name, Number(number)])) };
}

/** @param {string | null} value "1.50,-2.00,8.00" @returns {Look | null} */
function parseLook(value) {
  const [x, y, span] = (value ?? "").split(",").map((metres) => (metres.trim() === "" ? NaN : Number(metres)));
  return [x, y, span].every(Number.isFinite) && span > 0 ? { x, y, span } : null;
}

/** @param {string} value e.g. "normals,-dropped" */
function parseLayers(value) {
  const entries = value
    .split(",")
    .map((word) => /** @type {const} */ ([word.replace(/^-/, ""), !word.startsWith("-")]));
  return Object.fromEntries(entries.filter(([name]) => name in LAYERS));
}

/** What a drawn state says of the View. @param {import("../wire.js").State} state */
export function viewOf(state) {
  const {
    mode,
    recording,
    topics,
    frame,
    method,
    params,
    step,
    layers: shown,
    selected,
    camera,
    score,
    against,
    reference,
  } = state;
  const topic = topics.length > 1 ? state.topic : null;
  const following = state.live ?? true;
  return {
    mode,
    recording,
    topic,
    frame,
    method,
    params,
    step,
    layers: shown,
    selected,
    camera,
    score,
    against,
    reference,
    live: following,
  };
}
