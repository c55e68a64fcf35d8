// @ts-check
// The tabs of the panel. Some exist in one mode only.
import { h, setText } from "../widgets/dom.js";

/** mode: the only one in which it is there. @typedef {{name: string, label: string, content: HTMLElement, mode?: string}} Page */

export class Tabs {
  #pages;
  /** @type {HTMLButtonElement[]} */ #buttons;
  /** @type {Map<string, HTMLElement>} */ #counts;
  #mode = "";

  /** @param {Page[]} pages */
  constructor(pages) {
    this.#pages = pages;
    this.#counts = new Map(pages.map(({ name }) => [name, h("span", { class: "count" })]));
    this.#buttons = pages.map((page, k) => this.#createButton(page, k));
    for (const { name, content } of pages) {
      content.classList.add("panel-page");
      content.id = `page-${name}`;
      content.setAttribute("role", "tabpanel");
      content.setAttribute("aria-labelledby", `tab-${name}`);
    }
    this.bar = h("div", { class: "tabs", role: "tablist" }, ...this.#buttons);
    this.bar.addEventListener("keydown", (event) => this.#walk(event));
  }

  /** @param {Page} page @param {number} k */
  #createButton({ name, label }, k) {
    const names = { role: "tab", id: `tab-${name}`, "aria-controls": `page-${name}` };
    const onclick = () => this.#choose(k);
    return h("button", { type: "button", class: "tab", ...names, onclick }, label, this.#counts.get(name));
  }

  /** @param {KeyboardEvent} event */
  #walk(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const there = this.#buttons.filter((button) => !button.hidden);
    const at = there.findIndex((button) => button.ariaSelected === "true");
    const next = there[(at + step + there.length) % there.length];
    this.#choose(this.#buttons.indexOf(next));
    next.focus();
  }

  /** @param {number} chosen */
  #choose(chosen) {
    for (const [k, button] of this.#buttons.entries()) {
      button.setAttribute("aria-selected", String(k === chosen));
      button.tabIndex = k === chosen ? 0 : -1;
      this.#pages[k].content.hidden = k !== chosen;
    }
  }

  get contents() {
    return this.#pages.map(({ content }) => content);
  }

  /** @param {string} mode of the page */
  setMode(mode) {
    if (mode === this.#mode) return;
    this.#mode = mode;
    for (const [k, button] of this.#buttons.entries()) button.hidden = (this.#pages[k].mode ?? mode) !== mode;
    this.#choose(this.#buttons.findIndex((button) => !button.hidden));
  }

  /** @param {string} name */
  open(name) {
    this.#choose(this.#pages.findIndex((page) => page.name === name));
  }

  /** @param {string} name @param {number} count */
  setCount(name, count) {
    const badge = this.#counts.get(name);
    if (badge) setText(badge, String(count));
  }
}
