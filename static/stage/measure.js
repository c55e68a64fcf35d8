// @ts-check
// Distances and angles between points and lines of the plan. All functions are pure.

/** @typedef {[number, number]} Point */
/** line: a, b, c of its normal form, if it is a line @typedef {{at: Point, ends?: [Point, Point], line?: [number, number, number]}} Anchor */
/** from, to: where the distance is drawn; cross: where two lines meet @typedef {{from: Point, to: Point, distance: number, angle: number | null, cross: Point | null}} Measured */

// Lines at a smaller angle have a distance.
const PARALLEL = (10 * Math.PI) / 180;

/** The distance between two points, of a point from a line, or of two lines, and the angle of two lines [rad]. @param {Anchor} one @param {Anchor} other @returns {Measured} */
export function measured(one, other) {
  if (one.line && other.line)
    return betweenLines(/** @type {Required<Anchor>} */ (one), /** @type {Required<Anchor>} */ (other));
  const [from, to] = one.line
    ? [other.at, foot(other.at, one.line)]
    : [one.at, other.line ? foot(one.at, other.line) : other.at];
  return { from, to, distance: apart(from, to), angle: null, cross: null };
}

/** @param {Required<Anchor>} one @param {Required<Anchor>} other @returns {Measured} */
function betweenLines(one, other) {
  const [[a1, b1, c1], [a2, b2, c2]] = [one.line, other.line];
  const sine = a1 * b2 - a2 * b1;
  const angle = Math.atan2(Math.abs(sine), Math.abs(a1 * a2 + b1 * b2));
  const cross = /** @type {Point} */ ([(b1 * c2 - b2 * c1) / sine, (a2 * c1 - a1 * c2) / sine]);
  if (angle < PARALLEL) {
    const from = middle(other.ends);
    const to = foot(from, one.line);
    return { from, to, distance: apart(from, to), angle, cross: null };
  }
  const pairs = one.ends.flatMap((end) => other.ends.map((end2) => /** @type {[Point, Point]} */ ([end, end2])));
  const [from, to] = pairs.sort((pair, next) => apart(...pair) - apart(...next))[0];
  return { from, to, distance: apart(from, to), angle, cross };
}

/** The foot of the perpendicular on a line. @param {Point} point @param {[number, number, number]} line @returns {Point} */
function foot([x, y], [a, b, c]) {
  const off = (a * x + b * y + c) / (a * a + b * b);
  return [x - a * off, y - b * off];
}

/** @param {Point} one @param {Point} other */
function apart(one, other) {
  return Math.hypot(one[0] - other[0], one[1] - other[1]);
}

/** @param {[Point, Point]} ends @returns {Point} */
function middle([[x1, y1], [x2, y2]]) {
  return [(x1 + x2) / 2, (y1 + y2) / 2];
}

/** How far a place is from the part of a line between its ends. @param {Point} point @param {[Point, Point]} ends */
export function fromPart([x, y], [[x1, y1], [x2, y2]]) {
  const [dx, dy] = [x2 - x1, y2 - y1];
  const along = Math.min(Math.max(((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return Math.hypot(x - x1 - along * dx, y - y1 - along * dy);
}
