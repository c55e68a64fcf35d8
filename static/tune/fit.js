// @ts-check
// What fits the laser of this recording: its noise as a picture, and thresholds that a person may take over.
import { h, setText } from "../widgets/dom.js";
import { withUnit } from "../widgets/scale.js";
import { pointerHeld } from "../widgets/slider.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";
import { limitAt } from "./limit.js";
import { createNoisePicture, reachOf, sigmaAt } from "./noise_picture.js";

/** @typedef {import("../wire.js").Answer} Answer */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").State} State */
/** onFits: the values that fit, by threshold, and whether they are better than the present ones. @typedef {{ask: () => void, stop: () => void, onParams: (params: Params) => void, onFits: (fits: Params, better: boolean) => void}} Handlers */

const PAUSE_MS = 250;

export class Fit {
  #text;
  #handlers;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Params} */ #params = {};
  /** The recording and the method that the answer is for. */ #place = "";
  /** What is to be asked for, and what was. */ #wanted = "";
  #asked = "";
  #timer = 0;
  /** @type {Answer | null} */ #answer = null;
  #says = h("p", { class: "fit-text", role: "status" });
  #use;
  #picture;
  #frame;

  /** @param {typeof import("../text/tuning.js").tuningText.fit} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.#picture = createNoisePicture(text);
    this.#frame = h("div", { class: "fit-picture" });
    this.#frame.append(this.#picture.element);
    tooltip(this.#frame, () => this.#picture.element.getAttribute("aria-label") ?? "", "left");
    this.#use = h("button", { type: "button", class: "button", onclick: () => this.#take() }, text.use);
    tooltip(this.#use, () => text.usesHelp(this.#listed()), "left");
    const words = h("div", { class: "fit-words" }, this.#says, this.#use);
    this.element = h("section", { class: "fit", "aria-label": text.label }, this.#frame, words);
    new ResizeObserver(() => this.#askIn(0)).observe(this.element);
    this.#show();
  }

  #take() {
    const values = this.#listed();
    this.#handlers.onParams(this.#answer?.fits ?? {});
    toast(this.#text.used(values));
  }

  /** What fits, in words. */
  #listed() {
    const fits = Object.entries(this.#answer?.fits ?? {});
    return fits.map(([name, value]) => this.#value(name, value)).join(", ");
  }

  /** @param {string} name @param {number} value */
  #value(name, value) {
    const knob = this.#knobs.find((each) => each.name === name);
    return knob ? `${knob.symbol.replace("_", " ")} = ${withUnit(knob, value)}` : "";
  }

  /** Whether something better than the present thresholds is known. */
  get #better() {
    const { fits, better } = this.#answer ?? {};
    return Boolean(better && Object.entries(fits ?? {}).some(([name, value]) => this.#params[name] !== value));
  }

  #show() {
    const { text, fits, scatter, noise, message } = this.#answer ?? {};
    const better = this.#better;
    const [first] = Object.keys(fits ?? {});
    const suits = first && this.#text.suits(this.#text.mm(scatter ?? 0), this.#value(first, this.#params[first]));
    setText(this.#says, this.#answer ? message || (better || !first ? text : suits) || "" : this.#text.measuring);
    this.#use.hidden = !better;
    this.element.classList.toggle("better", better);
    this.#frame.hidden = Boolean(this.#answer && !(noise && first));
    this.#draw();
  }

  #changed() {
    this.#show();
    this.#handlers.onFits(this.#answer?.fits ?? {}, this.#better);
  }

  #draw() {
    const { noise, fits } = this.#answer ?? {};
    const better = this.#better;
    const knob = this.#knobs.find(({ name }) => name === Object.keys(fits ?? {})[0]);
    if (!noise || !fits || !knob) return;
    const { mm, m, noise: scatter, bend, limit, proposed } = this.#text;
    const reach = reachOf(noise);
    const [now, then] = [this.#params, { ...this.#params, ...fits }].map((params) => limitAt(knob.name, params, reach));
    const parts = [scatter(mm(sigmaAt(noise, 1)), mm(sigmaAt(noise, reach)), m(reach))];
    if (noise.bend) parts.push(bend(mm(noise.bend)));
    parts.push(limit(knob.symbol.replace("_", " "), mm(now)));
    if (better) parts.push(proposed(mm(then)));
    this.#picture.set({ noise, knob, params: this.#params, fits: better ? fits : null }, parts.join("\n"));
  }

  /** @param {Knob[]} knobs of the chosen method */
  setKnobs(knobs) {
    this.#knobs = knobs;
  }

  /** @param {Params} params */
  setParams(params) {
    this.#params = params;
    this.#changed();
  }

  /** Asks again if something else is shown, but not while a slider moves. @param {State} state */
  setState({ place: scans, method, params, live, growing, frames }) {
    const place = JSON.stringify([scans, method]);
    // A recording that grows is looked at again when it has become twice as long.
    const size = live === null && !growing ? frames : Math.floor(Math.log2(frames));
    const wanted = JSON.stringify([place, params, size]);
    if (wanted === this.#wanted) return;
    if (place !== this.#place) this.#forget();
    this.#place = place;
    this.#wanted = wanted;
    if (this.#asked) this.#handlers.stop();
    this.#askIn(this.#answer ? PAUSE_MS : 0);
  }

  /** Asks, if it is visible and out of date. @param {number} wait [ms] */
  #askIn(wait) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      if (this.#asked === this.#wanted || !this.element.checkVisibility()) return;
      if (pointerHeld()) return this.#askIn(PAUSE_MS);
      this.#asked = this.#wanted;
      this.#handlers.ask();
    }, wait);
  }

  #forget() {
    this.#answer = null;
    this.#changed();
  }

  /** @param {Answer} answer */
  receive(answer) {
    if (answer.stopped || (answer.done && !answer.message)) return;
    this.#answer = answer;
    this.#changed();
  }

  get current() {
    return { text: this.#says.textContent, fits: this.#answer?.fits ?? null, better: !this.#use.hidden };
  }
}
