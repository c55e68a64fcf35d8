// @ts-check
// The pseudocode, with the line lit that the present decision comes from (listing.json says which).
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { symbols } from "./symbols.js";
import { eventName } from "./trace.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {{text: string, indent?: number, events?: string[], note?: string, extension?: boolean}} ListingLine */
/** @typedef {{phase: string, title: string, lines: ListingLine[]}} Algorithm */

const KEYWORDS = /^(for|each|while|if|else|otherwise|return|stop|repeat|drop|keep|try)$/;

/**
 * @param {Algorithm[]} algorithms
 * @param {typeof import("../text/learn.js").learnText.listing} text
 */
export function createListing(algorithms, text) {
  /** @type {Map<string, HTMLElement>} */
  const lines = new Map();
  const blocks = algorithms.map((algorithm) => createBlock(algorithm));
  const values = h("dl", { class: "values", "aria-label": text.values });
  const buttons = algorithms.map(({ phase }) =>
    h(
      "button",
      { type: "button", class: "chip", "aria-pressed": "false", onclick: () => choose(phase) },
      text.tabs[phase],
    ),
  );
  const element = h(
    "section",
    { class: "listing", "aria-label": text.label },
    h("div", { class: "chips", role: "group", "aria-label": text.label }, ...buttons),
    values,
    ...blocks.map(({ block }) => block),
  );
  /** @type {HTMLElement | null} */
  let lit = null;
  choose(algorithms[0].phase);

  /** @param {Algorithm} algorithm */
  function createBlock({ phase, title, lines: code }) {
    const notes = code.filter(({ note }) => note);
    const rows = code.map(({ text: words, indent = 0, events = [], note, extension }, k) => {
      const mark = note
        ? noteMark(
            notes.findIndex((line) => line.note === note),
            note,
            phase,
          )
        : null;
      const row = h(
        "li",
        { class: "code-line", "data-line": `${phase} ${k + 1}` },
        h("span", { class: `pc indent-${indent}` }, ...rich(words)),
        extension ? h("span", { class: "code-tag" }, text.extension) : null,
        mark,
        h("span", { class: "code-value" }),
      );
      for (const event of events) lines.set(event, row);
      return row;
    });
    const list = notes.map(({ note = "" }, k) => h("li", { id: `note-${phase}-${k}` }, ...symbols(note)));
    const block = h(
      "div",
      { class: "algorithm", "data-phase": phase },
      h("h3", {}, title),
      h("ol", { class: "code-lines" }, ...rows),
      notes.length ? h("details", { class: "misprints" }, h("summary", {}, text.misprint), h("ol", {}, ...list)) : null,
    );
    return { phase, block };
  }

  /** @param {number} k @param {string} note @param {string} phase */
  function noteMark(k, note, phase) {
    const letter = "abcdef"[k];
    const mark = h("button", { type: "button", class: "note-mark", "aria-label": `${text.misprint}: ${note}` }, letter);
    mark.setAttribute("aria-describedby", `note-${phase}-${k}`);
    tooltip(mark, note, "left");
    return mark;
  }

  /** @param {string} phase */
  function choose(phase) {
    for (const block of blocks) block.block.hidden = block.phase !== phase;
    buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(algorithms[k].phase === phase)));
  }

  return {
    element,
    /**
     * @param {Event | null} event
     * @param {[string, string][]} now name and value of each variable
     * @param {string} compared what the lit line compares, with its numbers
     */
    set(event, now, compared) {
      values.replaceChildren(
        ...now.map(([name, value]) => h("div", {}, h("dt", {}, ...symbols(name)), h("dd", {}, value))),
      );
      values.hidden = now.length === 0;
      const before = lit;
      if (lit) {
        lit.classList.remove("lit");
        lit.removeAttribute("aria-current");
        setText(/** @type {Element} */ (lit.querySelector(".code-value")), "");
      }
      lit = event ? (lines.get(eventName(event)) ?? null) : null;
      if (!event) return;
      choose(event.phase);
      if (!lit) return;
      lit.classList.add("lit");
      lit.setAttribute("aria-current", "step");
      // It lays the page out, so not at every step.
      if (lit !== before) lit.scrollIntoView({ block: "nearest" });
      setText(/** @type {Element} */ (lit.querySelector(".code-value")), compared);
    },
    /** Which line is lit, as "phase number"; for tests and lessons. */
    get lit() {
      return lit?.dataset.line ?? null;
    },
  };
}

/** Words of a line of code: keywords bold, symbols as the paper sets them. @param {string} words */
function rich(words) {
  return words.split(/(\s+)/).flatMap((word) => {
    const bare = word.replace(/,$/, "");
    return KEYWORDS.test(bare) ? [h("b", {}, bare), word.slice(bare.length)] : symbols(word);
  });
}
