// @ts-check
import { rerunText } from "../text/rerun.js";
import { messageOf } from "../fetch.js";

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
  const response = await fetch(`/api/rerun?${query}`, { method: "POST", signal });
  if (!response.ok || !response.body) throw new Error(messageOf(await response.text()));
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  /** @type {Recorded | null} */
  let recorded = null;
  for (;;) {
    const { done, value } = await reader.read();
    if (done && recorded) return recorded;
    if (done) throw new Error(rerunText.broken);
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) {
      const told = JSON.parse(line);
      if (told.message) throw new Error(told.message);
      if (told.recording) recorded = told;
      else onProgress(told.done, told.total);
    }
  }
}

/** @param {string} recording @param {string} [name] to be saved as */
export function addressOf(recording, name) {
  const query = name === undefined ? "" : `?${new URLSearchParams({ name })}`;
  return `${location.origin}/api/rerun/${recording}.rrd${query}`;
}
