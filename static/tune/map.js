// @ts-check
// A measure over two thresholds, of the open recording or of an opened sweep; a click sets both thresholds.
import { chooseFile } from "../widgets/choose_file.js";
import { h, setText } from "../widgets/dom.js";
import { withUnit } from "../widgets/scale.js";
import { MapChoices } from "./map_choices.js";
import { COLOURS, paintRelief, rangeOf, settingAt } from "./map_picture.js";
import { readSweepTable } from "./sweep_table.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Answer} Answer */
/** @typedef {import("../wire.js").Measure} Measure */
/** @typedef {import("./sweep_table.js").SweepTable} SweepTable */
/** @typedef {{ask: (x: string, y: string, measure: string) => void, stop: () => void, onSet: (params: Params) => void}} Handlers */

export class TuningMap {
  #text;
  #handlers;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Measure[]} */ #measures = [];
  /** @type {Params} */ #params = {};
  /** @type {SweepTable | null} */ #table = null;
  /** Of a sweep: its cells with all their settings. @type {ReturnType<SweepTable["relief"]> | null} */ #relief = null;
  /** @type {Answer | null} */ #shown = null;
  #running = false;
  #asked = "";

  #choices;
  #source = h("span", { class: "map-source muted" });
  #canvas = h("canvas", { class: "map-canvas", role: "img" });
  #up = h("span", { class: "map-up muted" });
  #across = h("span", { class: "map-across muted" });
  #scale = h("div", { class: "map-scale muted" });
  #readout = h("p", { class: "map-readout" });
  #state = h("span", { class: "muted", role: "status" });
  #hint;
  #button;
  #close;

