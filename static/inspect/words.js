// @ts-check
// What looks wrong in the visible frames, as the server says it.
import { keyOf } from "../view/key.js";
import { fetchText } from "../fetch.js";

/** @typedef {import("../wire.js").State} State */

const REST_MS = 120;
// Few at once, so that the first rows need not wait for the last.
const MOST = 12;
const PARTS = /** @type {const} */ (["recording", "method", "params"]);

/**
 * @param {{session: () => string, wanted: () => number[], onWords: () => void}} handlers
 */
export function createWords({ session, wanted, onWords }) {
  /** @type {Map<number, string[]>} */
  let known = new Map();
  let key = "";
  let waiting = 0;
  let asking = false;

  async function ask() {
    waiting = 0;
    const missing = wanted()
      .filter((frame) => !known.has(frame))
      .slice(0, MOST);
    if (!missing.length || !key) return;
    asking = true;
    const { words, trouble } = await fetchText(
      `/api/why?${new URLSearchParams({ session: session(), frames: missing.join() })}`,
    );
    asking = false;
    if (trouble) return;
    const answer = /** @type {import("../wire.js").Whys} */ (JSON.parse(words));
    if (keyOf(answer, ...PARTS) === key) {
      for (const frame of missing) known.set(frame, answer.words[frame] ?? []);
      onWords();
    }
    need();
  }

  /** Requests the words of visible frames that are unknown, once nothing changes any more. */
  function need() {
    if (!waiting && !asking && wanted().some((frame) => !known.has(frame))) waiting = setTimeout(ask, REST_MS);
  }

  return {
    need,
    /** @param {number} frame @returns {string[] | undefined} undefined while it is not known */
    of: (frame) => known.get(frame),
    /** @param {State} state */
    setState(state) {
      const next = keyOf(state, ...PARTS);
      if (next === key) return;
      [key, known] = [next, new Map()];
      need();
    },
  };
}
