// @ts-check
// Auto-tuning: the trials as they arrive, which thresholds matter, and whether anything was gained.
import { h, setText } from "../widgets/dom.js";
import { withUnit } from "../widgets/scale.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";
import { AutoChoices } from "./auto_choices.js";
import { paintBars, TrialPictures } from "./trial_pictures.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Answer} Answer */
/** @typedef {import("../wire.js").Trial} Trial */
/** @typedef {import("./trial_pictures.js").Scored} Scored */
/** @typedef {{ask: (wish: object) => void, stop: () => void, onAdopt: (params: Params) => void}} Handlers */

export class Auto {
  #text;
  #handlers;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Trial[]} */ #trials = [];
  /** The thresholds that are tuned. @type {Knob[]} */ #tuned = [];
  #running = false;
  /** @type {Params | null} */ #best = null;
  #painting = 0;

  #choices;
  #start;
  #anew;
  #adopt;
  #says;
  #caution = h("p", { class: "auto-caution muted" });
  #verdict = h("p", { class: "auto-verdict", role: "status", hidden: true });
  #trouble = h("p", { class: "panel-error", role: "alert", hidden: true });
  #progress = h("span", { class: "muted" });
  #bars = h("div", { class: "auto-bars" });
  #pictures;

  /** @param {typeof import("../text/tuning.js").tuningText.auto} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.#choices = new AutoChoices(text, () => this.forget());
    const button = (/** @type {string} */ kind, /** @type {string} */ label, /** @type {() => void} */ run) =>
      h("button", { type: "button", class: `button ${kind}`.trim(), onclick: run }, label);
    this.#start = button("primary", text.start, () => (this.#running ? handlers.stop() : this.#begin(false)));
    this.#anew = button("quiet", text.anew, () => this.#begin(true));
    tooltip(this.#anew, text.anewHelp);
    this.#adopt = button("", text.adopt, () => this.#take());
    this.#anew.hidden = this.#adopt.hidden = true;
    this.#says = h("p", { class: "auto-text" }, text.intro);
    tooltip(this.#bars, text.importanceHelp, "left");
    this.#pictures = new TrialPictures(text, this.#bars);
    this.element = h(
      "div",
      { class: "auto-page" },
      ...this.#choices.elements,
      h("div", { class: "auto-foot" }, this.#start, this.#anew, this.#progress),
      this.#trouble,
      this.#says,
      this.#caution,
      this.#verdict,
      this.#adopt,
      this.#pictures.element,
    );
  }

  #take() {
    if (!this.#best) return;
    this.#handlers.onAdopt(this.#best);
    toast(this.#text.adopted);
  }

  /** Clears the trials for another recording or objective. */
  forget() {
    if (this.#running) this.#handlers.stop();
    this.#trials = [];
    this.#best = null;
    for (const part of [this.#verdict, this.#adopt, this.#pictures.element, this.#trouble, this.#anew])
      part.hidden = true;
    setText(this.#progress, "");
    setText(this.#says, this.#text.intro);
    setText(this.#caution, "");
    setText(this.#start, this.#text.start);
  }

  /** @param {boolean} anew without the trials of before */
  #begin(anew) {
    const { wish } = this.#choices;
    this.#tuned = this.#knobs.filter(({ name }) => wish.thresholds.includes(name));
    this.forget();
    this.#setRunning(true);
    this.#handlers.ask({ ...wish, anew });
  }

  /** @param {boolean} on */
  #setRunning(on) {
    const { stop, goOn, start } = this.#text;
    this.#running = on;
    setText(this.#start, on ? stop : this.#trials.length ? goOn : start);
    this.#choices.lock(on);
    this.#anew.hidden = on || !this.#trials.length;
  }

  #paintSoon() {
    this.#painting ||= requestAnimationFrame(() => {
      this.#painting = 0;
      this.#paint();
    });
  }

  #paint() {
    const scored = /** @type {Scored[]} */ (this.#trials.filter(({ score }) => score !== null));
    const progress = this.#text.progress(this.#trials.length);
    this.#pictures.element.hidden = !scored.length;
    setText(this.#progress, progress);
    if (!scored.length) return;
    this.#pictures.paint(scored, this.#tuned);
    const top = scored.reduce((one, other) => (other.score > one.score ? other : one));
    const values = this.#tuned.map((knob) => `${knob.symbol} ${withUnit(knob, top.params[knob.name])}`);
    this.#best = top.params;
    this.#adopt.hidden = false;
    setText(this.#progress, `${progress}, ${this.#text.best(top.score.toFixed(3))}`);
    setText(this.#adopt, `${this.#text.adopt}: ${values.join(", ")}`);
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#choices.setKnobs(knobs);
  }

  /** @param {boolean} truth whether the recording has truth */
  setTruth(truth) {
    this.#choices.setTruth(truth, this.#running);
  }

  /** @param {Answer} answer */
  receive({ text, caution, trials, importance, verdict, done, message }) {
    if (text) setText(this.#says, text);
    if (caution) setText(this.#caution, caution);
    if (trials) {
      this.#trials.push(...trials);
      this.#paintSoon();
    }
    if (importance) paintBars(this.#bars, importance, this.#knobs);
    if (verdict) {
      this.#verdict.hidden = false;
      this.#verdict.classList.toggle("gained", verdict.gained);
      setText(this.#verdict, verdict.text);
    }
    if (!done) return;
    this.#setRunning(false);
    this.#trouble.hidden = !message;
    setText(this.#trouble, message ?? "");
  }

  get current() {
    return {
      trials: this.#trials.length,
      running: this.#running,
      best: this.#best,
      verdict: this.#verdict.textContent,
    };
  }
}
