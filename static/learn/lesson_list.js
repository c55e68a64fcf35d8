// @ts-check
// The list of lessons, with a mark at completed ones.
import { keep, recall } from "../kept.js";
import { drawText } from "../text/draw.js";
import { h } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { symbols } from "../widgets/symbols.js";

/** @typedef {import("./lessons.js").Lesson} Lesson */

const DONE_KEY = "lineseg.lessons";

export class LessonList {
  /** @type {Lesson[]} */ #lessons = [];
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
   * @param {{onOpen: (id: string) => void, onDraw: () => void, onMake: () => void}} handlers onDraw: the user wants to draw a world, onMake: to make a lesson
   */
  constructor(text, glossary, { onOpen, onDraw, onMake }) {
    this.#text = text;
    this.#onOpen = onOpen;
    const other = (/** @type {string} */ title, /** @type {string} */ hint, /** @type {() => void} */ onclick) =>
      h(
        "button",
        { type: "button", class: "lesson-item other", onclick },
        h("span", { class: "lesson-item-title" }, title),
        h("span", { class: "muted" }, hint),
      );
    this.element = h(
      "div",
      { class: "lesson-overview" },
      h("div", { class: "overview-head" }, h("h2", {}, text.overview), glossary.button()),
      h("p", { class: "hint" }, text.overviewHint),
      this.trouble,
      this.#broken,
      this.#items,
      other(drawText.open, drawText.openHint, onDraw),
      other(text.make, text.makeHint, onMake),
    );
  }

  /** @param {Lesson[]} lessons */
  set(lessons) {
    // Those that were dropped before these came stay.
    const dropped = this.#lessons.filter(({ id }) => lessons.every((each) => each.id !== id));
    this.#lessons = [...lessons, ...dropped];
    this.show();
  }

  /** @param {Lesson[]} lessons */
  add(lessons) {
    this.#lessons = [...this.#lessons.filter(({ id }) => lessons.every((each) => each.id !== id)), ...lessons];
    this.show();
  }

  /** @param {string} id */
  find(id) {
    return this.#lessons.find((each) => each.id === id);
  }

  get count() {
    return this.#lessons.length;
  }

  /** @param {Lesson} lesson */
  numberOf(lesson) {
    return this.#lessons.indexOf(lesson) + 1;
  }

  /** @param {Lesson} lesson @returns {Lesson | undefined} */
  after(lesson) {
    return this.#lessons[this.numberOf(lesson)];
  }

  /** @param {string} why */
  complain(why) {
    // The same link may be read more than once.
    if ([...this.#broken.children].some(({ textContent }) => textContent === why)) return;
    this.#broken.append(h("p", {}, why));
  }

  show() {
    this.#items.replaceChildren(...this.#lessons.map((lesson) => h("li", {}, this.#itemOf(lesson))));
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
    keep(DONE_KEY, JSON.stringify([...this.#done]));
  }
}

/** @returns {string[]} */
function load() {
  try {
    return JSON.parse(recall(DONE_KEY) ?? "[]");
  } catch {
    return [];
  }
}
