// @ts-check
// The current decision: its phase, its sentence, and what it compared.
import { steppingText } from "../text/stepping.js";
import { h, sentenceCase, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createVersus } from "../widgets/versus.js";

/** @typedef {Parameters<ReturnType<typeof createVersus>["set"]>[0]} Compared */

export class Decision {
  #phase = h("span", { class: "phase" });
  #sentence = h("p", { class: "decision", "aria-live": "polite", "aria-atomic": "true" });
  #versus = createVersus();

  /** @param {string} leave words of the way back to the whole result @param {() => void} onLeave @param {...Node} answers beside the sentence */
  constructor(leave, onLeave, ...answers) {
    this.leave = iconButton("close", leave, onLeave);
    this.element = h(
      "div",
      { class: "replay-said" },
      this.#phase,
      this.#sentence,
      ...answers,
      this.#versus.element,
      this.leave,
    );
  }

  /** @param {string} phase @param {string} sentence @param {Compared} compared */
  set(phase, sentence, compared) {
    setText(this.#phase, steppingText.phases[phase] ?? sentenceCase(phase));
    this.#phase.dataset.phase = phase;
    setText(this.#sentence, sentence);
    this.#versus.set(compared);
  }

  /** Nobody can listen to several sentences a second; the last one is read when playing ends. @param {boolean} playing */
  hush(playing) {
    this.#sentence.setAttribute("aria-live", playing ? "off" : "polite");
  }
}
