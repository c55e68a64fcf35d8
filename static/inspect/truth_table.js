// @ts-check
// A row for each number, a column for the frame and one for the recording.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Agreement} Agreement */

export class TruthTable {
  #text;
  #all;
  #rows;

  /** @param {typeof import("../text/inspect.js").inspectText.truth} text */
  constructor(text) {
    this.#text = text;
    this.#all = h("th", { scope: "col" }, text.all);
    this.#rows = text.rows.map(([name, label, help, kind]) => {
      const head = h("th", { scope: "row" }, label);
      tooltip(head, help, "left");
      const cells = { frame: h("td"), all: h("td") };
      return { name, kind, cells, element: h("tr", {}, head, cells.frame, cells.all) };
    });
    const heads = h("tr", {}, h("td"), h("th", { scope: "col" }, text.frame), this.#all);
    this.element = h(
      "table",
      { class: "table truth-table" },
      h("thead", {}, heads),
      h("tbody", {}, ...this.#rows.map(({ element }) => element)),
    );
  }

  /** Says which frames the column of the recording covers. @param {string} words */
  nameAll(words) {
    setText(this.#all, words);
  }

  /** @param {"frame" | "all"} column @param {Partial<Agreement> | null} agreement null: it is still to come */
  fill(column, agreement) {
    for (const { name, kind, cells } of this.#rows) {
      const value = agreement?.[/** @type {keyof Agreement} */ (name)] ?? null;
      setText(cells[column], agreement === null ? this.#text.pending : this.#words(value, kind));
    }
  }

  /** @param {number | null} value @param {"count" | "share" | "mm"} kind */
  #words(value, kind) {
    if (value === null) return "–";
    return kind === "count" ? value.toLocaleString("en") : this.#text[kind](value);
  }
}
