// @ts-check
// The stored pictures (app/handout/pool.py): a moment is a list of points or lines for each look.

/** @typedef {import("../stage/canvas.js").Node} Node */
/** @typedef {import("../stage/canvas.js").Picture} Picture */

export class Pictures {
  #handout;
  #arrays;
  #count;
  /** @type {Map<number, {xy: Float64Array, tones: Uint8Array}>} */ #lists = new Map();

  /** @param {import("../wire.js").Handout} handout @param {import("./unpack.js").Arrays} arrays */
  constructor(handout, arrays) {
    this.#handout = handout;
    this.#arrays = arrays;
    this.#count = arrays.moments.length / handout.looks.length;
  }

  /** @param {number} moment @param {boolean} dark @returns {Picture} */
  at(moment, dark) {
    const { looks, light, dark: night } = this.#handout;
    const nodes = looks.flatMap((look, k) => {
      const list = this.#arrays.moments[k * this.#count + moment];
      return list < 0 ? [] : [{ ...look, ...this.#list(list, look.kind) }];
    });
    return { palette: dark ? night : light, nodes };
  }

  /** @param {number} number @param {"points" | "lines"} kind */
  #list(number, kind) {
    const known = this.#lists.get(number);
    if (known) return known;
    const { starts, members, [`${kind}_tone`]: tone } = this.#arrays;
    const width = kind === "points" ? 2 : 4;
    const columns = Array.from({ length: width }, (_, k) => this.#arrays[`${kind}_${k}`]);
    const own = members.subarray(starts[number], starts[number + 1]);
    const list = { xy: new Float64Array(width * own.length), tones: new Uint8Array(own.length) };
    own.forEach((member, at) => {
      list.tones[at] = tone[member];
      columns.forEach((column, k) => (list.xy[width * at + k] = column[member] * this.#handout.unit));
    });
    this.#lists.set(number, list);
    return list;
  }
}
