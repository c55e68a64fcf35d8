// @ts-check
// The current decision: its phase, its sentence, and what it compared.
import { steppingText } from "../text/stepping.js";
import { h, sentenceCase, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createVersus } from "../widgets/versus.js";
import { fillWords, plain } from "../widgets/words.js";

/** @typedef {Parameters<ReturnType<typeof createVersus>["set"]>[0]} Compared */

export class Decision {
  #phase = h("span", { class: "phase" });
  #sentence = h("p", { class: "decision", "aria-live": "polite", "aria-atomic": "true" });
  #versus = createVersus();
  /** @type {import("../widgets/words.js").Pointing | null} */ #pointing = null;
  #mark = (/** @type {string} */ words) => /** @type {(Node | string)[]} */ ([words]);

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

  /** The words of sentences in parts can be pointed at. @param {import("../widgets/words.js").Pointing} pointing */
  linkTo(pointing) {
    this.#pointing = pointing;
  }

  /** Terms in plain sentences are explained. @param {(words: string) => (Node | string)[]} mark */
  explainWith(mark) {
    this.#mark = mark;
  }

  /** @param {string} phase @param {string | import("../wire.js").Words} sentence @param {Compared} compared */
  set(phase, sentence, compared) {
    setText(this.#phase, steppingText.phases[phase] ?? sentenceCase(phase));
    this.#phase.dataset.phase = phase;
    if (this.#pointing && typeof sentence !== "string") fillWords(this.#sentence, sentence, this.#pointing);
    else if (this.#sentence.textContent !== plain(sentence))
      this.#sentence.replaceChildren(...this.#mark(plain(sentence)));
    this.#versus.set(compared);
  }

  /** Nobody can listen to several sentences a second; the last one is read when playing ends. @param {boolean} playing */
  hush(playing) {
    this.#sentence.setAttribute("aria-live", playing ? "off" : "polite");
  }
}
