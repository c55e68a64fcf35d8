// @ts-check
// Plain plane geometry over the points of a trace.

/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Line} Line */
/** @typedef {[number, number]} Point */

/** Foot of the perpendicular from a point on a line with unit normal (Eq. 8). @param {Point} point @param {Line} line @returns {Point} */
export function foot([x, y], [a, b, c]) {
  const d = a * x + b * y + c;
  return [x - d * a, y - d * b];
}

/**
 * The line fitted to points by total least squares, with its moments (Eqs. 1, 2).
 * @param {Trace} trace @param {number[]} beams
 */
export function fit(trace, beams) {
  const points = beams.map((beam) => /** @type {Point} */ (trace.point(beam)));
  const n = points.length;
  const mean = (/** @type {(point: Point) => number} */ of) => points.reduce((sum, point) => sum + of(point), 0) / n;
  const x = mean(([px]) => px);
  const y = mean(([, py]) => py);
  const xx = n * mean(([px]) => (px - x) ** 2);
  const yy = n * mean(([, py]) => (py - y) ** 2);
  const xy = n * mean(([px, py]) => (px - x) * (py - y));
  const phi = 0.5 * Math.atan2(2 * xy, xx - yy);
  let [a, b] = [-Math.sin(phi), Math.cos(phi)];
  let c = -(a * x + b * y);
  if (c > 0) [a, b, c] = [-a, -b, -c];
  return { n, x, y, xx, xy, yy, phi, line: /** @type {Line} */ ([a, b, c]) };
}

/** The part of the line beside the beams, from the foot of the first to that of the last. @param {Trace} trace @param {number[]} beams @param {Line} line @returns {[Point, Point] | null} */
export function stretch(trace, beams, line) {
  const along = (/** @type {Point} */ [x, y]) => -line[1] * x + line[0] * y;
  const feet = beams.map((beam) => trace.point(beam)).flatMap((point) => (point ? [foot(point, line)] : []));
  if (!feet.length) return null;
  feet.sort((one, other) => along(one) - along(other));
  return [feet[0], feet[feet.length - 1]];
}

/** Length between the projected outermost points, which is compared with L_min. @param {Trace} trace @param {number} first @param {number} last @param {Line} line */
export function lengthOf(trace, first, last, line) {
  const one = trace.point(first);
  const other = trace.point(last);
  if (!one || !other) return NaN;
  const [x1, y1] = foot(one, line);
  const [x2, y2] = foot(other, line);
  return Math.hypot(x2 - x1, y2 - y1);
}
