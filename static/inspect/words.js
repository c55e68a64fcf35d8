// @ts-check
// What looks wrong in the visible frames, as the server says it.
import { fetchText } from "../fetch.js";
import { keyOf } from "../view/key.js";
import { plain } from "../widgets/words.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Finding} Finding */

const REST_MS = 120;
// Few at once, so that the first rows need not wait for the last.
const MOST = 12;
const PARTS = /** @type {const} */ (["place", "method", "params"]);

/**
 * @param {{session: () => string, wanted: () => number[], onWords: () => void}} handlers
 */
export function createWords({ session, wanted, onWords }) {
  /** @type {Map<number, Finding[]>} */
  let known = new Map();
  let key = "";
  let waiting = 0;
  /** @type {AbortController | null} */
  let asking = null;

  async function ask() {
    waiting = 0;
    const missing = wanted()
      .filter((frame) => !known.has(frame))
      .slice(0, MOST);
    if (!missing.length || !key) return;
    asking = new AbortController();
    const { signal } = asking;
    const query = new URLSearchParams({ session: session(), frames: missing.join() });
    const { words, trouble } = await fetchText(`/api/why?${query}`, { signal });
    asking = null;
    if (signal.aborted) return need();
    if (trouble) return;
    const answer = /** @type {import("../wire.js").Whys} */ (JSON.parse(words));
    if (keyOf(answer, ...PARTS) === key) {
      // A frame that the recording no longer has is left out of a whole answer.
      for (const frame of missing) if (answer.whole || answer.found[frame]) known.set(frame, answer.found[frame] ?? []);
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
    /** @param {number} frame @returns {Finding[] | undefined} undefined while it is not known */
    of: (frame) => known.get(frame),
    /** The same as sentences. @param {number} frame */
    texts: (frame) => known.get(frame)?.map((finding) => plain(finding.words)),
    /** @param {State} state */
    setState(state) {
      const next = keyOf(state, ...PARTS);
      if (next === key) return;
      [key, known] = [next, new Map()];
      asking?.abort();
      // Each change of a drag begins the rest anew.
      clearTimeout(waiting);
      waiting = 0;
      need();
    },
  };
}
