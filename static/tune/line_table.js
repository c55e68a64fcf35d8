// @ts-check
// A table of lines; a click on a row asks why.
import { h, setText } from "../widgets/dom.js";

/** beam: that is asked about; note: in words, what the cells do not say. @typedef {{cells: string[], current: boolean, beam: number, note: string}} Row */

export class LineTable {
  #ask;
  #onSelect;
  #columns;
  #body = h("tbody");
  #count = h("span", { class: "count" });
  #table;
  #empty;

  /**
   * @param {string} title @param {string[]} columns @param {string} none said instead of an empty table
   * @param {{onSelect: (beam: number) => void, ask: (beam: number) => string}} rows ask: words of the question
   */
  constructor(title, columns, none, { onSelect, ask }) {
    this.#onSelect = onSelect;
    this.#ask = ask;
    this.#columns = columns.length;
    const heads = columns.map((column) => h("th", { scope: "col" }, column));
    this.#table = h("table", { class: "table" }, h("thead", {}, h("tr", {}, ...heads)), this.#body);
    this.#empty = h("p", { class: "hint" }, none);
    this.element = h("section", {}, h("h3", {}, title, this.#count), this.#table, this.#empty);
  }

  /** @param {Row[]} rows */
  set(rows) {
    setText(this.#count, String(rows.length));
    this.#empty.hidden = rows.length > 0;
    this.#table.hidden = rows.length === 0;
    while (this.#body.rows.length > rows.length) this.#body.deleteRow(-1);
    while (this.#body.rows.length < rows.length) this.#body.append(this.#emptyRow());
    for (const [k, row] of rows.entries()) this.#fill(this.#body.rows[k], row);
  }

  #emptyRow() {
    const ask = h("button", { type: "button", class: "row-button" });
    const others = Array.from({ length: this.#columns - 1 }, () => h("td"));
    const row = h("tr", {}, h("td", {}, ask), ...others);
    row.addEventListener("click", () => this.#onSelect(Number(row.dataset.beam)));
    return row;
  }

  /** @param {HTMLTableRowElement} row @param {Row} content */
  #fill(row, { cells, current, beam, note }) {
    row.dataset.beam = String(beam);
    row.classList.toggle("current", current);
    row.title = note;
    const ask = /** @type {HTMLElement} */ (row.cells[0].firstElementChild);
    setText(ask, cells[0]);
    ask.setAttribute("aria-label", `${cells[0]}. ${note || this.#ask(beam)}`);
    for (let k = 1; k < cells.length; k++) setText(row.cells[k], cells[k]);
  }
}
