// @ts-check
// One threshold over its whole range: a picture of the lines for each value.
import { freshCanvas } from "../widgets/canvas.js";
import { h, setText } from "../widgets/dom.js";
import { clamp, format, placeOf, reaching, valueAt, withUnit } from "../widgets/scale.js";
import { createSlider, gestureCount } from "../widgets/slider.js";
import { colour, onTheme } from "../widgets/colours.js";
import { fetchInto } from "./fetched.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** runs: first, last, colour of each line, for each value. @typedef {import("../wire.js").ThresholdSweep} Swept */

export class Sweep {
  #text;
  #session;
  #onParams;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Params} */ #params = {};
  #frame = "";
  #name = "epsilon";
  /** @type {Swept | null} */ #swept = null;
  /** What the picture was made from; a change makes a new picture. */
  #made = "";
  #busy = false;
  #shown = false;
  #picture = h("canvas", { class: "sweep-canvas", role: "img" });
  #trouble = h("div", { class: "sweep-trouble" });
  #value = h("span", { class: "muted sweep-value" });
  #choice;
  #slider;

  /**
   * @param {typeof import("../text/learn.js").learnText.ladder} text
   * @param {{session: () => string, onParams: (params: Params, gesture: string | null) => void}} handlers
   */
  constructor(text, { session, onParams }) {
    this.#text = text;
    this.#session = session;
    this.#onParams = onParams;
    const choice = h("select", {
      class: "select",
      "aria-label": text.threshold,
      onchange: () => {
        this.#name = choice.value;
        this.#refresh();
      },
    });
    this.#choice = choice;
    this.#slider = createSlider({
      label: text.threshold,
      onPlace: (place) => this.#set(valueAt(this.#knob, place)),
      onSteps: (steps) => this.#set(this.#stepped(steps)),
      fill: false,
    });
    this.element = h(
      "figure",
      { class: "chart sweep" },
      h("figcaption", {}, choice, h("span", {}, text.sweep), this.#value),
      this.#picture,
      this.#slider.element,
      this.#trouble,
    );
    this.#picture.addEventListener("click", (event) => this.#take(event));
    onTheme(() => this.#draw());
    new ResizeObserver(() => this.#draw()).observe(this.#picture);
  }

  get #knob() {
    return /** @type {Knob} */ (this.#knobs.find(({ name }) => name === this.#name) ?? this.#knobs[0]);
  }

  /** @param {number} steps ±Infinity: to the ends */
  #stepped(steps) {
    const { step, low, high } = this.#knob;
    if (!Number.isFinite(steps)) return steps < 0 ? low : high;
    return clamp(Number((this.#params[this.#name] + steps * step).toPrecision(6)), low, high);
  }

  /** @param {number} value */
  #set(value) {
    this.#onParams({ [this.#name]: value }, `sweep ${this.#name} ${gestureCount()}`);
  }

  /** Sets the value of the clicked column. @param {MouseEvent} event */
  #take({ offsetX }) {
    if (!this.#swept) return;
    const { values } = this.#swept;
    const column = Math.floor((offsetX / this.#picture.clientWidth) * values.length);
    this.#set(values[Math.min(column, values.length - 1)]);
  }

  #draw() {
    if (!this.#swept || !this.#picture.clientWidth) return;
    const { pen, width, height } = freshCanvas(this.#picture);
    const { beams, values, lines, runs } = this.#swept;
    const [wide, tall] = [width / values.length, height / beams];
    runs.forEach((row, k) => {
      for (const [first, last, tone] of row) {
        pen.fillStyle = tone;
        pen.fillRect(k * wide, first * tall, wide + 0.5, Math.max((last - first + 1) * tall, 0.7));
      }
    });
    const now = this.#params[this.#name];
    pen.fillStyle = colour("--ink");
    pen.fillRect(placeOf(this.#knob, now) * width - 0.8, 0, 1.6, height);
    const words = this.#text.at(
      this.#knob.symbol.replace("_", " "),
      withUnit(this.#knob, now),
      lines[nearest(values, now)],
    );
    setText(this.#value, words);
    this.#picture.setAttribute("aria-label", `${this.#text.sweepHelp} ${words}`);
  }

  /** Asks for the picture if it belongs to something else. @returns {Promise<void>} */
  async #refresh() {
    if (!this.#shown || !this.#knobs.length) return;
    const now = this.#params[this.#name];
    this.#slider.set(placeOf(this.#knob, now), format(this.#knob, now));
    const others = Object.entries(this.#params).filter(([each]) => each !== this.#name);
    const wanted = JSON.stringify([this.#frame, this.#name, others]);
    if (wanted === this.#made || this.#busy) return this.#draw();
    this.#busy = true;
    this.#made = wanted;
    const query = new URLSearchParams({ session: this.#session(), name: this.#name });
    await fetchInto(this.#trouble, `/api/sweep?${query}`, this.#text, (/** @type {Swept} */ told) => {
      this.#swept = told;
      this.#draw();
    });
    this.#busy = false;
    // Something changed meanwhile.
    return this.#refresh();
  }

  /** @param {boolean} on */
  show(on) {
    this.#shown = on;
    this.#draw();
    this.#refresh();
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#choice.replaceChildren(
      ...knobs.map(({ name, symbol }) =>
        h("option", { value: name, selected: name === this.#name }, symbol.replace("_", " ")),
      ),
    );
  }

  /** @param {import("../wire.js").State} state */
  setState({ params, place, frame, method }) {
    this.#params = params;
    this.#knobs = this.#knobs.map((knob) => reaching(knob, params[knob.name] ?? knob.low));
    this.#frame = JSON.stringify([place, frame, method]);
    this.#refresh();
  }
}

/** @param {number[]} values @param {number} value @returns {number} its place */
function nearest(values, value) {
  const away = values.map((each) => Math.abs(each - value));
  return away.indexOf(Math.min(...away));
}
