// @ts-check
// When the frames of a recording are shown while it plays: in the rhythm of their stamps, or steadily.

// A gap is longer than this [s], and than this many usual steps between scans.
const LEAST_GAP = 1;
const STEPS_OF_GAP = 5;
/** Frames per second if the stamps cannot be believed. */
export const STEADY = 10;

/** The frame at this place comes so long after the one before it [s]. @typedef {{place: number, seconds: number}} Gap */

export class Times {
  /** @type {Gap[]} */
  gaps = [];
  /** Why the stamps are not used, in a few words. */
  why;
  /** Whether frames play in the rhythm of their stamps. */
  real;
  /** When each frame is due, without the gaps [s]. */
  #due;

  /** @param {number} frames @param {number[] | null} since time since the first scan [s] @param {string} [why] */
  constructor(frames, since, why = "") {
    this.why = why;
    this.real = since?.length === frames;
    this.#due =
      since && this.real ? this.#withoutGaps(since) : Float64Array.from({ length: frames }, (_, k) => k / STEADY);
  }

  get frames() {
    return this.#due.length;
  }

  /** @param {number[]} since */
  #withoutGaps(since) {
    const steps = Float64Array.from(since, (time, k) => (k ? time - since[k - 1] : 0));
    const sorted = steps.filter((step) => step > 0).sort();
    const usual = sorted[sorted.length >> 1] ?? 0;
    const due = new Float64Array(since.length);
    for (let k = 1; k < since.length; k++) {
      const gap = steps[k] > Math.max(LEAST_GAP, STEPS_OF_GAP * usual);
      if (gap) this.gaps.push({ place: k, seconds: steps[k] });
      due[k] = due[k - 1] + (gap ? usual : steps[k]);
    }
    return due;
  }

  /** The place of the frame that is shown so long after another one [s]. @param {number} from @param {number} seconds */
  after(from, seconds) {
    const now = this.#due[from] + seconds;
    let [low, high] = [from, this.#due.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.#due[middle] <= now) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The time without scans that lies between two frames [s]. @param {number} from @param {number} to */
  skipped(from, to) {
    return this.gaps.reduce((sum, { place, seconds }) => sum + (place > from && place <= to ? seconds : 0), 0);
  }
}
