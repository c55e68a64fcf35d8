// @ts-check
import { h } from "../widgets/dom.js";
import { LineTable } from "./line_table.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Segment} Segment */
/** @typedef {import("../wire.js").Dropped} Dropped */

/**
 * The segments of the frame and the dropped candidates; a click on one asks why.
 * @param {typeof import("../text/page.js").pageText.lines} text
 * @param {(beam: number) => void} onSelect
 */
export function createLines(text, onSelect) {
  const { beams, points, length, rms, by } = text.columns;
  const rows = { onSelect, ask: text.ask };
  const kept = new LineTable(text.segments, [beams, points, length, rms], text.none, rows);
  const dropped = new LineTable(text.dropped, [beams, points, length, by], text.noneDropped, rows);
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

/** The middle beam of a line, which may cross the seam of a full circle. @param {{first: number, last: number}} line @param {number} beams */
function middle({ first, last }, beams) {
  const span = last >= first ? last - first : last + beams - first;
  return (first + Math.floor(span / 2)) % beams;
}
