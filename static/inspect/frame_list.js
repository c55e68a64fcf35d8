// @ts-check
// A list of thousands of frames that keeps only the visible rows in the document.
import { h, setText } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";

/**
 * @typedef {object} Handlers
 * @property {(frame: number) => string} value its score, in words
 * @property {(frame: number) => string} words what looks wrong in it
 * @property {HTMLElement} said all that looks wrong in the selected frame
 * @property {() => void} onRows other frames became visible
 * @property {(frame: number) => void} onTake
 */

const ROW_PX = 78;
// Of the selected row, above what is said of it.
const HEAD_PX = 26;
const SPARE_ROWS = 4;
const REST_MS = 250;

export class FrameList {
  /** Frames in the order of the list. @type {number[]} */ order = [];
  #text;
  #handlers;
  #frame = 0;
  #resting = 0;
  #spacer;
  #said;

  /** @param {typeof import("../text/inspect.js").inspectText.frames} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    const listed = { role: "listbox", tabIndex: 0, "aria-label": text.label };
    this.#spacer = h("div", { class: "frames-spacer", ...listed });
    this.element = h("div", { class: "frames-list" }, this.#spacer);
    this.#said = handlers.said;
    this.#said.classList.add("frames-said");
    this.element.append(this.#said);
    this.element.addEventListener("scroll", () => this.paint());
    this.#spacer.addEventListener("keydown", (event) => this.#walk(event));
    for (const each of [this.element, this.#said]) new ResizeObserver(() => this.paint()).observe(each);
  }

  /** Place in the list of the selected frame; −1: it is not listed. */
  get #selected() {
    return this.order.indexOf(this.#frame);
  }

  /** Height of the selected row. */
  get #tall() {
    return Math.max(ROW_PX, HEAD_PX + this.#said.offsetHeight);
  }

  /** Where a row begins. @param {number} place */
  #top(place) {
    const selected = this.#selected;
    return place * ROW_PX + (selected >= 0 && place > selected ? this.#tall - ROW_PX : 0);
  }

  /** @param {KeyboardEvent} event */
  #walk(event) {
    const at = this.order.indexOf(this.#frame);
    const page = Math.max(1, Math.floor(this.element.clientHeight / ROW_PX) - 1);
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity }[
      event.key
    ];
    if (steps === undefined || !this.order.length) return;
    event.preventDefault();
    event.stopPropagation();
    this.#handlers.onTake(this.order[clamp(at < 0 ? 0 : at + steps, 0, this.order.length - 1)]);
  }

  get #rows() {
    return /** @type {HTMLElement[]} */ ([...this.#spacer.children]);
  }

  /** The frames that are in view. */
  get inView() {
    return this.#rows.map((row) => Number(row.dataset.frame));
  }

  paint() {
    const { scrollTop, clientHeight } = this.element;
    const selected = this.#selected;
    this.#said.hidden = selected < 0;
    this.#said.style.top = `${this.#top(selected) + HEAD_PX}px`;
    this.#spacer.style.height = `${this.#top(this.order.length)}px`;
    const above = this.#top(this.order.length) - this.order.length * ROW_PX;
    const first = Math.max(0, Math.floor((scrollTop - above) / ROW_PX) - SPARE_ROWS);
    const last = Math.min(this.order.length, Math.ceil((scrollTop + clientHeight) / ROW_PX) + SPARE_ROWS);
    const count = Math.max(0, last - first);
    while (this.#spacer.children.length > count) this.#spacer.lastElementChild?.remove();
    while (this.#spacer.children.length < count) this.#spacer.append(this.#emptyRow());
    for (const [k, row] of this.#rows.entries()) this.#fill(row, first + k);
    this.#handlers.onRows();
    this.#spacer.setAttribute("aria-activedescendant", this.#spacer.querySelector("[aria-selected=true]")?.id ?? "");
  }

  #emptyRow() {
    const row = h(
      "div",
      { class: "frames-row", role: "option" },
      h("span", { class: "frames-number" }),
      h("span", { class: "frames-value" }),
      h("span", { class: "frames-words muted" }),
    );
    row.addEventListener("click", () => this.#handlers.onTake(Number(row.dataset.frame)));
    return row;
  }

  /** @param {HTMLElement} row @param {number} place */
  #fill(row, place) {
    const { value, words } = this.#handlers;
    const frame = this.order[place];
    const parts = [String(frame), value(frame), words(frame)];
    row.id = `frame-${frame}`;
    row.dataset.frame = String(frame);
    row.style.top = `${this.#top(place)}px`;
    row.style.height = `${frame === this.#frame ? this.#tall : ROW_PX}px`;
    row.setAttribute("aria-selected", String(frame === this.#frame));
    row.setAttribute("aria-label", this.#text.row(frame, parts[1], parts[2]));
    row.title = parts[2];
    for (const [k, part] of parts.entries()) setText(row.children[k], part);
  }

  /** @param {number} frame */
  reveal(frame) {
    const place = this.order.indexOf(frame);
    if (place < 0) return;
    const top = this.#top(place);
    const bottom = top + (frame === this.#frame ? this.#tall : ROW_PX);
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (bottom > scrollTop + clientHeight) this.element.scrollTop = Math.min(top, bottom - clientHeight);
  }

  /** @param {number[]} order */
  setOrder(order) {
    this.order = order;
    this.paint();
  }

  /** @param {number} frame */
  setFrame(frame) {
    this.#frame = frame;
    this.paint();
    // Not while frames pass by.
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => this.reveal(this.#frame), REST_MS);
  }
}
