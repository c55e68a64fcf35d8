// @ts-check
// What a map shows: a measure over two thresholds and, for a sweep, all files or one.
import { h } from "../widgets/dom.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Measure} Measure */
/** @typedef {import("./sweep_table.js").SweepTable} SweepTable */

// The measures of the open recording; a sweep may have more.
const LIVE = ["coverage", "segments", "true_rate", "false_rate", "completeness", "f_score"];

export class MapChoices {
  #text;
  #measure;
  #x;
  #y;
  #file;
  #files;
  /** Whether a person has chosen the measure. */ #chosen = false;

  /** @param {typeof import("../text/tuning.js").tuningText.map} text @param {() => void} onChange */
  constructor(text, onChange) {
    this.#text = text;
    const choice = (/** @type {string} */ label) =>
      h("select", { class: "select", "aria-label": label, onchange: onChange });
    this.#measure = choice(text.measure);
    this.#measure.addEventListener("change", () => {
      this.#chosen = true;
    });
    this.#x = choice(text.x);
    this.#y = choice(text.y);
    this.#file = choice(text.file);
    this.#files = field(text.file, this.#file);
    this.#files.hidden = true;
    const fields = [field(text.measure, this.#measure), field(text.x, this.#x), field(text.y, this.#y), this.#files];
    this.element = h("div", { class: "map-choices" }, ...fields);
  }

  get x() {
    return this.#x.value;
  }

  get y() {
    return this.#y.value;
  }

  get measure() {
    return this.#measure.value;
  }

  /** The selected file of a sweep; null means all. */
  get file() {
    return this.#file.value ? Number(this.#file.value) : null;
  }

  /** A map needs two different thresholds. */
  keepApart() {
    if (this.x !== this.y) return;
    this.#y.value = [...this.#y.options].find((option) => option.value !== this.x)?.value ?? "";
  }

  /** The files of a sweep. @param {string[]} names */
  offerFiles(names) {
    this.#files.hidden = names.length < 2;
    this.#file.replaceChildren(
      h("option", { value: "" }, this.#text.allFiles),
      ...names.map((name, k) => h("option", { value: String(k) }, name.split(/[\\/]/).pop())),
    );
  }

  /** Sets the available thresholds and measures. @param {Knob[]} knobs @param {Measure[]} measures @param {SweepTable | null} table */
  offer(knobs, measures, table) {
    const axes = knobs.filter(({ name }) => !table || table.axes[name]);
    for (const [k, select] of [this.#x, this.#y].entries()) {
      const chosen = select.value;
      select.replaceChildren(
        ...axes.map(({ name, symbol, label }) => h("option", { value: name }, `${symbol} ${label}`)),
      );
      select.value = axes.some(({ name }) => name === chosen) ? chosen : (axes[k]?.name ?? "");
    }
    const chosen = this.measure;
    const there = measures.filter(({ name }) => (table ? table.measures.includes(name) : LIVE.includes(name)));
    const usual = there.find(({ name }) => name === "f_score") ?? there[0];
    this.#measure.replaceChildren(
      ...there.map(({ name, label, help }) => h("option", { value: name, title: help }, label)),
    );
    this.#measure.value = there.some(({ name }) => name === chosen) ? chosen : (usual?.name ?? "");
  }

  /** Selects the most informative measure, until a person chooses another. @param {boolean} truth @param {Measure[]} measures */
  setTruth(truth, measures) {
    if (!this.#chosen && measures.length) this.#measure.value = truth ? "f_score" : "coverage";
    for (const option of this.#measure.options)
      option.disabled = !truth && Boolean(measures.find(({ name }) => name === option.value)?.truth);
  }
}

/** @param {string} label @param {HTMLElement} control */
function field(label, control) {
  return h("label", { class: "map-field" }, h("span", { class: "muted" }, label), control);
}
