// @ts-check
// Terms and symbols: marked where a text first uses them, explained on hover, focus and touch, and all in one list.
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { symbols } from "../widgets/symbols.js";
import { hideTooltip, tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").ExplainedTerm} Term */
/** @typedef {typeof import("../text/learn.js").learnText.glossary} Text */
/** Marks terms in a text; those that were already marked are left alone. @typedef {(words: string) => (Node | string)[]} Mark */

export class Glossary {
  #text;
  #onLesson;
  /** @type {Term[]} */ #terms = [];
  /** @type {{id: string, title: string}[]} */ #lessons = [];
  /** @type {Map<string, Term>} */ #byForm = new Map();
  /** @type {RegExp | null} */ #pattern = null;

  /** @param {Text} text @param {(id: string) => void} onLesson */
  constructor(text, onLesson) {
    this.#text = text;
    this.#onLesson = onLesson;
  }

  /** @param {Term[]} terms @param {{id: string, title: string}[]} lessons */
  set(terms, lessons) {
    this.#terms = terms;
    this.#lessons = lessons;
    this.#byForm = new Map(terms.flatMap((term) => term.forms.map((form) => [form, term])));
    const forms = [...this.#byForm.keys()].sort((one, other) => other.length - one.length);
    const escaped = forms.map((form) => form.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
    this.#pattern = forms.length ? new RegExp(`(?<![\\w′])(${escaped.join("|")})(?![\\w′])`, "u") : null;
  }

  /** A function for the texts of one page. @returns {Mark} */
  page() {
    /** @type {Set<Term>} */
    const seen = new Set();
    return (words) => {
      const parts = this.#pattern ? words.split(new RegExp(this.#pattern, "gu")) : [words];
      return parts.flatMap((part, k) => {
        const term = k % 2 ? this.#byForm.get(part) : undefined;
        if (!term || seen.has(term)) return symbols(part);
        seen.add(term);
        return [this.#marked(part, term)];
      });
    };
  }

  /** @param {string} words @param {Term} term */
  #marked(words, term) {
    const mark = h("button", { type: "button", class: "term" }, ...symbols(words));
    mark.addEventListener("click", () => {
      hideTooltip(mark);
      this.open(term);
    });
    tooltip(mark, () => `${plain(term.text)}${term.equation ? ` (${term.equation})` : ""}`);
    return mark;
  }

  /** A button that opens the list. */
  button() {
    return h("button", { type: "button", class: "button quiet", onclick: () => this.open() }, this.#text.open);
  }

  /** Opens the list of all terms. @param {Term} [at] scrolled to, and lit */
  open(at) {
    const entries = this.#terms.map((term) => this.#entry(term, term === at));
    const dialog = openDialog(this.#text.title, this.#text.close, h("dl", { class: "glossary" }, ...entries));
    dialog.addEventListener("click", (event) => {
      const id = /** @type {Element} */ (event.target).getAttribute("data-to-lesson");
      if (!id) return;
      dialog.close();
      this.#onLesson(id);
    });
    dialog.querySelector(".glossary-entry.lit")?.scrollIntoView({ block: "center" });
  }

  /** @param {Term} term @param {boolean} lit */
  #entry({ name, text, equation, lesson }, lit) {
    const number = this.#lessons.findIndex(({ id }) => id === lesson);
    return h(
      "div",
      { class: lit ? "glossary-entry lit" : "glossary-entry" },
      h("dt", {}, ...symbols(name)),
      h(
        "dd",
        {},
        ...symbols(text),
        h("span", { class: "muted" }, equation ? ` ${equation}` : ""),
        number < 0
          ? null
          : h(
              "button",
              { type: "button", class: "button quiet", "data-to-lesson": lesson },
              this.#text.lesson(number + 1),
            ),
      ),
    );
  }
}

/** Without the signs for indices, since a tooltip is plain text. @param {string} words */
function plain(words) {
  return words.replace(/([A-Za-zαγ]′?)_([a-z0-9]+)/gu, "$1$2");
}
