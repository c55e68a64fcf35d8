// @ts-check
// A list of thousands of frames that keeps only the visible rows in the document.
import { h, setText } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";

/**
 * @typedef {object} Handlers
 * @property {(frame: number) => string} value its score, in words
 * @property {(frame: number) => string} words what looks wrong in it
 * @property {() => void} onRows other frames became visible
 * @property {(frame: number) => void} onTake
 */

const ROW_PX = 78;
const SPARE_ROWS = 4;

export class FrameList {
  /** Frames in the order of the list. @type {number[]} */ order = [];
  #text;
  #handlers;
  #frame = 0;
  #spacer = h("div", { class: "frames-spacer" });

  /** @param {typeof import("../text/inspect.js").inspectText.frames} text @param {Handlers} handlers */
  constructor(text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    this.element = h(
      "div",
      { class: "frames-list", role: "listbox", tabIndex: 0, "aria-label": text.label },
      this.#spacer,
    );
    this.element.addEventListener("scroll", () => this.paint());
    this.element.addEventListener("keydown", (event) => this.#walk(event));
    new ResizeObserver(() => this.paint()).observe(this.element);
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
    const first = Math.max(0, Math.floor(scrollTop / ROW_PX) - SPARE_ROWS);
    const last = Math.min(this.order.length, Math.ceil((scrollTop + clientHeight) / ROW_PX) + SPARE_ROWS);
    const count = Math.max(0, last - first);
    while (this.#spacer.children.length > count) this.#spacer.lastElementChild?.remove();
    while (this.#spacer.children.length < count) this.#spacer.append(this.#emptyRow());
    for (const [k, row] of this.#rows.entries()) this.#fill(row, first + k);
    this.#handlers.onRows();
    this.element.setAttribute("aria-activedescendant", this.#spacer.querySelector("[aria-selected=true]")?.id ?? "");
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
    row.style.top = `${place * ROW_PX}px`;
    row.setAttribute("aria-selected", String(frame === this.#frame));
    row.setAttribute("aria-label", this.#text.row(frame, parts[1], parts[2]));
    row.title = parts[2];
    for (const [k, part] of parts.entries()) setText(row.children[k], part);
  }

  /** @param {number} frame */
  reveal(frame) {
    const place = this.order.indexOf(frame);
    if (place < 0) return;
    const top = place * ROW_PX;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (top + ROW_PX > scrollTop + clientHeight) this.element.scrollTop = top + ROW_PX - clientHeight;
  }

  /** @param {number[]} order */
  setOrder(order) {
    this.order = order;
    this.#spacer.style.height = `${order.length * ROW_PX}px`;
    this.paint();
  }

  /** @param {number} frame */
  setFrame(frame) {
    this.#frame = frame;
    this.paint();
  }
}
