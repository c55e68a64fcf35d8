// @ts-check
// What a page of a lesson lets one try in its text (the field `show` of a page).
import { h } from "../widgets/dom.js";
import { Beside } from "./shown/beside.js";
import { createFits } from "./shown/fits.js";
import { Labelling } from "./shown/label.js";
import { createNoise } from "./shown/noise.js";
import { createTimes } from "./shown/times.js";

/** @typedef {typeof import("../text/shown.js").shownText} Text */
/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Knob} Knob */
/** set: called with each drawn state while it is shown. @typedef {{element: HTMLElement, set?: (state: State) => void}} Shown */
/** stored: whether the page stands alone; onLabel: so many frames are labelled. @typedef {{session: () => string, stored: boolean, knobs: () => Knob[], onLabel: (labelled: number) => void}} Places */

/** @type {Record<string, (text: Text, places: Places) => Shown>} */
const KINDS = {
  fits: (text) => createFits(text.fits),
  noise: (text, { session, knobs }) => createNoise(text.noise, session, knobs),
  times: (text, { session, stored }) => createTimes(text.times, session, stored),
  beside: (text, { session }) => new Beside(text.beside, session),
  label: (text, { session, onLabel }) => new Labelling(text.label, session, onLabel),
};

export class Showing {
  element = h("div", { class: "lesson-shown" });
  #text;
  #places;
  #kind = "";
  /** Each is made once, and keeps what was tried. @type {Map<string, Shown>} */ #made = new Map();

  /** @param {Text} text @param {Places} places */
  constructor(text, places) {
    this.#text = text;
    this.#places = places;
  }

  /** Whether there is anything, which then stays in sight. */
  get active() {
    return this.#kind !== "";
  }

  /** @param {string | null} kind */
  turn(kind) {
    if ((kind ?? "") === this.#kind) return;
    this.#kind = kind ?? "";
    if (kind && !this.#made.has(kind)) this.#made.set(kind, KINDS[kind](this.#text, this.#places));
    const shown = this.#made.get(this.#kind);
    this.element.replaceChildren(...(shown ? [shown.element] : []));
    this.element.parentElement?.scrollTo(0, 0);
  }

  /** @param {State} state */
  set(state) {
    this.#made.get(this.#kind)?.set?.(state);
  }
}
