// @ts-check
// Fields for typing the numbers of a thing of the world.
import { h } from "../widgets/dom.js";
import { createNumberField } from "../widgets/number.js";

/** @typedef {import("./world.js").Kind} Kind */

export class Fields {
  element = h("div", { class: "draw-fields" });
  #text;
  #onNumber;
  /** @type {Kind | null} */ #kind = null;
  /** @type {ReturnType<typeof createNumberField>[]} */ #fields = [];

  /** @param {typeof import("../text/draw.js").drawText} text @param {(place: number, value: number) => void} onNumber */
  constructor(text, onNumber) {
    this.#text = text;
    this.#onNumber = onNumber;
  }

  /** @param {Kind} kind @param {number[]} numbers */
  set(kind, numbers) {
    if (this.#kind !== kind) this.#create(kind);
    for (const [k, field] of this.#fields.entries())
      if (document.activeElement !== field.element) field.set(String(Number((numbers[k] ?? 0).toFixed(3))));
  }

  /** @param {Kind} kind */
  #create(kind) {
    const names = this.#text.fields[kind];
    this.#kind = kind;
    this.#fields = names.map(([name, unit], k) => this.#createField(`${name} [${unit}]`, k));
    this.element.replaceChildren(
      ...names.map(([name, unit], k) => {
        const { element, error } = this.#fields[k];
        const [label, of] = [h("span", { class: "muted" }, name), h("span", { class: "muted" }, unit)];
        return h("label", { class: "draw-field" }, label, element, of, error);
      }),
    );
  }

  /** @param {string} label @param {number} k */
  #createField(label, k) {
    const field = createNumberField({
      label,
      accept: (typed) => {
        const value = Number(typed);
        if (typed === "" || !Number.isFinite(value)) return this.#text.notANumber(typed);
        field.set(typed);
        this.#onNumber(k, value);
        return null;
      },
    });
    return field;
  }
}
