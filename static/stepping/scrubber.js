// @ts-check
// The number of the current decision, to type or to drag.
import { steppingText as text } from "../text/stepping.js";
import { h, setText } from "../widgets/dom.js";
import { createNumberField } from "../widgets/number.js";
import { createSlider } from "../widgets/slider.js";

export class Scrubber {
  #count = 0;
  #total = h("span", { class: "of" });
  #number;
  #slider;

  /**
   * @param {{onGo: (at: number) => void, onMove: (by: number) => void}} handlers onMove: ±Infinity leads to the ends
   * @param {HTMLElement | null} backdrop behind the slider, instead of the colour left of its thumb
   */
  constructor({ onGo, onMove }, backdrop) {
    this.#number = createNumberField({
      label: text.number,
      className: "frame-number",
      accept: (typed) => {
        const wanted = Number(typed);
        if (!Number.isInteger(wanted) || wanted < 1 || wanted > this.#count) return text.range(this.#count);
        onGo(wanted - 1);
        return null;
      },
    });
    this.#slider = createSlider({
      label: text.scrubber,
      onPlace: (place) => onGo(Math.round(place * Math.max(0, this.#count - 1))),
      onSteps: onMove,
      fill: backdrop === null,
    });
    this.track = h("div", { class: "track" }, backdrop, this.#slider.element);
    this.counter = h("span", { class: "counter" }, this.#number.element, this.#total, this.#number.error);
  }

  /** @param {number | null} at null: the whole result @param {number} count of decisions */
  set(at, count) {
    this.#count = count;
    this.#number.set(at === null ? "–" : String(at + 1));
    this.#number.element.style.width = `${String(count).length + 2}ch`;
    setText(this.#total, text.of(count));
    const place = at !== null && count > 1 ? at / (count - 1) : 0;
    this.#slider.set(place, at === null ? text.phases.whole : `${at + 1} ${text.of(count)}`);
  }
}
