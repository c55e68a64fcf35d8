// @ts-check
// All steps at once: every window tried, and the results over the whole range of one threshold.
import { h } from "../widgets/dom.js";
import { Sweep } from "./sweep.js";
import { Windows } from "./windows.js";

export class Ladder {
  #windows;
  #sweep;

  /**
   * @param {typeof import("../text/learn.js").learnText.ladder} text
   * @param {{session: () => string, onGo: (step: number) => void,
   *          onParams: (params: import("../wire.js").Params, gesture: string | null) => void}} handlers
   */
  constructor(text, { session, onGo, onParams }) {
    this.#windows = new Windows(text, onGo);
    this.#sweep = new Sweep(text, { session, onParams });
    this.element = h("div", { class: "ladder", hidden: true }, this.#windows.element, this.#sweep.element);
  }

  /** @param {boolean} on */
  show(on) {
    this.element.hidden = !on;
    this.#windows.draw();
    this.#sweep.show(on);
  }

  /** @param {import("../wire.js").Knob[]} knobs */
  setKnobs(knobs) {
    this.#sweep.setKnobs(knobs);
  }

  /** @param {import("./trace.js").Trace} trace */
  setTrace(trace) {
    this.#windows.setTrace(trace);
  }

  /** @param {import("../wire.js").State} state drawn, so that the server knows it too */
  setState(state) {
    this.#sweep.setState(state);
  }
}
