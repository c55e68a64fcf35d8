// @ts-check
// Tags and a note of a frame.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";

const REST_MS = 600;
const LONGEST_TAG = 60;
const LONGEST_NOTE = 20_000;

/**
 * @typedef {object} Handlers
 * @property {(tags: string[]) => void} onTags
 * @property {(note: string, from: string, gesture: string) => void} onNote
 *   from: the note before it was edited; gesture: one per use of the field
 */

export class Tags {
  #text;
  #handlers;
  /** @type {string[]} */ #tags = [];
  /** The note before it was edited. */ #from = "";
  #gesture = 0;
  #timer = 0;
  #known = h("datalist", { id: "known-tags" });
  #add;
  #chips;
  #note;

  /** @param {typeof import("../text/label.js").labelText} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.#add = h("input", {
      type: "text",
      class: "labels-add",
      placeholder: text.addTag,
      "aria-label": text.addTag,
      maxLength: LONGEST_TAG,
      list: this.#known.id,
      autocomplete: "off",
    });
    this.#add.addEventListener("keydown", (event) => this.#type(event));
    this.#add.addEventListener("change", () => this.#take());
    this.#chips = h("div", { class: "labels-tags" }, this.#add, this.#known);
    this.#note = this.#createNote();
    this.elements = [this.#chips, this.#note];
  }

  #createNote() {
    const note = h("textarea", {
      class: "labels-note",
      rows: 2,
      "aria-label": this.#text.note,
      placeholder: this.#text.notePlaceholder,
      maxLength: LONGEST_NOTE,
    });
    note.addEventListener("focus", () => {
      this.#gesture += 1;
    });
    note.addEventListener("input", () => {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.commit(), REST_MS);
    });
    note.addEventListener("blur", () => this.commit());
    note.addEventListener("keydown", (event) => event.key === "Escape" && note.blur());
    addEventListener("pagehide", () => this.commit());
    return note;
  }

  /** @param {KeyboardEvent} event */
  #type(event) {
    event.stopPropagation();
    if (event.key === "Enter" || event.key === ",") {
      event.preventDefault();
      this.#take();
    } else if (event.key === "Backspace" && !this.#add.value && this.#tags.length)
      this.#handlers.onTags(this.#tags.slice(0, -1));
    else if (event.key === "Escape") this.#add.blur();
  }

  /** Adds the typed tag. */
  #take() {
    const tag = this.#add.value.trim();
    this.#add.value = "";
    if (tag && !this.#tags.includes(tag)) this.#handlers.onTags([...this.#tags, tag]);
  }

  /** Reports the typed note. */
  commit() {
    clearTimeout(this.#timer);
    if (this.#note.value === this.#from) return;
    const before = this.#from;
    this.#from = this.#note.value;
    this.#handlers.onNote(this.#note.value, before, `note ${this.#gesture}`);
  }

  /** @param {{tags: string[], note: string}} said @param {boolean} editable */
  set({ tags, note }, editable) {
    this.#add.disabled = this.#note.disabled = !editable;
    if (this.#tags.join("\n") !== tags.join("\n") || this.#chips.children.length !== tags.length + 2) {
      this.#tags = tags;
      for (const chip of this.#chips.querySelectorAll(".labels-tag")) chip.remove();
      this.#chips.prepend(...tags.map((tag) => this.#chip(tag)));
    }
    if (this.#note.value === this.#from && this.#from !== note) this.#note.value = this.#from = note;
  }

  /** @param {string} tag */
  #chip(tag) {
    const remove = () => this.#handlers.onTags(this.#tags.filter((other) => other !== tag));
    return h("span", { class: "labels-tag" }, tag, iconButton("close", this.#text.removeTag(tag), remove));
  }

  /** Tags of other frames, to choose from. @param {string[]} names */
  suggest(names) {
    if (this.#known.children.length !== names.length)
      this.#known.replaceChildren(...names.map((value) => h("option", { value })));
  }
}
