// @ts-check
// Plays a recording by the clock: if drawing cannot keep up, frames are left out and time goes on.

// Longer pauses are not made up for: the tab was hidden, or the computer asleep [ms].
const LONGEST_PAUSE_MS = 1000;

/**
 * @typedef {object} Reel
 * @property {() => boolean} ready the last frame is drawn
 * @property {() => number} place of the frame that is shown
 * @property {() => number} last place
 * @property {(from: number, seconds: number) => number} after the place of the frame that is shown so long after another one
 * @property {(place: number) => void} show
 * @property {() => void} onState it plays, or no longer
 */

export class Playback {
  /** How many times faster than it happened. */
  speed = 1;
  #reel;
  #request = 0;
  /** Where playing began, and how much of the recording has passed since [s]. */
  #from = 0;
  #passed = 0;
  #now = 0;

  /** @param {Reel} reel */
  constructor(reel) {
    this.#reel = reel;
  }

  get playing() {
    return this.#request !== 0;
  }

  toggle() {
    if (this.playing) return this.stop();
    if (this.#reel.place() >= this.#reel.last()) this.#reel.show(0);
    this.restart();
    this.#now = performance.now();
    this.#request = requestAnimationFrame(() => this.#tick());
    return this.#reel.onState();
  }

  stop() {
    if (!this.playing) return;
    cancelAnimationFrame(this.#request);
    this.#request = 0;
    this.#reel.onState();
  }

  /** Goes on from the frame that is shown, because somebody moved to it or the times are other ones. */
  restart() {
    this.#from = this.#reel.place();
    this.#passed = 0;
  }

  #tick() {
    const now = performance.now();
    this.#passed += (this.speed * Math.min(now - this.#now, LONGEST_PAUSE_MS)) / 1000;
    this.#now = now;
    const place = this.#reel.place();
    if (this.#reel.ready()) {
      if (place >= this.#reel.last()) return this.stop();
      const due = this.#reel.after(this.#from, this.#passed);
      if (due > place) this.#reel.show(due);
    }
    this.#request = requestAnimationFrame(() => this.#tick());
    return undefined;
  }
}
