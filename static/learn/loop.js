// @ts-check
// A loop over a stretch of decisions: started, closed, removed.

/** to null: begun, not closed. @typedef {{from: number, to: number | null}} Range */

export class Loop {
  /** @type {Range | null} */ range = null;

  /** Moves on to the next of started, closed, removed. @param {number | null} at the current decision */
  toggle(at) {
    if (!this.range) this.range = { from: at ?? 0, to: null };
    else if (this.range.to === null) this.range = ordered(this.range.from, at ?? this.range.from);
    else this.range = null;
  }

  end() {
    this.range = null;
  }

  /** The start of the loop; null unless the loop is closed. */
  get start() {
    return this.range && this.range.to !== null ? this.range.from : null;
  }

  /** The same decision, or the start of the loop if it lies outside. @param {number} next */
  inside(next) {
    if (!this.range || this.range.to === null) return next;
    return next > this.range.to || next < this.range.from ? this.range.from : next;
  }
}

/** @param {number} one @param {number} other */
function ordered(one, other) {
  return { from: Math.min(one, other), to: Math.max(one, other) };
}
