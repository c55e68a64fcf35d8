// @ts-check
// Lets the server merge the lines of all frames, and takes the map as a file.
import { linesOf } from "../fetch.js";

/**
 * @param {string} url
 * @param {string} broken what to say if the connection breaks
 * @param {(done: number, total: number) => void} onProgress
 * @param {AbortSignal} signal
 * @returns {Promise<import("./save.js").Saved>} rejected with a sentence
 */
export async function fetchMap(url, broken, onProgress, signal) {
  const made = await linesOf(url, broken, signal, ({ done, total }) => onProgress(done, total));
  const bytes = Uint8Array.from(atob(made.content), (letter) => letter.charCodeAt(0));
  return { name: made.name, content: new Blob([bytes]) };
}
