// @ts-check
import { linesOf } from "../fetch.js";
import { rerunText } from "../text/rerun.js";

/** @typedef {{recording: string, bytes: number}} Recorded */

/**
 * Lets the server record what this tab shows.
 * @param {string} session
 * @param {boolean} steps every decision of the frame under view; without, all frames
 * @param {(done: number, total: number) => void} onProgress
 * @param {AbortSignal} signal
 * @returns {Promise<Recorded>} rejected with a sentence
 */
export async function record(session, steps, onProgress, signal) {
  const query = new URLSearchParams({ session, steps: String(steps) });
  return linesOf(`/api/rerun?${query}`, rerunText.broken, signal, ({ done, total }) => onProgress(done, total));
}

/** @param {string} recording @param {string} [name] to be saved as */
export function addressOf(recording, name) {
  const query = name === undefined ? "" : `?${new URLSearchParams({ name })}`;
  return `${location.origin}/api/rerun/${recording}.rrd${query}`;
}
