// @ts-check
// A small curve under each slider of the results over its range, and the legend that switches the lines of the curves.
import { keep, recalled } from "../kept.js";
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { createCurve, LINES } from "./curve.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {typeof import("../text/tuning.js").tuningText.curves} Text */

const KEY = "lineseg.curves";
// Without truth, only the first lines are known.
const WITHOUT_TRUTH = 2;

export class Sensitivity {
  #text;
  #onSet;
  #onShow;
  #row;
  /** Lines that are not drawn; "all" means that none is drawn. @type {Set<string>} */ #hidden;
  #note = h("span", { class: "curves-note muted", role: "status" });
  #all;
  #keys;
  /** @type {Map<string, ReturnType<typeof createCurve>>} */ #curves = new Map();
  /** Whether the recording has truth. */ #truth = false;

  /** @param {Text} text @param {{onSet: (name: string, value: number) => void, onShow: () => void, row: (name: string) => import("./tuner.js").Row | null}} handlers */
  constructor(text, { onSet, onShow, row }) {
    this.#text = text;
    this.#onSet = onSet;
    this.#onShow = onShow;
    this.#row = row;
    const hidden = recalled(KEY);
    this.#hidden = new Set(Array.isArray(hidden) ? hidden : []);
    this.#all = h("button", { type: "button", class: "curve-key all", onclick: () => this.#toggle("all") }, text.show);
    tooltip(this.#all, text.help, "left");
    this.#keys = new Map(LINES.map((line) => [line, this.#createKey(line)]));
    this.legend = h(
      "div",
      { class: "curves-legend", role: "group", "aria-label": text.label },
      this.#all,
      ...this.#keys.values(),
      this.#note,
    );
    this.#show();
  }

  /** @param {string} line */
  #createKey(line) {
    return h(
      "button",
      { type: "button", class: "curve-key", "data-line": line, onclick: () => this.#toggle(line) },
      h("span", { class: "curve-swatch" }),
      this.#text.short[line],
    );
  }

  /** @param {string} line */
  #toggle(line) {
    if (!this.#hidden.delete(line)) this.#hidden.add(line);
    keep(KEY, JSON.stringify([...this.#hidden]));
    this.#show();
    if (line === "all") this.#onShow();
  }

  /** Whether there are curves, and a person can see them. */
  get visible() {
    return !this.#hidden.has("all") && this.legend.checkVisibility();
  }

  /** @param {boolean} truth whether the recording has truth */
  setTruth(truth) {
    this.#truth = truth;
    this.#show();
  }

  #show() {
    const shown = !this.#hidden.has("all");
    this.#all.setAttribute("aria-pressed", String(shown));
    for (const [line, key] of this.#keys) {
      key.setAttribute("aria-pressed", String(!this.#hidden.has(line)));
      key.hidden = !shown || (!this.#truth && LINES.indexOf(line) >= WITHOUT_TRUTH);
    }
    this.#note.hidden = !shown;
    for (const curve of this.#curves.values()) {
      curve.element.hidden = !shown;
      curve.showOnly(this.#hidden);
    }
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#curves = new Map(
      knobs.map((knob) => [knob.name, createCurve(knob, this.#text, (value) => this.#onSet(knob.name, value))]),
    );
    for (const [name, curve] of this.#curves) this.#row(name)?.element.append(curve.element);
    this.#show();
  }

  /** @param {import("../wire.js").Params} params */
  setParams(params) {
    for (const [name, value] of Object.entries(params)) {
      const row = this.#row(name);
      if (row) this.#curves.get(name)?.mark(value, row.knob);
    }
  }

  pending() {
    setText(this.#note, this.#text.pending);
  }

  /** @param {import("../wire.js").Answer} answer */
  receive({ curves, frames, of, message, done }) {
    if (message) setText(this.#note, message);
    if (done || !curves) return;
    setText(this.#note, this.#text.sample(frames ?? 0, of ?? 0));
    for (const [name, curve] of Object.entries(curves)) this.#curves.get(name)?.set(curve);
  }
}
