// @ts-check
// Terms and symbols: marked where a text first uses them, explained on hover, focus and touch, and all in one list.
// Another list has the questions that lessons answer.
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { symbols } from "../widgets/symbols.js";
import { hideTooltip, tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").ExplainedTerm} Term */
/** @typedef {Pick<import("../wire.js").NamedLesson, "id" | "title" | "steps">} Lesson */
/** @typedef {typeof import("../text/learn.js").learnText.glossary} Text */
/** Marks terms in a text; those that were already marked are left alone. @typedef {(words: string) => (Node | string)[]} Mark */

export class Glossary {
  #text;
  #onLesson;
  /** @type {Term[]} */ #terms = [];
  /** @type {Lesson[]} */ #lessons = [];
  /** @type {Map<string, Term>} */ #byForm = new Map();
  /** @type {RegExp | null} */ #pattern = null;

  /** @param {Text} text @param {(id: string, page?: number) => void} onLesson */
  constructor(text, onLesson) {
    this.#text = text;
    this.#onLesson = onLesson;
  }

  /** @param {Term[]} terms @param {Lesson[]} lessons */
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

  /** Buttons that open the lists. */
  buttons() {
    const quiet = (/** @type {string} */ words, /** @type {string} */ to, /** @type {() => void} */ onclick) =>
      h("button", { type: "button", class: `button quiet ${to}`, onclick }, words);
    return [
      quiet(this.#text.questions, "to-questions", () => this.ask()),
      quiet(this.#text.open, "to-terms", () => this.open()),
    ];
  }

  /** Opens the list of the questions that lessons answer. */
  ask() {
    const items = this.#lessons.flatMap(({ id, steps }, number) =>
      steps.flatMap(({ why }, page) => (why ? [this.#question(why, id, number, page)] : [])),
    );
    const dialog = openDialog(this.#text.questions, this.#text.close, h("ul", { class: "questions" }, ...items));
    dialog.addEventListener("click", (event) => {
      const chosen = /** @type {Element} */ (event.target).closest("[data-to-lesson]");
      if (!chosen) return;
      dialog.close();
      this.#onLesson(chosen.getAttribute("data-to-lesson") ?? "", Number(chosen.getAttribute("data-page")));
    });
  }

  /** @param {string} why @param {string} id of its lesson @param {number} number @param {number} page */
  #question(why, id, number, page) {
    const answer = h("button", { type: "button", class: "question", "data-to-lesson": id, "data-page": page });
    answer.append(h("span", {}, ...symbols(why)), h("span", { class: "muted" }, this.#text.lesson(number + 1)));
    return h("li", {}, answer);
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
