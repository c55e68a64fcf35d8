// @ts-check
// The view from near by: of the decision on the screen, or of the next one while a question about it is open.

/** @typedef {import("../wire.js").Framing} Framing */
/** @typedef {[number, number]} Point */

/**
 * @param {import("../page.js").Page} page
 * @param {import("./kinds.js").AnyStage} stage
 * @param {{whole: () => void, onFraming: (framing: Framing | null, lines: [Point, Point][]) => void}} handlers whole: shows the whole plan; onFraming: another decision is shown; lines: those in sight
 */
export function createCloseUp(page, stage, { whole, onFraming }) {
  /** Of the decision on the screen. @type {Framing | null} */
  let framing = null;
  /** @type {[Point, Point][]} */
  let found = [];
  /** Where the stage was put. */
  let framed = "";

  /** @param {Framing | null} next null: the whole plan */
  function show(next) {
    onFraming(next, next ? [...found, lineOf(next)] : []);
    const key = next ? JSON.stringify([next.box, next.factor, next.at]) : "";
    if (key === framed) return;
    framed = key;
    if (next) stage.closeUp(next.box, next);
    else whole();
  }

  return {
    /** @param {{framing: Framing | null, segments: {start: Point, end: Point}[]}} state */
    set(state) {
      framing = state.framing;
      found = state.segments.map(({ start, end }) => [start, end]);
      show(framing);
    },
    /** The stage shows something else. */
    forget() {
      framed = "";
    },
    /** Shows what a question is about; afterwards the decision on the screen again. @param {boolean} asked */
    ask(asked) {
      show(asked ? (page.drawn?.ahead ?? framing) : framing);
    },
    /** Shows the decision from near by again; if it is shown so, the whole plan. */
    toggle() {
      const { closeup } = page.view;
      if (closeup === "off" || !framing || !stage.moved)
        return page.change({ closeup: closeup === "on" ? "off" : "on" });
      framed = "";
      return show(framing);
    },
  };
}

/** The line that a view from near by is about, across its box. @param {Framing} framing @returns {[Point, Point]} */
function lineOf({ box: [x1, y1, x2, y2], normal: [a, b], at: [x, y] }) {
  const long = Math.hypot(x2 - x1, y2 - y1);
  return [
    [x + b * long, y - a * long],
    [x - b * long, y + a * long],
  ];
}
