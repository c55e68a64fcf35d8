// @ts-check
// The thresholds for which results are stored: some with every decision, and ranges of one threshold around them.
import { isIn } from "../view/key.js";

/** @typedef {import("../wire.js").Handout} Handout */
/** @typedef {import("../wire.js").Stand} Stand */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Columns} Columns */
/** whole: whether its decisions are stored, too. @typedef {{stand: Stand, params: Params, result: number, whole: boolean}} Place */

export class Stands {
  #stands;
  /** Of each, its decisions and none. @type {Map<Stand, {all: Columns, none: Columns}>} */ #columns = new Map();

  /** @param {Handout} handout */
  constructor({ stands, x, y }) {
    this.#stands = stands;
    for (const stand of stands) {
      const columns = { ...stand.trace, x, y };
      const jumps = Object.fromEntries(Object.keys(columns.jumps).map((name) => [name, []]));
      const none = { ...columns, kind: [], jumps, starts: { phase: [], line: [] }, total: 0 };
      this.#columns.set(stand, { all: columns, none });
    }
  }

  get first() {
    return whole(this.#stands[0]);
  }

  /** The decisions, as far as they are stored. @param {Place} place @returns {Columns} */
  columnsOf({ stand, whole }) {
    const { all, none } = /** @type {{all: Columns, none: Columns}} */ (this.#columns.get(stand));
    return whole ? all : none;
  }

  /**
   * The stored thresholds nearest to those that are wanted: these, or the present ones with one threshold changed.
   * @param {string} method @param {Params} wanted @param {Place} present @returns {Place}
   */
  nearest(method, wanted, present) {
    const own = this.#stands.filter((stand) => stand.method === method);
    const exact = own.find((stand) => isIn(stand.params, wanted));
    if (exact) return whole(exact);
    const stand = own.includes(present.stand) ? present.stand : (own[0] ?? present.stand);
    const name = Object.keys(stand.ranges).find((each) => wanted[each] !== present.params[each]);
    if (!name) return own.includes(present.stand) ? present : whole(stand);
    const { values, results } = stand.ranges[name];
    const at = nearestTo(values, wanted[name], present.params[name]);
    if (values[at] === stand.params[name]) return whole(stand);
    return { stand, params: { ...stand.params, [name]: values[at] }, result: results[at], whole: false };
  }
}

/** @param {Stand} stand @returns {Place} */
function whole(stand) {
  return { stand, params: stand.params, result: stand.result, whole: true };
}

/** The place of the nearest value; a step that is too small for the nearest to be another one goes to the next. @param {number[]} values @param {number} wanted @param {number} present */
function nearestTo(values, wanted, present) {
  const far = values.map((value) => Math.abs(value - wanted));
  const at = far.indexOf(Math.min(...far));
  if (values[at] !== present || wanted === present) return at;
  return Math.min(Math.max(at + Math.sign(wanted - present), 0), values.length - 1);
}
