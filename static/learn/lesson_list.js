// @ts-check
// What Learn opens with: the block diagram of the method (Fig. 3), with the lessons of each block.
import { chooseFile } from "../widgets/choose_file.js";
import { drawText } from "../text/draw.js";
import { h } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { download } from "../widgets/clipboard.js";
import { symbols } from "../widgets/symbols.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";
import { BLOCKS, pictureOf, REPEATED } from "./blocks.js";
import { markLit } from "./diagram.js";
import { Progress } from "./progress.js";

/** @typedef {import("./lessons.js").Lesson} Lesson */
/** @typedef {import("./blocks.js").Block} Block */

// No arrow leads to these.
const FIRST = new Set(["fit", "seed", "methods"]);

export class LessonList {
  /** @type {Lesson[]} */ #lessons = [];
  /** Says why there are no lessons. */
  trouble = h("div");
  progress = new Progress();
  #progressText;
  #text;
  #diagramText;
  #onOpen;
  #broken = h("div", { class: "panel-error", role: "alert" });
  #begin = h("button", { type: "button", class: "button primary", hidden: true });
  #blocks = h("div", { class: "block-cards" });
  #rest = h("div");
  /** @type {Map<Block, HTMLElement>} */ #cards = new Map();
  /** @type {Block | null} */ #lit = null;

  /**
   * @param {typeof import("../text/learn.js").learnText} words
   * @param {import("./glossary.js").Glossary} glossary
   * @param {{onOpen: (id: string) => void, onDraw: () => void, onMake: () => void}} handlers onDraw: the user wants to draw a world, onMake: to make a lesson
   */
  constructor({ lesson: text, diagram, progress }, glossary, { onOpen, onDraw, onMake }) {
    this.#text = text;
    this.#diagramText = diagram;
    this.#progressText = progress;
    const quiet = (/** @type {string} */ label, /** @type {string} */ title, /** @type {() => void} */ onclick) =>
      h("button", { type: "button", class: "button quiet", title, onclick }, label);
    this.#onOpen = onOpen;
    const other = (/** @type {string} */ title, /** @type {string} */ hint, /** @type {() => void} */ onclick) =>
      h(
        "button",
        { type: "button", class: "lesson-item other", onclick },
        h("span", { class: "lesson-number" }, "+"),
        h("span", { class: "lesson-item-title" }, title),
        h("span", { class: "muted" }, hint),
      );
    this.element = h(
      "div",
      { class: "lesson-overview" },
      h("div", { class: "overview-head" }, h("h2", { class: "lesson-title" }, text.overview), ...glossary.buttons()),
      h("p", { class: "hint" }, text.overviewHint),
      this.trouble,
      this.#broken,
      h("div", { class: "overview-begin" }, this.#begin),
      this.#blocks,
      this.#rest,
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
    // Whoever came by a link may be in another mode.
    if (!this.#broken.checkVisibility()) toast(why);
  }

  show() {
    const names = [...BLOCKS.map(({ name }) => name), /** @type {const} */ ("methods")];
    this.#cards = new Map(names.map((name) => [name, this.#card(name)]));
    this.#blocks.replaceChildren(...this.#cards.values());
    const repeated = [...this.#cards].flatMap(([name, card]) => (REPEATED.includes(name) ? [card] : []));
    const loop = h("div", { class: "block-loop" });
    repeated[0].before(loop);
    loop.append(...repeated, h("span", { class: "block-loop-said" }, this.#diagramText.loop));
    const others = this.#lessons.filter(({ block }) => !block);
    this.#rest.replaceChildren(
      ...(others.length
        ? [h("h3", {}, this.#text.others), h("ol", { class: "lesson-list" }, ...this.#itemsOf(others))]
        : []),
    );
    this.#offer(this.#lessons.find(({ id }) => !this.progress.isDone(id)));
    this.light(this.#lit);
  }

  /** Offers to begin, or to go on. @param {Lesson | undefined} next */
  #offer(next) {
    this.#begin.hidden = !next;
    if (!next) return;
    const first = this.progress.done === 0;
    this.#begin.replaceChildren(...symbols(this.#text.begin(first, this.numberOf(next), next.title)));
    this.#begin.onclick = () => this.#onOpen(next.id);
  }

  /** One block with its lessons. @param {Block} name */
  #card(name) {
    const [label, about] = this.#diagramText.blocks[name];
    const lessons = this.#lessons.filter(({ block }) => block === name);
    const entry = BLOCKS.find((block) => block.name === name)?.lesson ?? lessons[0]?.id;
    return h(
      "section",
      { class: FIRST.has(name) ? "block-card" : "block-card follows", "data-block": name, "aria-label": label },
      h(
        "button",
        { type: "button", class: "block-head", onclick: () => this.#onOpen(entry) },
        pictureOf(name),
        h("span", { class: "block-title" }, label),
        h("span", { class: "muted" }, about),
      ),
      h("ol", { class: "lesson-list" }, ...this.#itemsOf(lessons)),
    );
  }

  /** Where one is in the method. @param {Block | null} lit */
  light(lit) {
    this.#lit = lit;
    for (const [name, card] of this.#cards) markLit(card, name === lit);
  }

  /** @param {Lesson[]} lessons */
  #itemsOf(lessons) {
    return lessons.map((lesson) => h("li", {}, this.#itemOf(lesson)));
  }

  /** @param {Lesson} lesson */
  #itemOf(lesson) {
    const { id, title, about } = lesson;
    const done = this.progress.isDone(id);
    const mark = done ? [icon("check"), h("span", { class: "off-screen" }, this.#text.doneMark)] : [];
    const item = h(
      "button",
      { type: "button", class: "lesson-item", "data-lesson": id, onclick: () => this.#onOpen(id) },
      h("span", { class: "lesson-number" }, String(this.numberOf(lesson))),
      h("span", { class: "lesson-item-title" }, ...symbols(title), ...mark),
    );
    tooltip(item, about);
    return item;
  }

  /** What was answered, right or not. @param {Lesson} lesson @param {string} answer @param {boolean} right */
  note(lesson, answer, right) {
    if (!this.progress.note(lesson, answer, right)) toast(this.#progressText.full);
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
