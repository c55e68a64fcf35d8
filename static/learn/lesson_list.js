// @ts-check
// The list of lessons, with a mark at completed ones.
import { chooseFile } from "../open/files.js";
import { drawText } from "../text/draw.js";
import { h } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { download } from "../widgets/clipboard.js";
import { symbols } from "../widgets/symbols.js";
import { toast } from "../widgets/toast.js";
import { Progress } from "./progress.js";

/** @typedef {import("./lessons.js").Lesson} Lesson */

export class LessonList {
  /** @type {Lesson[]} */ #lessons = [];
  /** Says why there are no lessons. */
  trouble = h("div");
  progress = new Progress();
  #progressText;
  #text;
  #onOpen;
  #broken = h("div", { class: "panel-error", role: "alert" });
  #items = h("ol", { class: "lesson-list" });

  /**
   * @param {typeof import("../text/learn.js").learnText} words
   * @param {import("./glossary.js").Glossary} glossary
   * @param {{onOpen: (id: string) => void, onDraw: () => void, onMake: () => void}} handlers onDraw: the user wants to draw a world, onMake: to make a lesson
   */
  constructor({ lesson: text, progress }, glossary, { onOpen, onDraw, onMake }) {
    this.#text = text;
    this.#progressText = progress;
    const quiet = (/** @type {string} */ label, /** @type {string} */ title, /** @type {() => void} */ onclick) =>
      h("button", { type: "button", class: "button quiet", title, onclick }, label);
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
      h(
        "div",
        { class: "overview-foot" },
        quiet(progress.save, progress.saveHint, () => this.save()),
        quiet(progress.open, "", () => chooseFile(async ([file]) => file && this.read(await file.text()))),
      ),
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
    const done = this.progress.isDone(id);
    const mark = done ? [icon("check"), h("span", { class: "off-screen" }, this.#text.doneMark)] : [];
    return h(
      "button",
      { type: "button", class: "lesson-item", "data-lesson": id, onclick: () => this.#onOpen(id) },
      h("span", { class: "lesson-item-title" }, ...symbols(title), ...mark),
      h("span", { class: "muted" }, ...symbols(about)),
    );
  }

  /** What was answered, right or not. @param {Lesson} lesson @param {string} answer @param {boolean} right */
  note(lesson, answer, right) {
    this.progress.note(lesson, answer, right);
  }

  /** Saves what was answered as a file. */
  save() {
    download(this.#progressText.file, this.progress.file());
  }

  /** What was saved before. @param {string} text */
  read(text) {
    toast(this.progress.read(text, this.#progressText));
    this.show();
  }
}
