// @ts-check
// The pseudocode; the line of the current decision is highlighted (listing.json says which).
import { h, scrollInPanel, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { symbols } from "../widgets/symbols.js";
import { eventName } from "./trace.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {{text: string, indent?: number, events?: string[], note?: string, extension?: boolean, needs?: string}} ListingLine needs: a threshold that, at 0, turns the line off */
/** @typedef {{phase: string, title: string, lines: ListingLine[]}} Algorithm */

const KEYWORDS = /^(for|each|while|if|else|otherwise|return|stop|repeat|drop|keep|try)$/;

export class Listing {
  #text;
  #algorithms;
  /** The line of each event. @type {Map<string, HTMLElement>} */ #lines = new Map();
  /** Lines that a threshold turns off. @type {[string, HTMLElement][]} */ #needing = [];
  #values;
  #buttons;
  #blocks;
  /** @type {HTMLElement | null} */ #lit = null;

  /**
   * @param {Algorithm[]} algorithms
   * @param {typeof import("../text/learn.js").learnText.listing} text
   */
  constructor(algorithms, text) {
    this.#text = text;
    this.#algorithms = algorithms;
    this.#values = h("dl", { class: "values", "aria-label": text.values });
    this.#buttons = algorithms.map(({ phase }) =>
      h(
        "button",
        { type: "button", class: "chip", "aria-pressed": "false", onclick: () => this.open(phase) },
        text.tabs[phase],
      ),
    );
    this.#blocks = algorithms.map((algorithm) => this.#createBlock(algorithm));
    this.element = h(
      "section",
      { class: "listing", "aria-label": text.label },
      h("div", { class: "chips", role: "group", "aria-label": text.label }, ...this.#buttons),
      this.#values,
      ...this.#blocks,
    );
    this.open(algorithms[0].phase);
  }

  /** @param {Algorithm} algorithm */
  #createBlock({ phase, title, lines }) {
    const { misprint, extension } = this.#text;
    const notes = lines.flatMap(({ note }) => note ?? []);
    const rows = lines.map(({ text: words, indent = 0, events = [], note, extension: extended, needs }, k) => {
      const row = h(
        "li",
        { class: "code-line", "data-line": `${phase} ${k + 1}` },
        h("span", { class: `pc indent-${indent}` }, ...rich(words)),
        extended ? h("span", { class: "code-tag" }, extension) : null,
        note ? noteMark(notes.indexOf(note), note, phase, misprint) : null,
        h("span", { class: "code-value" }),
      );
      for (const event of events) this.#lines.set(event, row);
      if (needs) this.#needing.push([needs, row]);
      return row;
    });
    const items = notes.map((note, k) => h("li", { id: `note-${phase}-${k}` }, ...symbols(note)));
    for (const { needs, note } of lines) if (needs && note) this.#needing.push([needs, items[notes.indexOf(note)]]);
    return h(
      "div",
      { class: "algorithm", "data-phase": phase },
      h("h3", {}, title),
      h("ol", { class: "code-lines" }, ...rows),
      notes.length ? h("details", { class: "misprints" }, h("summary", {}, misprint), h("ol", {}, ...items)) : null,
    );
  }

  /** Shows an algorithm. @param {string} phase */
  open(phase) {
    this.#algorithms.forEach((algorithm, k) => {
      this.#blocks[k].hidden = algorithm.phase !== phase;
      this.#buttons[k].setAttribute("aria-pressed", String(algorithm.phase === phase));
    });
  }

  /**
   * @param {Event | null} event
   * @param {[string, string][]} now name and value of each variable
   * @param {string} compared what the lit line compares, with its numbers
   * @param {boolean} follow whether the lit line is brought into sight
   * @param {import("../wire.js").Params} params
   */
  set(event, now, compared, follow, params) {
    for (const [name, row] of this.#needing) row.hidden = params[name] === 0;
    this.#values.replaceChildren(
      ...now.map(([name, value]) => h("div", {}, h("dt", {}, ...symbols(name)), h("dd", {}, value))),
    );
    this.#values.hidden = now.length === 0;
    const before = this.#lit;
    if (before) darken(before);
    this.#lit = event ? (this.#lines.get(eventName(event)) ?? null) : null;
    if (event) this.open(event.phase);
    if (!this.#lit) return;
    this.#lit.classList.add("lit");
    this.#lit.setAttribute("aria-current", "step");
    // Scrolling forces a layout, so it is not done at every step.
    if (follow && this.#lit !== before) scrollInPanel(this.#lit);
    setText(/** @type {Element} */ (this.#lit.querySelector(".code-value")), compared);
  }
}

/** @param {HTMLElement} line */
function darken(line) {
  line.classList.remove("lit");
  line.removeAttribute("aria-current");
  setText(/** @type {Element} */ (line.querySelector(".code-value")), "");
}

/** @param {number} k @param {string} note @param {string} phase @param {string} misprint */
function noteMark(k, note, phase, misprint) {
  const mark = h("button", { type: "button", class: "note-mark", "aria-label": `${misprint}: ${note}` });
  mark.setAttribute("aria-describedby", `note-${phase}-${k}`);
  tooltip(mark, note, "left");
  return mark;
}

/** Words of a line of code: keywords bold, symbols set as in the paper. @param {string} words */
export function rich(words) {
  return words.split(/(\s+)/).flatMap((word) => {
    const bare = word.replace(/,$/, "");
    return KEYWORDS.test(bare) ? [h("b", {}, bare), word.slice(bare.length)] : symbols(word);
  });
}
