// @ts-check
// The pseudocode of the methods that split (splitting.json); the line of the current decision is highlighted.
import { h, setText } from "../widgets/dom.js";
import { fetchInto } from "./fetched.js";
import { rich } from "./listing.js";

/** @typedef {{text: string, indent?: number, kinds?: string[]}} Line */

export class SplitListing {
  element = h("section", { class: "listing split-listing", hidden: true });
  #lines = h("ol", { class: "code-lines" });
  #title = h("h3");
  /** @type {Record<string, Line[]>} */ #methods = {};
  /** @type {Map<string, HTMLElement>} */ #rows = new Map();
  #method = "";
  #kind = "";

  /** @param {typeof import("../text/learn.js").learnText.listing} text */
  constructor(text) {
    const trouble = h("div");
    this.element.setAttribute("aria-label", text.label);
    this.element.append(this.#title, trouble, this.#lines);
    const url = new URL("./splitting.json", import.meta.url).href;
    fetchInto(trouble, url, text, (/** @type {Record<string, Line[]>} */ methods) => {
      this.#methods = methods;
      const [method, kind] = [this.#method, this.#kind];
      this.#method = "";
      this.setMethod(method, this.#title.textContent ?? "");
      this.light(kind);
    });
  }

  /** @param {string} method its name; hidden if it does not split @param {string} label */
  setMethod(method, label) {
    if (method === this.#method) return;
    this.#method = method;
    setText(this.#title, label);
    const lines = this.#methods[method] ?? [];
    this.element.hidden = !lines.length;
    this.#rows.clear();
    this.#lines.replaceChildren(
      ...lines.map(({ text: words, indent = 0, kinds = [] }) => {
        const row = h("li", { class: "code-line" }, h("span", { class: `pc indent-${indent}` }, ...rich(words)));
        for (const kind of kinds) this.#rows.set(kind, row);
        return row;
      }),
    );
  }

  /** Highlights the line of a decision. @param {string} kind */
  light(kind) {
    this.#kind = kind;
    const lit = this.#rows.get(kind);
    for (const row of this.#lines.children) {
      row.classList.toggle("lit", row === lit);
      if (row === lit) row.setAttribute("aria-current", "step");
      else row.removeAttribute("aria-current");
    }
  }
}
