// @ts-check
// Buttons that lead to the next decision of a kind.
import { h, setText } from "../widgets/dom.js";

/** Decisions of each kind, in order. @typedef {Record<string, number[] | undefined>} Marks */

export class Jumps {
  /** @type {Map<string, HTMLButtonElement>} */ #buttons;

  /** @param {[name: string, label: string][]} kinds @param {(name: string) => void} onJump */
  constructor(kinds, onJump) {
    this.#buttons = new Map(
      kinds.map(([name, label]) => [
        name,
        h("button", { type: "button", class: "button", "data-jump": name, onclick: () => onJump(name) }, label),
      ]),
    );
    this.element = h("span", { class: "jumps" }, ...this.#buttons.values());
  }

  get buttons() {
    return [...this.#buttons];
  }

  /** @param {string} name @param {string} label */
  rename(name, label) {
    const button = this.#buttons.get(name);
    if (button) setText(button, label);
  }

  /** Shows only these kinds. @param {Set<string>} names */
  offer(names) {
    for (const [name, button] of this.#buttons) button.hidden = !names.has(name);
  }

  /** @param {Marks} marks @param {number} at −1: before the first decision */
  set(marks, at) {
    for (const [name, button] of this.#buttons) button.disabled = (marks[name]?.at(-1) ?? -1) <= at;
  }
}
