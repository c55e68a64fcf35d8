// @ts-check
// What auto-tuning maximises, over which thresholds, with how many trials.
import { h } from "../widgets/dom.js";

/** @typedef {import("../wire.js").Knob} Knob */

const QUALITY = ["epsilon", "delta", "seed_points"];
const TRIALS = [50, 100, 200, 500];
const USUAL_TRIALS = 100;

export class AutoChoices {
  /** @type {Knob[]} */ #knobs = [];
  #objective;
  #count;
  #boxes;
  /** Whether a person has chosen the objective. */ #chosen = false;

  /** @param {typeof import("../text/tuning.js").tuningText.auto} text @param {() => void} onObjective */
  constructor(text, onObjective) {
    this.#objective = h(
      "select",
      { class: "select", "aria-label": text.objective },
      ...Object.entries(text.objectives).map(([value, label]) => h("option", { value }, label)),
    );
    this.#objective.addEventListener("change", () => {
      this.#chosen = true;
      this.#tickUsual();
      onObjective();
    });
    this.#count = h(
      "select",
      { class: "select", "aria-label": text.trials },
      ...TRIALS.map((n) => h("option", { value: String(n), selected: n === USUAL_TRIALS }, String(n))),
    );
    this.#boxes = h("div", { class: "auto-thresholds", role: "group", "aria-label": text.thresholds });
    const trials = h("span", { class: "muted" }, text.trials);
    this.elements = [h("div", { class: "auto-choices" }, this.#objective, this.#count, trials), this.#boxes];
  }

  /** @returns {HTMLInputElement[]} */
  get #ticks() {
    return [...this.#boxes.querySelectorAll("input")];
  }

  #tickUsual() {
    for (const box of this.#ticks) {
      const knob = this.#knobs.find(({ name }) => name === box.value);
      box.checked = this.#objective.value === "truth" ? !knob?.extension : QUALITY.includes(box.value);
    }
  }

  /** The request to the server. */
  get wish() {
    const thresholds = this.#ticks.filter(({ checked }) => checked).map(({ value }) => value);
    return { objective: this.#objective.value, thresholds, trials: Number(this.#count.value) };
  }

  /** @param {boolean} locked while trials are running */
  lock(locked) {
    for (const control of [this.#objective, this.#count, ...this.#ticks]) control.disabled = locked;
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#boxes.replaceChildren(
      ...knobs.map(({ name, symbol }) => h("label", {}, h("input", { type: "checkbox", value: name }), symbol)),
    );
    this.#tickUsual();
  }

  /** Selects the truth as objective if there is any, until a person chooses another. @param {boolean} truth @param {boolean} running */
  setTruth(truth, running) {
    const objective = this.#objective;
    for (const option of objective.options) option.disabled = option.value === "truth" && !truth;
    if (running || (this.#chosen && (truth || objective.value !== "truth"))) return;
    const usual = truth ? "truth" : "label-free";
    if (objective.value === usual) return;
    objective.value = usual;
    this.#tickUsual();
  }
}