  /** @param {typeof import("../text/tuning.js").tuningText.map} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.#choices = new MapChoices(text, () => this.#begin());
    const button = (/** @type {string} */ label, /** @type {() => void} */ run) =>
      h("button", { type: "button", class: "button", onclick: run }, label);
    this.#button = button(text.again, () => (this.#running ? handlers.stop() : this.#begin()));
    this.#close = button(text.close, () => this.#setTable(null));
    this.#close.hidden = true;
    const opening = button(text.open, () => chooseFile(([chosen]) => chosen && this.open(chosen)));
    opening.title = text.openHelp;
    this.#hint = h("p", { class: "hint" }, text.hint);
    this.element = h(
      "div",
      { class: "map-page" },
      this.#choices.element,
      this.#source,
      h("div", { class: "map-frame" }, this.#up, this.#canvas),
      this.#across,
      this.#scale,
      this.#readout,
      h("div", { class: "map-foot" }, this.#button, this.#close, opening, this.#state),
      this.#hint,
    );
    this.#canvas.addEventListener("click", (event) => this.#shown && handlers.onSet(this.#under(event).params));
    this.#canvas.addEventListener("pointermove", (event) => this.#read(event));
    new ResizeObserver(() => this.#paint()).observe(this.#canvas);
    new MutationObserver(() => this.#shownOrHidden()).observe(this.element, { attributeFilter: ["hidden"] });
  }

  #shownOrHidden() {
    if (!this.element.hidden) this.#renew();
    else if (this.#running) this.#handlers.stop();
  }

  /** @param {string} name */
  #knobOf(name) {
    return /** @type {Knob} */ (this.#knobs.find((knob) => knob.name === name));
  }

  /** The range of an axis: that of the slider, or the swept values. @param {string} name @returns {Knob} */
  #spanOf(name) {
    const knob = this.#knobOf(name);
    const values = this.#table?.axes[name];
    if (!values) return knob;
    return { ...knob, low: values[0], high: values[values.length - 1], log: knob.log && values[0] > 0 };
  }

  /** What the map depends on: everything except the thresholds on its axes. */
  #key() {
    const { x, y, measure } = this.#choices;
    const rest = Object.entries(this.#params).filter(([name]) => name !== x && name !== y);
    return JSON.stringify([x, y, measure, rest]);
  }

  #begin() {
    if (!this.#knobs.length || !this.#measures.length) return;
    this.#choices.keepApart();
    if (this.#table) return this.#drawTable(this.#table);
    const { x, y, measure } = this.#choices;
    this.#asked = this.#key();
    this.#setRunning(true, this.#text.starting);
    this.#handlers.ask(x, y, measure);
  }

  /** Requests the map if it is visible and out of date. */
  #renew() {
    if (!this.#table && !this.element.hidden && this.#key() !== this.#asked) this.#begin();
  }

  /** @param {SweepTable} table */
  #drawTable(table) {
    const { x, y, measure, file } = this.#choices;
    const lower = this.#measures.find(({ name }) => name === measure)?.better === "lower";
    this.#relief = table.relief(x, y, measure, lower, file);
    this.#shown = this.#relief && { type: "map", job: 0, x, y, measure, ...this.#relief };
    this.#paint();
  }

  /** Shows the table of a sweep. @param {File} chosen */
  async open(chosen) {
    setText(this.#state, this.#text.reading(chosen.name));
    const { table, trouble } = await readSweepTable(chosen, this.#text.broken);
    setText(this.#state, trouble ?? "");
    this.#state.classList.toggle("trouble", Boolean(trouble));
    if (table) this.#setTable(table);
  }

  /** @param {SweepTable | null} table null: back to the recording */
  #setTable(table) {
    if (this.#running) this.#handlers.stop();
    this.#table = table;
    this.#relief = this.#shown = null;
    this.#asked = "";
    this.#button.hidden = table !== null;
    this.#close.hidden = table === null;
    this.#choices.offerFiles(table?.files ?? []);
    setText(this.#source, table ? this.#text.sweep(table.name, table.settings, table.files.length) : "");
    setText(this.#hint, table ? this.#text.hintOfSweep : this.#text.hint);
    this.#offer();
    this.#begin();
  }

  #offer() {
    this.#choices.offer(this.#knobs, this.#measures, this.#table);
  }

  /** @param {boolean} on @param {string} words */
  #setRunning(on, words) {
    this.#running = on;
    setText(this.#button, on ? this.#text.stop : this.#text.again);
    setText(this.#state, words);
  }

  /** The heights to paint; null if there are none. */
  get #painted() {
    const { x = "", y = "", xs = [], ys = [], heights = [] } = this.#shown ?? {};
    return heights.length ? { x: this.#spanOf(x), y: this.#spanOf(y), xs, ys, heights } : null;
  }

  #paint() {
    const relief = this.#painted;
    if (!relief || !this.#canvas.clientWidth) return;
    const range = rangeOf(relief);
    setText(this.#readout, range ? "" : this.#text.nothing);
    if (!range) return;
    paintRelief(this.#canvas, relief, range, this.#params);
    const { x, y } = relief;
    const measure = this.#measures.find(({ name }) => name === this.#shown?.measure);
    const label = measure?.label ?? "";
    const [low, high] = [range.low, range.high].map((height) => h("span", {}, height.toFixed(3)));
    const bar = h("span", { class: "map-bar", "aria-hidden": "true" });
    bar.style.background = `linear-gradient(90deg, ${COLOURS.join(", ")})`;
    this.#scale.replaceChildren(h("span", {}, label), low, bar, high, measure?.unit ?? "");
    setText(this.#across, spanWords(x));
    setText(this.#up, spanWords(y));
    this.#canvas.setAttribute("aria-label", this.#text.picture(label, x.symbol, y.symbol));
  }

  /** The setting under the pointer (for a sweep, all its thresholds) and the height there. @param {MouseEvent} event @returns {{params: Params, height: number | null}} */
  #under({ clientX, clientY }) {
    const { left, top, width, height } = this.#canvas.getBoundingClientRect();
    const { x, y } = this.#choices;
    const axes = this.#painted ?? { x: this.#spanOf(x), y: this.#spanOf(y), xs: [], ys: [], heights: [] };
    const { params, column, row } = settingAt(axes, (clientX - left) / width, (clientY - top) / height);
    return {
      params: this.#relief?.cells[row]?.[column]?.params ?? params,
      height: axes.heights[row]?.[column] ?? null,
    };
  }

  /** @param {MouseEvent} event */
  #read(event) {
    if (!this.#painted) return;
    const { params, height } = this.#under(event);
    const words = Object.entries(params).map(([name, value]) => {
      const knob = this.#knobOf(name);
      return `${knob.symbol} ${withUnit(knob, value)}`;
    });
    setText(this.#readout, `${words.join(", ")}: ${height === null ? "–" : height.toFixed(3)}`);
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#offer();
  }

  /** @param {Measure[]} measures */
  setMeasures(measures) {
    this.#measures = measures;
    this.#offer();
  }

  /** @param {boolean} truth whether the recording has truth */
  setTruth(truth) {
    if (!this.#table) this.#choices.setTruth(truth, this.#measures);
  }

  /** @param {Params} params */
  setParams(params) {
    this.#params = params;
    this.#paint();
    this.#renew();
  }

  /** Forgets the map of another recording, so that it is computed again. */
  forget() {
    if (this.#table) return;
    this.#asked = "";
    this.#shown = null;
    this.#renew();
  }

  /** @param {Answer} answer */
  receive(answer) {
    if (this.#table) return this.#setRunning(false, "");
    if (answer.heights) {
      this.#shown = answer;
      setText(this.#state, this.#text.working(answer.frames ?? 0));
      this.#paint();
    }
    if (answer.done) this.#setRunning(false, answer.message ?? (answer.stopped ? this.#text.stopped : ""));
    return undefined;
  }

  get current() {
    if (!this.#shown) return null;
    const { x, y, measure, xs, frames, heights } = this.#shown;
    return { x, y, measure, sweep: this.#table?.name, side: xs?.length, frames, heights, running: this.#running };
  }
}

/** @param {Knob} knob */
function spanWords(knob) {
  return `${knob.symbol} ${withUnit(knob, knob.low)} – ${withUnit(knob, knob.high)}`;
}
