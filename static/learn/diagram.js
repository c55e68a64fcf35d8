// @ts-check
// The block diagram of the method (Fig. 3): the block of the present decision is lit, and each leads to its lesson.
import { h } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {typeof import("../text/learn.js").learnText.diagram} Text */
/** @typedef {import("./trace.js").Event} Event */

/** Each block: the lesson about it. @type {[keyof Text["blocks"], string][]} */
const BLOCKS = [
  ["fit", "13_least_squares"],
  ["seed", "01_seed"],
  ["growth", "03_growth"],
  ["enough", "08_how_much"],
  ["overlap", "05_corner"],
  ["endpoints", "06_endpoints"],
  ["segments", "16_correctness"],
];
const OF_LINES = new Set(["line kept", "line dropped"]);

export class Diagram {
  #blocks;

  /** @param {Text} text @param {(lesson: string) => void} onLesson */
  constructor(text, onLesson) {
    this.#blocks = new Map(
      BLOCKS.map(([name, lesson]) => {
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

  /** @param {Event | null} event the decision that is shown, or null for the whole result */
  light(event) {
    const lit = !event ? "segments" : event.phase === "growth" && OF_LINES.has(event.kind) ? "enough" : event.phase;
    for (const [name, block] of this.#blocks) {
      block.classList.toggle("lit", name === lit);
      if (name === lit) block.setAttribute("aria-current", "step");
      else block.removeAttribute("aria-current");
    }
  }
}
