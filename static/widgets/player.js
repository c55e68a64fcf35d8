// @ts-check
// A clock that asks for the next frame or decision, but never before the last one is drawn.

/**
 * @typedef {object} Track
 * @property {() => boolean} ready the last one was drawn
 * @property {() => boolean} atEnd
 * @property {() => void} rewind
 * @property {() => void} next
 * @property {(playing: boolean) => void} onState
 */

export class Player {
  #timer = 0;
  #perSecond;
  #track;

  /** @param {number} perSecond @param {Track} track */
  constructor(perSecond, track) {
    this.#perSecond = perSecond;
    this.#track = track;
  }

  get playing() {
    return this.#timer !== 0;
  }

  /** @param {number} perSecond */
  setSpeed(perSecond) {
    this.#perSecond = perSecond;
    if (!this.playing) return;
    clearInterval(this.#timer);
    this.#run();
  }

  toggle() {
    if (this.playing) return this.stop();
    if (this.#track.atEnd()) this.#track.rewind();
    this.#run();
    return this.#track.onState(true);
  }

  stop() {
    if (!this.playing) return;
    clearInterval(this.#timer);
    this.#timer = 0;
    this.#track.onState(false);
  }

  #run() {
    this.#timer = setInterval(() => {
      if (!this.#track.ready()) return;
      if (this.#track.atEnd()) this.stop();
      else this.#track.next();
    }, 1000 / this.#perSecond);
  }
}
