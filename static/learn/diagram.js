// @ts-check
// The block diagram of the method in one row, above lessons and replays: where one is in it is lit.
import { h } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { BLOCKS } from "./blocks.js";

/** @typedef {typeof import("../text/learn.js").learnText.diagram} Text */
/** @typedef {import("./blocks.js").Block} Block */

export class Diagram {
  #blocks;

  /** @param {Text} text @param {(lesson: string) => void} onLesson */
  constructor(text, onLesson) {
    this.#blocks = new Map(
      BLOCKS.map(({ name, lesson }) => {
        const [label, about] = text.blocks[name];
        const block = h("button", { type: "button", class: "block", onclick: () => onLesson(lesson) }, label);
        tooltip(block, about);
        return [name, block];
      }),
    );
    this.element = h(
      "nav",
      { class: "diagram", "aria-label": text.label },
      ...[...this.#blocks.values()].flatMap((block, k) => (k ? [h("span", { class: "arrow" }), block] : [block])),
    );
  }

  /** @param {Block | null} lit */
  light(lit) {
    for (const [name, block] of this.#blocks) markLit(block, name === lit);
  }
}

/** @param {HTMLElement} block @param {boolean} lit */
export function markLit(block, lit) {
  block.classList.toggle("lit", lit);
  if (lit) block.setAttribute("aria-current", "step");
  else block.removeAttribute("aria-current");
}
