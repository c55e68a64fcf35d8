// @ts-check
// The geometry of what a sentence names. All functions are pure.

/** @typedef {import("../wire.js").Link} Link */
/** @typedef {import("../wire.js").Finding} Finding */
/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Sweep} Sweep */
/** @typedef {import("./overlay.js").Shape} Shape */
/** @typedef {import("./overlay.js").Point} Point */

// More dots could not be told apart.
const MOST_DOTS = 150;
// Labels with round numbers have precedence.
const ROUND = [100, 50, 20, 10, 5, 2, 1];

/** @param {Link} named @param {State} state @param {Sweep | null} sweep @returns {Shape | null} null: nothing in the scene, or not known yet */
export function shapeOfNamed({ beams, segment, line }, { segments }, sweep) {
  if (line) return { lines: [endsOf(line)] };
  if (segment !== undefined) {
    const shown = segments[segment];
    if (!shown) return null;
    const [start, end] = [shown.start, shown.end];
    const middle = /** @type {Point} */ ([(start[0] + end[0]) / 2, (start[1] + end[1]) / 2]);
    return { lines: [[start, end]], labels: [{ at: middle, text: String(segment) }] };
  }
  return beams && sweep ? spanned(beams[0], beams[1], sweep) : null;
}

/** The lines that a finding misses, and the points that it is about. @param {Finding} finding @param {Sweep | null} sweep @returns {Shape} */
export function shapeOfFinding({ first, last, ghosts }, sweep) {
  const span = first >= 0 && sweep ? spanned(first, last, sweep) : null;
  return { ...span, lines: [...(span?.lines ?? []), ...ghosts.map(endsOf)] };
}

/** @param {[number, number, number, number]} line @returns {[Point, Point]} */
function endsOf([x1, y1, x2, y2]) {
  return [
    [x1, y1],
    [x2, y2],
  ];
}

/** The points of the beams from first to last; without a point, the gap where they would be. @param {number} first @param {number} last @param {Sweep} sweep @returns {Shape | null} */
function spanned(first, last, { points }) {
  const n = points.length;
  if (first >= n || last >= n) return null;
  const beams = Array.from({ length: ((last - first + n) % n) + 1 }, (_, k) => (first + k) % n);
  const seen = beams.filter((beam) => points[beam]);
  const point = (/** @type {number} */ beam) => /** @type {Point} */ (points[beam]);
  if (!seen.length) {
    const around = [seek(points, first, -1), seek(points, last, 1)];
    return around.includes(-1) ? null : between(around, point);
  }
  const ends = [...new Set([seen[0], seen[seen.length - 1]])];
  const every = Math.ceil(seen.length / MOST_DOTS);
  const dots = seen.filter((_, k) => k % every === 0).map(point);
  return {
    ...(beams.length === 2 && ends.length === 2 ? between(ends, point) : { labels: labelled(ends, point) }),
    dots,
  };
}

/** @param {number[]} ends beams @param {(beam: number) => Point} point @returns {Shape} */
function between(ends, point) {
  return { lines: [[point(ends[0]), point(ends[1])]], labels: labelled(ends, point) };
}

/** @param {number[]} beams @param {(beam: number) => Point} point */
function labelled(beams, point) {
  return beams.map((beam) => ({ at: point(beam), text: String(beam) }));
}

/** The nearest beam with a point. @param {(Point | null)[]} points @param {number} from @param {1 | -1} by @returns {number} −1: there is none */
function seek(points, from, by) {
  const n = points.length;
  for (let k = 1; k < n; k++) if (points[(from + by * k + n) % n]) return (from + by * k + n) % n;
  return -1;
}

/** The number of every beam at its point, round numbers first. @param {Sweep} sweep */
export function beamsOf({ points }) {
  const rank = (/** @type {number} */ beam) => ROUND.findIndex((round) => beam % round === 0);
  return points
    .flatMap((at, beam) => (at ? [{ at, text: String(beam), beam }] : []))
    .sort((one, other) => rank(one.beam) - rank(other.beam) || one.beam - other.beam);
}

/** The beam whose point is nearest to a place on the stage, within reach. @param {Sweep} sweep @param {Point} at @param {(x: number, y: number) => Point | null} project @param {number} reach [px] */
export function nearestBeam({ points }, at, project, reach) {
  let [best, least] = [/** @type {number | null} */ (null), reach];
  for (const [beam, point] of points.entries()) {
    const spot = point && project(...point);
    const away = spot ? Math.hypot(spot[0] - at[0], spot[1] - at[1]) : Infinity;
    if (away < least) [best, least] = [beam, away];
  }
  return best;
}

/** @param {Shape} shape @returns {import("../wire.js").Box | null} */
export function boxAround({ dots = [], lines = [], labels = [] }) {
  const all = [...dots, ...lines.flat(), ...labels.map(({ at }) => at)];
  if (!all.length) return null;
  const [xs, ys] = [all.map(([x]) => x), all.map(([, y]) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}
