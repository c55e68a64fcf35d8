// @ts-check
// A table of lines; a click on a row asks why.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** colour: in the scene, "" if it has none; note: in words, what the cells do not say. @typedef {{cells: string[], colour: string, current: boolean, note: string}} Row */

export class LineTable {
  #onRow;
  #columns;
  #body = h("tbody");
  #count = h("span", { class: "count" });
  #table;
  #empty;

  /**
   * @param {string} title @param {string[][]} columns name and explanation @param {string} none said instead of an empty table
   * @param {(row: number, beside: boolean) => void} onRow beside: Shift was held
   */
  constructor(title, columns, none, onRow) {
    this.#onRow = onRow;
    this.#columns = columns.length;
    const heads = columns.map(([name, help]) => {
      const head = h("th", { scope: "col" }, name);
      tooltip(head, help, "left");
      return head;
    });
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
    const swatch = h("span", { class: "line-swatch", "aria-hidden": "true" });
    const ask = h("button", { type: "button", class: "row-button" }, swatch, h("span", {}));
    const others = Array.from({ length: this.#columns - 1 }, () => h("td"));
    const row = h("tr", {}, h("td", {}, ask), ...others);
    row.addEventListener("click", (event) => this.#onRow(row.sectionRowIndex, event.shiftKey));
    // Shift would select text from the last click to here.
    row.addEventListener("mousedown", (event) => event.shiftKey && event.preventDefault());
    return row;
  }

  /** @param {HTMLTableRowElement} row @param {Row} content */
  #fill(row, { cells, colour, current, note }) {
    row.classList.toggle("current", current);
    row.title = note;
    const ask = /** @type {HTMLElement} */ (row.cells[0].firstElementChild);
    const [swatch, beams] = /** @type {HTMLElement[]} */ ([...ask.children]);
    swatch.style.background = colour;
    setText(beams, cells[0]);
    ask.setAttribute("aria-label", `${cells[0]}. ${note}`);
    for (let k = 1; k < cells.length; k++) setText(row.cells[k], cells[k]);
  }
}
