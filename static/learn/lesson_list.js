// @ts-check
// The list of lessons, with a mark at completed ones.
import { drawText } from "../text/draw.js";
import { h } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { symbols } from "../widgets/symbols.js";

/** @typedef {import("./lessons.js").Lesson} Lesson */

const DONE_KEY = "lineseg.lessons";

export class LessonList {
  /** @type {Lesson[]} */ lessons = [];
  /** Says why there are no lessons. */
  trouble = h("div");
  #done = new Set(load());
  #text;
  #onOpen;
  #broken = h("div", { class: "panel-error", role: "alert" });
  #items = h("ol", { class: "lesson-list" });

  /**
   * @param {typeof import("../text/learn.js").learnText.lesson} text
   * @param {import("./glossary.js").Glossary} glossary
   * @param {{onOpen: (id: string) => void, onDraw: () => void}} handlers onDraw: the user wants to draw a world
   */
  constructor(text, glossary, { onOpen, onDraw }) {
    this.#text = text;
    this.#onOpen = onOpen;
    const drawing = h(
      "button",
      { type: "button", class: "lesson-item", onclick: onDraw },
      h("span", { class: "lesson-item-title" }, drawText.open),
      h("span", { class: "muted" }, drawText.openHint),
    );
    this.element = h(
      "div",
      { class: "lesson-overview" },
      h("div", { class: "overview-head" }, h("h2", {}, text.overview), glossary.button()),
      h("p", { class: "hint" }, text.overviewHint),
      this.trouble,
      this.#broken,
      this.#items,
      drawing,
    );
  }

  /** @param {Lesson[]} lessons @param {string[]} broken why other files are not valid lessons */
  set(lessons, broken) {
    this.lessons = lessons;
    this.#broken.replaceChildren(...broken.map((why) => h("p", {}, why)));
    this.show();
  }

  /** @param {string} why */
  complain(why) {
    // The same link may be read more than once.
    if ([...this.#broken.children].some(({ textContent }) => textContent === why)) return;
    this.#broken.append(h("p", {}, why));
  }

  show() {
    this.#items.replaceChildren(...this.lessons.map((lesson) => h("li", {}, this.#itemOf(lesson))));
  }

  /** @param {Lesson} lesson */
  #itemOf({ id, title, about }) {
    const done = this.#done.has(id);
    const mark = done ? [icon("check"), h("span", { class: "off-screen" }, this.#text.doneMark)] : [];
    return h(
      "button",
      { type: "button", class: "lesson-item", "data-lesson": id, onclick: () => this.#onOpen(id) },
      h("span", { class: "lesson-item-title" }, ...symbols(title), ...mark),
      h("span", { class: "muted" }, ...symbols(about)),
    );
  }

  /** @param {string} id */
  markDone(id) {
    this.#done.add(id);
    localStorage.setItem(DONE_KEY, JSON.stringify([...this.#done]));
  }
}

/** @returns {string[]} */
function load() {
  try {
    return JSON.parse(localStorage.getItem(DONE_KEY) ?? "[]");
  } catch {
    return [];
  }
}
