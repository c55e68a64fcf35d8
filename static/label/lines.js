// @ts-check
// Edits of true lines. A line is a run of beams, first to last; no beam is on two lines. All functions are pure.

/** @typedef {import("../wire.js").Point} Point */
/** Without its ends the server fits them. @typedef {import("../wire.js").SaidLine} Line */
/** points: of each beam, null without a return. @typedef {import("../wire.js").Sweep} Sweep */
/** @typedef {"first" | "last"} End */

// The fewest points of a line.
const LEAST_POINTS = 2;

/** The beams of a run, which may continue from the last beam to the first. @param {Line} line @param {number} n */
export function beamsOf({ first, last }, n) {
  return Array.from({ length: ((last - first + n) % n) + 1 }, (_, k) => (first + k) % n);
}

/** The beams of a line that have a point. @param {Line} line @param {Sweep} sweep */
export function seenOf(line, { points }) {
  return beamsOf(line, points.length).filter((beam) => points[beam]);
}

/** The line over these beams, from its first point to its last; null if there are too few points. @param {number[]} beams @param {Sweep} sweep @returns {Line | null} */
function lineOver(beams, { points }) {
  const seen = beams.filter((beam) => points[beam]);
  return seen.length < LEAST_POINTS ? null : { first: seen[0], last: seen[seen.length - 1] };
}

/** @param {Line[]} lines @param {Line} chosen @returns {{lines: Line[], chosen: number}} in the order of the beams */
function ordered(lines, chosen) {
  const sorted = [...lines].sort((one, other) => one.first - other.first);
  return { lines: sorted, chosen: sorted.indexOf(chosen) };
}

/**
 * The beams to which an end of a line can move, in scan order, up to its neighbours.
 * @param {Line[]} lines @param {number} k @param {End} end @param {Sweep} sweep
 */
export function placesOf(lines, k, end, sweep) {
  const n = sweep.points.length;
  const taken = new Set(lines.flatMap((line, other) => (other === k ? [] : beamsOf(line, n))));
  const [fixed, by] = end === "last" ? [lines[k].first, 1] : [lines[k].last, -1];
  const places = [];
  for (let step = 1; step < n; step++) {
    const at = fixed + by * step;
    const beam = (at + n) % n;
    if ((at !== beam && !sweep.fullCircle) || taken.has(beam)) break;
    if (sweep.points[beam]) places.push(beam);
  }
  return by > 0 ? places : places.reverse();
}

/** @param {Line[]} lines @param {number} k @param {End} end @param {number} beam one of its places */
export function moved(lines, k, end, beam) {
  const { first, last } = lines[k];
  return inPlaceOf(lines, k, { first, last, [end]: beam });
}

/** @param {Line[]} lines @param {number} k @param {Line[]} instead */
function inPlaceOf(lines, k, ...instead) {
  return ordered([...lines.slice(0, k), ...instead, ...lines.slice(k + 1)], instead[0]);
}

/** Splits a line after a beam. Null if one of the two lines would have too few points. @param {Line[]} lines @param {number} k @param {number} beam @param {Sweep} sweep */
export function split(lines, k, beam, sweep) {
  const beams = beamsOf(lines[k], sweep.points.length);
  const cut = beams.indexOf(beam) + 1;
  const [before, after] = [lineOver(beams.slice(0, cut), sweep), lineOver(beams.slice(cut), sweep)];
  return before && after ? inPlaceOf(lines, k, before, after) : null;
}

/** Merges a line with a neighbour. Null if there is none on that side. @param {Line[]} lines @param {number} k @param {1 | -1} by @param {Sweep} sweep */
export function merged(lines, k, by, { fullCircle }) {
  const other = fullCircle ? (k + by + lines.length) % lines.length : k + by;
  if (!lines[other] || other === k) return null;
  const [one, next] = by > 0 ? [k, other] : [other, k];
  const joined = { first: lines[one].first, last: lines[next].last };
  return ordered([...lines.filter((_, each) => each !== one && each !== next), joined], joined);
}

/** @param {Line[]} lines @param {number} k */
export function without(lines, k) {
  return { lines: lines.filter((_, each) => each !== k), chosen: Math.min(k, lines.length - 2) };
}

/** The beams between two beams, the shorter way round on a full circle. @param {number} from @param {number} to @param {Sweep} sweep */
export function runBetween(from, to, { points, fullCircle }) {
  const n = points.length;
  const [first, last] = [Math.min(from, to), Math.max(from, to)];
  return beamsOf(fullCircle && 2 * (last - first) > n ? { first: last, last: first } : { first, last }, n);
}

/** Adds a line over a run and takes its beams from other lines. Null if it would have too few points. @param {Line[]} lines @param {number[]} run @param {Sweep} sweep */
export function drawn(lines, run, sweep) {
  const line = lineOver(run, sweep);
  if (!line) return null;
  const taken = new Set(run);
  const rest = lines.flatMap((other) => {
    const beams = beamsOf(other, sweep.points.length);
    if (!beams.some((beam) => taken.has(beam))) return [other];
    return pieces(beams, taken).flatMap((piece) => lineOver(piece, sweep) ?? []);
  });
  return ordered([...rest, line], line);
}

/** Runs of the beams that are not taken. @param {number[]} beams @param {Set<number>} taken */
function pieces(beams, taken) {
  /** @type {number[][]} */
  const found = [[]];
  for (const beam of beams) {
    if (taken.has(beam)) found.push([]);
    else found[found.length - 1].push(beam);
  }
  return found;
}
