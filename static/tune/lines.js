// @ts-check
import { h } from "../widgets/dom.js";
import { LineTable } from "./line_table.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Segment} Segment */
/** @typedef {import("../wire.js").Dropped} Dropped */
/** onSelect: a beam of a dropped line; onSegment: a segment, perhaps beside the selected one. @typedef {{onSelect: (beam: number) => void, onSegment: (segment: Segment, beside: boolean) => void}} Handlers */

/**
 * The segments of the frame and the dropped candidates; a click on one asks why.
 * @param {typeof import("../text/page.js").pageText.lines} text
 * @param {Handlers} handlers
 */
export function createLines(text, { onSelect, onSegment }) {
  const { beams, points, length, rms, at, angle, by } = text.columns;
  const kept = new LineTable(text.segments, [beams, points, length, rms, at, angle], text.none, (k, beside) => {
    const segment = state?.segments[k];
    if (segment) onSegment(segment, beside);
  });
  const dropped = new LineTable(text.dropped, [beams, points, length, at, by], text.noneDropped, (k) => {
    const line = state?.dropped[k];
    if (line) onSelect(line.beam);
  });
  const hint = h("p", { class: "hint" }, text.hint);
  const element = h("div", { class: "lines" }, kept.element, hint, dropped.element);
  /** @type {State | null} */
  let state = null;
  /** @type {Map<string, string>} */
  let symbols = new Map();

  function show() {
    if (!state || element.hidden) return;
    const { segments, dropped: candidates, explanation, view } = state;
    const chosen = [explanation?.beam, view.beside].filter((beam) => beam !== undefined && beam !== null);
    const inside = (/** @type {{first: number, last: number}} */ line) => chosen.some((beam) => covers(line, beam));
    hint.hidden = !segments.length;
    kept.set(
      segments.map((line) => ({
        cells: [...cellsOf(line, text), text.mm(line.rms), middleOf(line, text), text.angle(turnOf(line))],
        colour: line.colour,
        current: inside(line),
        note: text.ask,
      })),
    );
    dropped.set(
      candidates.map((line) => ({
        cells: [...cellsOf(line, text), middleOf(line, text), symbols.get(line.check) ?? line.check],
        colour: "",
        current: explanation?.segment === -1 && inside(line),
        note: line.text || text.askDropped,
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

/** @typedef {typeof import("../text/page.js").pageText.lines} Text */

/** @param {Segment | Dropped} line @param {Text} text */
function cellsOf({ first, last, points, length }, text) {
  return [`${first}–${last}`, String(points), text.m(length)];
}

/** @param {Segment | Dropped} line @param {Text} text */
function middleOf({ start, end }, text) {
  return text.at((start[0] + end[0]) / 2, (start[1] + end[1]) / 2);
}

/** The direction of a segment, from −90° to 90°. @param {Segment} segment */
function turnOf({ start, end }) {
  const turn = (Math.atan2(end[1] - start[1], end[0] - start[0]) * 180) / Math.PI;
  return turn > 90 ? turn - 180 : turn <= -90 ? turn + 180 : turn;
}

/** @param {{first: number, last: number}} line @param {number} beam */
function covers({ first, last }, beam) {
  return first <= last ? first <= beam && beam <= last : beam >= first || beam <= last;
}
