// @ts-check
// The frames of the recording, the most doubtful first.
import { h, setText } from "../widgets/dom.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";

/** @typedef {import("../wire.js").Score} Score */
/** @typedef {{score: string, values: Float32Array, complete: boolean, message: string | null}} Scored */

const ROW_PX = 78;
const SPARE_ROWS = 4;

/**
 * @param {typeof import("../text/inspect.js").inspectText.frames} text
 * @param {{onFrame: (frame: number) => void, onScore: (score: string) => void,
 *          number: (frame: number) => number, value: (frame: number) => string, words: (frame: number) => string, passes: (frame: number) => boolean, onRows: () => void, extra: HTMLElement, filter: HTMLElement}} handlers
 *   number: what a frame is called; value, words: what is said of a frame, its score and what looks wrong; passes: whether it is listed; onRows: other frames came into view; extra, filter: below the score, and the range
 */
export function createFrames(text, { onFrame, onScore, number, value, words, passes, onRows, extra, filter }) {
  /** @type {Scored | null} */
  let scored = null;
  /** @type {Score[]} */
  let scores = [];
  /** Frames in the order of the list. */
  let order = new Uint32Array(0);
  let frame = 0;
  /** The frame that the list led to last. */
  let led = -1;
  let low = -Infinity;
  let high = Infinity;

  const select = h("select", { class: "select", "aria-label": text.score, onchange: () => onScore(select.value) });
  const help = h("p", { class: "hint" });
  const count = h("span", { class: "muted frames-count", role: "status" });
  const [from, to] = [
    limit(text.from, (typed) => (low = typed ?? -Infinity)),
    limit(text.to, (typed) => (high = typed ?? Infinity)),
  ];
  const spacer = h("div", { class: "frames-spacer" });
  const list = h("div", { class: "frames-list", role: "listbox", tabIndex: 0, "aria-label": text.label }, spacer);
  const note = h("p", { class: "hint" });
  const element = h(
    "div",
    { class: "frames" },
    h("div", { class: "frames-head" }, h("label", {}, text.score), select),
    help,
    extra,
    h(
      "div",
      { class: "frames-head" },
      h("label", {}, text.from),
      from.element,
      h("label", {}, text.to),
      to.element,
      count,
    ),
    from.error,
    to.error,
    filter,
    note,
    list,
  );
  list.addEventListener("scroll", paint);
  new ResizeObserver(paint).observe(list);
  list.addEventListener("keydown", (event) => {
    const at = order.indexOf(frame);
    const page = Math.max(1, Math.floor(list.clientHeight / ROW_PX) - 1);
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity }[
      event.key
    ];
    if (steps === undefined || !order.length) return;
    event.preventDefault();
    event.stopPropagation();
    go(order[clamp(at < 0 ? 0 : at + steps, 0, order.length - 1)]);
  });

  /** @param {string} end @param {(typed: number | null) => void} set */
  function limit(end, set) {
    const field = createNumberField({
      label: text.rangeLabel(end),
      className: "frames-limit",
      accept(typed) {
        const wanted = typed.trim() === "" ? null : Number(typed);
        if (Number.isNaN(wanted)) return text.notANumber(typed);
        set(wanted);
        field.set(typed.trim());
        sort();
        return null;
      },
    });
    field.element.placeholder = text.any;
    return field;
  }

  function sort() {
    const what = scores.find(({ name }) => name === scored?.score);
    const known = scored?.complete ? scored.values : new Float32Array(0);
    const sign = what?.worse === "lower" ? 1 : -1;
    const inside = [...known.keys()].filter((k) => !(known[k] < low || known[k] > high) && passes(k));
    order = Uint32Array.from(inside.sort((one, other) => sign * (known[one] - known[other]) || one - other));
    setText(help, what?.help ?? "");
    setText(count, known.length ? text.count(order.length, known.length) : "");
    setText(note, known.length ? (order.length ? "" : text.none) : (scored?.message ?? text.pending));
    note.hidden = order.length > 0;
    spacer.style.height = `${order.length * ROW_PX}px`;
    paint();
  }

  function paint() {
    const first = Math.max(0, Math.floor(list.scrollTop / ROW_PX) - SPARE_ROWS);
    const last = Math.min(order.length, Math.ceil((list.scrollTop + list.clientHeight) / ROW_PX) + SPARE_ROWS);
    const rows = /** @type {HTMLElement[]} */ ([...spacer.children]);
    while (rows.length > last - first) rows.pop()?.remove();
    while (rows.length < last - first) {
      const row = emptyRow();
      rows.push(row);
      spacer.append(row);
    }
    rows.forEach((row, k) => fill(row, first + k));
    onRows();
    list.setAttribute("aria-activedescendant", spacer.querySelector("[aria-selected=true]")?.id ?? "");
  }

  function emptyRow() {
    const row = h(
      "div",
      { class: "frames-row", role: "option" },
      h("span", { class: "frames-number" }),
      h("span", { class: "frames-value" }),
      h("span", { class: "frames-words muted" }),
    );
    row.addEventListener("click", () => go(Number(row.dataset.frame)));
    return row;
  }

  /** @param {HTMLElement} row @param {number} place */
  function fill(row, place) {
    const shown = order[place];
    row.id = `frame-${shown}`;
    row.dataset.frame = String(shown);
    row.style.top = `${place * ROW_PX}px`;
    row.setAttribute("aria-selected", String(shown === frame));
    const [score, said] = [value(shown), words(shown)];
    row.setAttribute("aria-label", text.row(number(shown), score, said));
    row.title = said;
    [String(number(shown)), score, said].forEach((part, k) => setText(row.children[k], part));
  }

  /** @param {number} wanted */
  function go(wanted) {
    led = wanted;
    reveal(wanted);
    onFrame(wanted);
  }

  /** @param {number} wanted */
  function reveal(wanted) {
    const place = order.indexOf(wanted);
    if (place < 0) return;
    const top = place * ROW_PX;
    if (top < list.scrollTop) list.scrollTop = top;
    else if (top + ROW_PX > list.scrollTop + list.clientHeight) list.scrollTop = top + ROW_PX - list.clientHeight;
  }

  return {
    element,
    /** @param {Score[]} next */
    setScores(next) {
      scores = next;
      select.replaceChildren(...next.map(({ name, label }) => h("option", { value: name }, label)));
    },
    /** @param {Scored | null} next the scores of every frame, null while there are none */
    setScored(next) {
      scored = next;
      if (next) select.value = next.score;
      extra.hidden = next?.score !== "suspicion";
      sort();
    },
    /** What is said of the frames may have changed. */
    paint,
    /** Other frames may be listed. */
    sort,
    /** The frames that are in view. */
    get inView() {
      return /** @type {HTMLElement[]} */ ([...spacer.children]).map((row) => Number(row.dataset.frame));
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView(view) {
      if (view.frame === frame) return;
      frame = view.frame;
      paint();
    },
    /** The next or former frame of the list, its first to begin with. @param {1 | -1} by */
    next(by) {
      const at = led === frame ? order.indexOf(frame) : -1;
      if (order.length) go(order[at < 0 ? 0 : clamp(at + by, 0, order.length - 1)]);
    },
  };
}
