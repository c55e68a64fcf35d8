// @ts-check
// The true lines of the frame as a table; a click on a row selects its line.
import { h, setText } from "../widgets/dom.js";
import { seenOf } from "./lines.js";

/** @typedef {import("./lines.js").Line} Line */
/** @typedef {import("./lines.js").Sweep} Sweep */

/**
 * @param {typeof import("../text/label.js").labelText} text
 * @param {(line: number) => void} onChoose
 */
export function createList(text, onChoose) {
  const { number, beams, points, length } = text.columns;
  const body = h("tbody");
  const heads = [number, beams, points, length].map((column) => h("th", { scope: "col" }, column));
  const element = h(
    "div",
    { class: "labels-list" },
    h("table", { class: "table", "aria-label": text.list }, h("thead", {}, h("tr", {}, ...heads)), body),
  );

  function emptyRow() {
    const ask = h("button", { type: "button", class: "row-button" });
    const row = h("tr", {}, h("td", {}, ask), h("td"), h("td"), h("td"));
    row.addEventListener("click", () => onChoose(row.rowIndex - 1));
    return row;
  }

  return {
    element,
    /** @param {Line[]} lines @param {number} chosen @param {Sweep | null} sweep */
    set(lines, chosen, sweep) {
      while (body.rows.length > lines.length) body.deleteRow(-1);
      while (body.rows.length < lines.length) body.append(emptyRow());
      lines.forEach((line, k) => {
        const row = body.rows[k];
        const [one, other] = [line.start ?? sweep?.points[line.first], line.end ?? sweep?.points[line.last]];
        const seen = sweep && seenOf(line, sweep).length;
        const cells = [
          String(k + 1),
          `${line.first}–${line.last}`,
          seen === null ? "" : String(seen),
          one && other ? text.m(Math.hypot(one[0] - other[0], one[1] - other[1])) : "",
        ];
        row.classList.toggle("current", k === chosen);
        const ask = /** @type {HTMLElement} */ (row.cells[0].firstElementChild);
        ask.setAttribute("aria-label", text.row(k + 1, cells[1], cells[3]));
        ask.setAttribute("aria-pressed", String(k === chosen));
        cells.forEach((words, column) => setText(column ? row.cells[column] : ask, words));
        if (k === chosen && !row.dataset.seen) row.scrollIntoView({ block: "nearest" });
        row.dataset.seen = k === chosen ? "yes" : "";
      });
    },
  };
}
