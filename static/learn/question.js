// @ts-check
// What a question is about, so that it can be answered by looking: the points, the line, and the band or the second line.
import { fit, stretch } from "./geometry.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./trace.js").Line} Line */
/** @typedef {import("./geometry.js").Point} Point */

/**
 * @param {Event} event the decision that is asked about @param {Trace} trace @param {import("../wire.js").Params} params
 * @returns {import("../stage/overlay.js").Shape}
 */
export function shapeOfQuestion(event, trace, params) {
  const { phase, first, last, beam, other } = event;
  const inside = trace.span(first, last);
  const onePoint = beam >= 0 && phase === "growth";
  const beams = onePoint ? [...inside, beam] : inside;
  const dots = (onePoint ? [beam] : inside).map((each) => trace.point(each)).filter((point) => point !== null);
  const line = phase === "seed" && inside.length > 1 ? fit(trace, inside).line : trace.compared(event);
  const own = line && stretch(trace, beams, line);
  const second = other && stretch(trace, beams, other);
  const lines = [own, second].filter((each) => each !== null);
  const banded = phase === "seed" || onePoint;
  const thin = own && line && banded ? [1, -1].map((side) => beside(own, line, side, params)) : [];
  return { dots: other ? [] : dots, lines, thin };
}

/** An edge of the ε band. @param {[Point, Point]} ends @param {Line} line @param {number} side @param {import("../wire.js").Params} params @returns {[Point, Point]} */
function beside(ends, [a, b], side, { epsilon, epsilon_growth: growth = 0 }) {
  return /** @type {[Point, Point]} */ (
    ends.map(([x, y]) => {
      const far = side * Math.hypot(epsilon, growth * Math.hypot(x, y));
      return [x + far * a, y + far * b];
    })
  );
}
