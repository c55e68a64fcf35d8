// @ts-check
// Which frames are listed: those with a tag, and with some words in their tags, their note, or what looks wrong in them.
import { fetchText } from "../fetch.js";
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Brief} Brief */
/** @typedef {typeof import("../text/inspect.js").inspectText.filter} Text */
/**
 * @typedef {object} Handlers
 * @property {(frame: number) => string[] | undefined} words what looks wrong in a frame; undefined while unknown
 * @property {() => void} onChange
 * @property {(tags: string[]) => void} onTags all existing tags
 */

const REST_MS = 200;
const ANY = "";
// A tag can have any name, so these values are not tags.
const LABELLED = "kind:lines";
const NOTED = "kind:note";

/** @param {Text} text @param {Handlers} handlers */
export function createFilter(text, handlers) {
  return new Filter(text, handlers);
}

class Filter {
  #text;
  #handlers;
  /** Labels by frame. @type {Record<string, Brief>} */ #said = {};
  #key = "";
  #frames = { frames: 0, first: 0, every: 1 };
  #timer = 0;
  #field;
  #select;
  #searching = h("p", { class: "hint", role: "status", hidden: true });

  /** @param {Text} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.#field = h("input", {
      type: "search",
      class: "frames-search",
      placeholder: text.placeholder,
      "aria-label": text.label,
    });
    this.#select = h("select", { class: "select", "aria-label": text.tag, onchange: handlers.onChange });
    this.element = h("div", {}, h("div", { class: "frames-head" }, this.#field, this.#select), this.#searching);
    this.#field.addEventListener("input", () => {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(handlers.onChange, REST_MS);
    });
    this.#field.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key !== "Escape") return;
      this.#field.value = "";
      this.#field.blur();
      handlers.onChange();
    });
    this.#offer();
  }

  get #wanted() {
    return this.#field.value.trim().toLowerCase();
  }

  /** Whether the filter has words. */
  get searching() {
    return this.#wanted !== "";
  }

  /** @param {Brief | undefined} brief */
  #chosen(brief) {
    const { value } = this.#select;
    if (value === ANY) return true;
    if (value === LABELLED) return brief !== undefined && brief.lines !== null;
    if (value === NOTED) return Boolean(brief?.note);
    return brief?.tags.includes(value.slice(1)) ?? false;
  }

  /** Tags and note of a frame, in one line. @param {number} frame */
  line(frame) {
    const { tags = [], note = "" } = this.#said[frame] ?? {};
    return [...tags.map((tag) => `#${tag}`), note.replace(/\s+/g, " ")].filter(Boolean).join(" ");
  }

  /** Frames whose words are unknown and may be needed. */
  unknown() {
    if (!this.searching) return [];
    const { frames, first, every } = this.#frames;
    return Array.from({ length: frames }, (_, k) => first + every * k).filter(
      (frame) => this.#handlers.words(frame) === undefined && this.#chosen(this.#said[frame]),
    );
  }

  /** @param {number} frame */
  passes(frame) {
    if (!this.#chosen(this.#said[frame])) return false;
    const words = this.#handlers.words(frame)?.join(" ") ?? "";
    return !this.searching || `${this.line(frame)} ${words}`.toLowerCase().includes(this.#wanted);
  }

  /** Shows the progress of the search. */
  tell() {
    const missing = this.unknown().length;
    this.#searching.hidden = missing === 0;
    setText(this.#searching, this.#text.searching(this.#frames.frames - missing, this.#frames.frames));
  }

  /** Tags and kinds of frames, with their number. */
  #offer() {
    const { any, labelled, noted, tagged } = this.#text;
    const briefs = Object.values(this.#said);
    /** @type {Map<string, number>} */
    const counts = new Map();
    for (const tag of briefs.flatMap(({ tags }) => tags)) counts.set(tag, (counts.get(tag) ?? 0) + 1);
    const tags = [...counts].sort(([one], [other]) => one.localeCompare(other));
    const before = this.#select.value;
    this.#select.replaceChildren(
      h("option", { value: ANY }, any),
      h("option", { value: LABELLED }, labelled(briefs.filter(({ lines }) => lines !== null).length)),
      h("option", { value: NOTED }, noted(briefs.filter(({ note }) => note).length)),
      ...tags.map(([tag, count]) => h("option", { value: `#${tag}` }, tagged(tag, count))),
    );
    this.#select.value = [...this.#select.options].some(({ value }) => value === before) ? before : ANY;
    this.#handlers.onTags(tags.map(([tag]) => tag));
  }

  /** @param {Record<string, Brief>} said */
  #take(said) {
    this.#said = said;
    this.#offer();
    this.#handlers.onChange();
  }

  /** @param {URLSearchParams} query */
  async #ask(query) {
    const asked = this.#key;
    const { words, trouble } = await fetchText(`/api/labels?${query}`);
    if (asked === this.#key) this.#take(trouble ? {} : JSON.parse(words).frames);
  }

  /** @param {State} state */
  setState({ mode, frames, first, every, recording, readAs, place, labels }) {
    this.#frames = { frames, first, every };
    const key = `${place} ${labels?.stamp}`;
    if (mode !== "inspect" || key === this.#key) return;
    this.#key = key;
    if (!labels?.stamp) return this.#take({});
    this.#ask(new URLSearchParams({ recording, reading: JSON.stringify(readAs) }));
  }
}
