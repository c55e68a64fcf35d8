// @ts-check
// One page of a lesson: a text or the task, sliders, and the buttons to the next page.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { answersOf } from "./answers.js";
import { paragraphs, rich } from "./markup.js";
import { symbols } from "../widgets/symbols.js";

/**
 * @typedef {object} Page
 * @property {string} lesson its id
 * @property {string} words
 * @property {import("../wire.js").Task | null} task
 * @property {boolean} sliders whether they are shown
 * @property {number} at from 0
 * @property {number} count
 * @property {string} next label of the button to the next page
 */

export class Reader {
  #text;
  #answerText;
  #glossary;
  #mark;
  #onLesson;
  #onAnswer;
  #title = h("h2", { class: "lesson-title", tabIndex: -1 });
  #body = h("div", { class: "lesson-body", "aria-live": "polite" });
  #sliders = h("div", { class: "thresholds lesson-knobs" });
  #verdict = h("p", { class: "lesson-verdict", role: "status" });
  #hintWords = h("p", { class: "lesson-hint", role: "status", hidden: true });
  #answers = h("div");
  #lesson = "";
  #task = h("div", { class: "lesson-task" }, this.#answers, this.#verdict, this.#hintWords);
  #scroll = h("div", { class: "lesson-scroll" }, this.#body, this.#sliders, this.#task);
  #count = h("span", { class: "muted" });
  #hint;
  #back;
  #next;

  /**
   * @param {typeof import("../text/learn.js").learnText.lesson} text
   * @param {import("./glossary.js").Glossary} glossary
   * @param {typeof import("../text/learn.js").learnText.answers} answers
   * @param {{onLeave: () => void, onBack: () => void, onNext: () => void, onHint: () => void, onLesson: (id: string) => void,
   *          onAnswer: import("./answers.js").OnAnswer}} handlers
   */
  constructor(text, glossary, answers, { onLeave, onBack, onNext, onHint, onLesson, onAnswer }) {
    this.#text = text;
    this.#answerText = answers;
    this.#onLesson = onLesson;
    this.#onAnswer = onAnswer;
    this.#glossary = glossary;
    this.#mark = glossary.page();
    this.#hint = h("button", { type: "button", class: "button quiet", onclick: onHint }, text.hint);
    this.#back = h("button", { type: "button", class: "button", onclick: onBack }, text.back);
    this.#next = h("button", { type: "button", class: "button primary", onclick: onNext }, text.next);
    const spacer = h("span", { class: "spacer" });
    this.element = h(
      "div",
      { class: "lesson-reader", hidden: true },
      h("div", { class: "lesson-head" }, this.#title, ...glossary.buttons(), iconButton("close", text.close, onLeave)),
      this.#scroll,
      h("div", { class: "lesson-foot" }, this.#back, this.#count, spacer, this.#hint, this.#next),
    );
  }

  /** @param {string} title @param {HTMLElement[]} sliders */
  open(title, sliders) {
    this.element.hidden = false;
    this.#title.replaceChildren(...symbols(title));
    this.#sliders.replaceChildren(...sliders);
  }

  close() {
    this.element.hidden = true;
  }

  focus() {
    this.#title.focus();
  }

  /** @param {Page} page */
  show({ lesson, words, task, sliders, at, count, next }) {
    this.#mark = this.#glossary.page();
    this.#lesson = lesson;
    this.#body.replaceChildren(
      ...(task ? [h("h3", {}, this.#text.task)] : []),
      ...paragraphs(words, this.#mark, this.#of),
    );
    this.#answers.replaceChildren(
      ...(task ? answersOf(task, this.#answerText, (each) => rich(each, symbols, this.#of), this.#onAnswer) : []),
    );
    this.#task.hidden = this.#hint.hidden = !task;
    this.#sliders.hidden = !sliders;
    this.#hintWords.hidden = true;
    this.#verdict.className = "lesson-verdict";
    setText(this.#verdict, "");
    setText(this.#count, this.#text.place(at + 1, count));
    this.#back.disabled = at === 0;
    setText(this.#next, next);
    this.#next.classList.toggle("primary", !task);
    this.#scroll.scrollTo(0, 0);
  }

  get #of() {
    return { id: this.#lesson, onLesson: this.#onLesson };
  }

  /** @param {string} words */
  #rich(words) {
    return rich(words, this.#mark, this.#of);
  }

  /** @param {string} words */
  hint(words) {
    this.#hintWords.replaceChildren(...this.#rich(words));
    this.#hintWords.hidden = false;
    this.#hintWords.scrollIntoView({ block: "nearest" });
  }

  /** Whether the task is done, and what is missing. @param {boolean} solved @param {string} words */
  judge(solved, words) {
    this.#verdict.classList.toggle("solved", solved);
    this.#verdict.classList.toggle("wrong", !solved && words !== "");
    this.#verdict.replaceChildren(...this.#rich(words));
    this.#next.classList.toggle("primary", solved);
  }
}
