// @ts-check
// The decisions of one frame as the page holds them: columns from the server (app/frame/stepping.py), read one at a time.

/** @typedef {import("../wire.js").Line} Line a, b, c */
/** @typedef {import("../wire.js").Columns} Columns */

/**
 * One decision; fields as in lineseg/tracing/decisions.py. Infinite numbers arrive as null and become Infinity.
 * @typedef {object} Event
 * @property {number} index
 * @property {string} kind
 * @property {string} check
 * @property {string} phase
 * @property {number} direction
 * @property {number} candidate
 * @property {number} first
 * @property {number} last
 * @property {number} beam
 * @property {number} points
 * @property {Line | null} line
 * @property {Line | null} other
 * @property {number[] | null} ends x1, y1, x2, y2 of "endpoints"
 * @property {number} value
 * @property {number} limit
 * @property {string} text its sentence
 */

/** Kinds of decisions to jump to; the columns say where they are. */
export const JUMPS = /** @type {const} */ (["seed", "refusal", "line", "drop", "merge", "cut"]);
/** @typedef {(typeof JUMPS)[number]} Jump */
/** @typedef {"decision" | "phase" | "line"} Level */

/** Decisions about all points of a line at once. */
const OF_A_LINE = new Set(["line kept", "line dropped", "lines merged", "overlap cut"]);

export class Trace {
  /** @type {Record<Jump, number[]>} */ marks;
  /** @type {Record<Level, number[] | null>} where a stretch begins; null: everywhere */ starts;

  /** @param {Columns} columns */
  constructor(columns) {
    this.columns = columns;
    this.length = columns.kind.length;
    this.beams = columns.x.length;
    this.marks = /** @type {Record<Jump, number[]>} */ (
      Object.fromEntries(JUMPS.map((name) => [name, columns.jumps[name] ?? []]))
    );
    this.starts = { decision: null, ...columns.starts };
  }

  /** @param {number} index @returns {Event} */
  at(index) {
    const { columns: c } = this;
    const line = /** @type {Line} */ ([c.a, c.b, c.c].map((column) => column[index] ?? Infinity));
    return {
      index,
      kind: c.kinds[c.kind[index]],
      check: c.checks[c.check[index]],
      phase: c.phases[c.phase[index]],
      direction: c.direction[index],
      candidate: c.candidate[index],
      first: c.first[index],
      last: c.last[index],
      beam: c.beam[index],
      points: c.points[index],
      line: Math.hypot(line[0], line[1]) > 0.5 ? line : null,
      other: c.others[index] ?? null,
      ends: c.ends[index] ?? null,
      value: c.value[index] ?? Infinity,
      limit: c.limit[index] ?? Infinity,
      text: c.text[index],
    };
  }

  /**
   * The first of two lines that were compared, as it was before: a merge records the resulting line.
   * @param {Event} event @returns {Line | null}
   */
  compared({ index, kind, candidate, line }) {
    if (kind !== "lines merged") return line;
    const { columns: c } = this;
    for (let k = index - 1; k >= 0; k--) {
      if (c.candidate[k] === candidate && ["line kept", "lines merged"].includes(c.kinds[c.kind[k]]))
        return this.at(k).line;
    }
    return line;
  }

  /** The valid beams from `first` to `last`, across the seam of a full circle. @param {number} first @param {number} last */
  span(first, last) {
    const n = this.beams;
    const count = last >= first ? last - first + 1 : this.columns.circle ? last - first + 1 + n : 0;
    const beams = [];
    for (let k = 0; k < count; k++) {
      const beam = (first + k) % n;
      if (this.columns.x[beam] !== null) beams.push(beam);
    }
    return beams;
  }

  /** @param {number} beam @returns {[number, number] | null} its point [m] */
  point(beam) {
    const x = this.columns.x[beam];
    const y = this.columns.y[beam];
    return x === null || y === null || x === undefined || y === undefined ? null : [x, y];
  }

  /** @param {number} beam @param {Line} line */
  distance(beam, [a, b, c]) {
    const at = this.point(beam);
    return at ? Math.abs(a * at[0] + b * at[1] + c) : NaN;
  }

  /**
   * Range ρ, bearing θ, and the range ρ′ at which the beam meets the line.
   * @param {number} beam @param {Line} line
   */
  predicted(beam, [a, b, c]) {
    const [x, y] = this.point(beam) ?? [NaN, NaN];
    const range = Math.hypot(x, y);
    const along = (a * x + b * y) / range;
    return { range, bearing: Math.atan2(y, x), meets: along === 0 ? Infinity : -c / along };
  }

  /** Whether beam lies between first and last of the decision. @param {number} index @param {number} beam */
  covers(index, beam) {
    const first = this.columns.first[index];
    const last = this.columns.last[index];
    return first <= last ? first <= beam && beam <= last : this.columns.circle && (beam >= first || beam <= last);
  }

  /**
   * The next decision after `from` that is about the beam: about the beam itself, about its line, or about the first seed window that includes it.
   * @param {number} beam @param {number} from @returns {number} −1 if there is none
   */
  nextAbout(beam, from) {
    const { columns: c } = this;
    for (let k = from + 1; k < this.length; k++) {
      if (c.beam[k] === beam) return k;
      const kind = c.kinds[c.kind[k]];
      if (kind === "point added" || !this.covers(k, beam)) continue;
      if (OF_A_LINE.has(kind) || !(k > 0 && this.covers(k - 1, beam))) return k;
    }
    return -1;
  }

  /** Steps from `from` to the next start of this level. @param {number} from @param {number} by @param {Level} level */
  moved(from, by, level) {
    const last = this.length - 1;
    const starts = this.starts[level];
    if (!Number.isFinite(by)) return by < 0 ? 0 : last;
    if (!starts) return Math.min(Math.max(from + by, 0), last);
    let at = from;
    for (let k = Math.abs(by); k > 0; k--) {
      at = by > 0 ? (starts.find((start) => start > at) ?? last) : (starts.findLast((start) => start < at) ?? 0);
    }
    return at;
  }
}

/** How the listing names a decision. @param {Event} event */
export function eventName({ phase, kind, check, direction }) {
  const way = direction > 0 ? " forward" : direction < 0 ? " backward" : "";
  return `${phase}: ${kind}${check ? ` (${check})` : ""}${way}`;
}
