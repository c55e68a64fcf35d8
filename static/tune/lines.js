// @ts-check
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Segment} Segment */
/** @typedef {import("../wire.js").Dropped} Dropped */

/**
 * The segments of the frame and the candidates that were dropped, each a way to ask why.
 * @param {typeof import("../text/page.js").pageText.lines} text
 * @param {(beam: number) => void} onSelect
 */
export function createLines(text, onSelect) {
  const { beams, points, length, rms, by } = text.columns;
  const kept = createTable(text.segments, [beams, points, length, rms], text.none);
  const dropped = createTable(text.dropped, [beams, points, length, by], text.noneDropped);
  const element = h("div", { class: "lines" }, kept.element, dropped.element);
  /** @type {State | null} */
  let state = null;
  /** @type {Map<string, string>} */
  let symbols = new Map();

  function show() {
    if (!state || element.hidden) return;
    const { segments, dropped: candidates, beams: n, explanation, selected } = state;
    const inside = (/** @type {{first: number, last: number}} */ line) => selected !== null && covers(line, selected);
    kept.set(
      segments.map((line, k) => ({
        cells: [`${line.first}–${line.last}`, String(line.points), text.m(line.length), text.mm(line.rms)],
        current: explanation?.segment === k,
        beam: middle(line, n),
        note: "",
      })),
    );
    dropped.set(
      candidates.map((line) => ({
        cells: [
          `${line.first}–${line.last}`,
          String(line.points),
          text.m(line.length),
          symbols.get(line.check) ?? line.check,
        ],
        current: inside(line) && explanation?.segment === -1,
        beam: middle(line, n),
        note: line.text,
      })),
    );
  }

  new MutationObserver(show).observe(element, { attributeFilter: ["hidden"] });

  /** @param {string} title @param {string[]} columns @param {string} none */
  function createTable(title, columns, none) {
    const body = h("tbody");
    const count = h("span", { class: "count" });
    const empty = h("p", { class: "hint" }, none);
    const heads = columns.map((column) => h("th", { scope: "col" }, column));
    const table = h("table", { class: "table" }, h("thead", {}, h("tr", {}, ...heads)), body);
    return {
      element: h("section", {}, h("h3", {}, title, count), table, empty),
      /** @param {{cells: string[], current: boolean, beam: number, note: string}[]} rows */
      set(rows) {
        setText(count, String(rows.length));
        empty.hidden = rows.length > 0;
        table.hidden = rows.length === 0;
        while (body.rows.length > rows.length) body.deleteRow(-1);
        while (body.rows.length < rows.length) body.append(emptyRow());
        rows.forEach((row, k) => fill(body.rows[k], row));
      },
    };
  }

  function emptyRow() {
    const ask = h("button", { type: "button", class: "row-button" });
    const row = h("tr", {}, h("td", {}, ask), h("td"), h("td"), h("td"));
    row.addEventListener("click", () => onSelect(Number(row.dataset.beam)));
    return row;
  }

  /** @param {HTMLTableRowElement} row @param {{cells: string[], current: boolean, beam: number, note: string}} content */
  function fill(row, { cells, current, beam, note }) {
    row.dataset.beam = String(beam);
    row.classList.toggle("current", current);
    row.title = note;
    const ask = /** @type {HTMLElement} */ (row.cells[0].firstElementChild);
    setText(ask, cells[0]);
    ask.setAttribute("aria-label", `${cells[0]}. ${note || text.ask(beam)}`);
    for (let k = 1; k < cells.length; k++) setText(row.cells[k], cells[k]);
  }

  return {
    element,
    /** @param {import("../wire.js").Knob[]} knobs */
    setKnobs(knobs) {
      symbols = new Map(knobs.map(({ name, symbol }) => [name, symbol]));
    },
    /** @param {State} next */
    setState(next) {
      state = next;
      show();
    },
  };
}

/** @param {{first: number, last: number}} line @param {number} beam */
function covers({ first, last }, beam) {
  return first <= last ? first <= beam && beam <= last : beam >= first || beam <= last;
}

/** A beam in the middle; a line may run across the seam of a full circle. @param {{first: number, last: number}} line @param {number} beams */
function middle({ first, last }, beams) {
  const span = last >= first ? last - first : last + beams - first;
  return (first + Math.floor(span / 2)) % beams;
}
