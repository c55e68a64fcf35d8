// @ts-check
// The points of the frame on the screen, requested when they are needed.
import { fetchText } from "../fetch.js";

/** @typedef {import("../wire.js").Sweep} Sweep */

export class FrameSweep {
  /** The sweep of the frame, once it is known. @type {Sweep | null} */ now = null;
  #onCome;
  #asked = "";

  /** @param {() => void} onCome */
  constructor(onCome) {
    this.#onCome = onCome;
  }

  /** Forgets the points, because another frame is shown. */
  drop() {
    [this.#asked, this.now] = ["", null];
  }

  /** @param {import("../wire.js").State} state of the frame */
  async need({ recording, readAs, frame }) {
    const query = new URLSearchParams({ recording, reading: JSON.stringify(readAs), frame: String(frame) });
    const key = String(query);
    if (key === this.#asked) return;
    [this.#asked, this.now] = [key, null];
    const { words, trouble } = await fetchText(`/api/labels/points?${key}`);
    if (this.#asked !== key) return;
    if (trouble) this.#asked = "";
    else this.now = JSON.parse(words);
    this.#onCome();
  }
}
