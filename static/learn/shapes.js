// @ts-check
// What a term of a formula refers to in the scene.
import { foot, stretch } from "./geometry.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {import("../stage/overlay.js").Shape} Shape */

/**
 * The geometry of a term (formulas.js) at a decision.
 * @param {string} name @param {Event} event @param {Trace} trace @returns {Shape | null}
 */
export function shapeOf(name, event, trace) {
  const { other, first, last, beam, limit } = event;
  const line = trace.compared(event);
  const inside = trace.span(first, last);
  const at = beam >= 0 ? trace.point(beam) : null;
  const points = inside.flatMap((each) => trace.point(each) ?? []);
  const dots = /** @type {Point[]} */ (inside.map((each) => trace.point(each)).filter((point) => point !== null));
  const along = (/** @type {import("./trace.js").Line | null} */ of) =>
    of ? stretch(trace, at ? [...inside, beam] : inside, of) : null;
  const here = along(line);
  switch (name) {
    case "point":
      return at && { dots: [at] };
    case "window":
      return { dots };
    case "outermost":
      return { dots: dots.length ? [dots[0]] : [] };
    case "beam":
      return at && { lines: [[[0, 0], at]] };
    case "distance":
      return at && line && { lines: [[at, foot(at, line)]], dots: [at] };
    case "predicted": {
      if (!at || !line) return null;
      const { range, meets } = trace.predicted(beam, line);
      const ahead = /** @type {Point} */ ([(at[0] * meets) / range, (at[1] * meets) / range]);
      return { dots: [ahead], lines: [[at, ahead]] };
    }
    case "line":
    case "length":
      return here && { lines: [here] };
    case "other": {
      const there = along(other);
      return there && { lines: [there] };
    }
    case "band":
      return (
        here &&
        line && {
          lines: [1, -1].map(
            (side) =>
              /** @type {[Point, Point]} */ (
                here.map(([x, y]) => [x + side * limit * line[0], y + side * limit * line[1]])
              ),
          ),
        }
      );
    case "normal":
      return line && { lines: normalOf(line, here) };
    case "mean": {
      const n = points.length / 2;
      const sum = dots.reduce(([sx, sy], [x, y]) => [sx + x, sy + y], [0, 0]);
      return { dots: [[sum[0] / n, sum[1] / n]] };
    }
    case "ends":
      return event.ends && { dots: [[event.ends[0], event.ends[1]]] };
    default:
      return null;
  }
}

/** The normal of a line: from the laser to the line, and beside its points. @param {import("./trace.js").Line} line @param {[Point, Point] | null} here @returns {[Point, Point][]} */
function normalOf([a, b, c], here) {
  /** @type {[Point, Point]} */
  const whole = [
    [0, 0],
    [-c * a, -c * b],
  ];
  if (!here) return [whole];
  const [[x1, y1], [x2, y2]] = here;
  const [x, y, long] = [(x1 + x2) / 2, (y1 + y2) / 2, Math.hypot(x2 - x1, y2 - y1) / 4];
  return [
    whole,
    [
      [x, y],
      [x + long * a, y + long * b],
    ],
  ];
}
