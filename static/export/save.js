// @ts-check
// Files made by the server, fetched in a way that shows progress and the reason of a failure.
import { messageOf } from "../fetch.js";

// A row of segments begins with its frame in CSV; in JSON lines and GeoJSON it is the first field of this name.
const FRAME = /^(\d+),|"frame": (\d+)/;

/** @typedef {{name: string, content: Blob}} Saved */

/**
 * @param {string} url
 * @param {string} broken what to say if the connection breaks
 * @param {RequestInit} [options]
 * @param {(frame: number) => void} [onFrame] told the frame of the newest whole row
 * @returns {Promise<Saved>} rejected with a sentence
 */
export async function fetchFile(url, broken, options = {}, onFrame = () => {}) {
  const response = await fetch(url, options).catch(() => null);
  if (!response) throw new Error(broken);
  if (!response.ok || !response.body) throw new Error(messageOf(await response.text()));
  const [, name] = /filename\*=UTF-8''([^;]+)/.exec(response.headers.get("Content-Disposition") ?? "") ?? [
    "",
    "lineseg",
  ];
  const type = response.headers.get("Content-Type") ?? "";
  const reader = response.body.getReader();
  const decoder = new TextDecoder();
  /** @type {Uint8Array<ArrayBuffer>[]} */
  const parts = [];
  for (;;) {
    const { done, value } = await reader.read().catch(() => {
      throw new Error(broken);
    });
    if (done) return { name: decodeURIComponent(name), content: new Blob(parts, { type }) };
    parts.push(value);
    const [, inCsv, inJson] = FRAME.exec(lastRow(decoder.decode(value))) ?? [];
    if (inCsv ?? inJson) onFrame(Number(inCsv ?? inJson));
  }
}

/** The last complete row in a piece of text. @param {string} piece */
function lastRow(piece) {
  const end = piece.lastIndexOf("\n");
  return piece.slice(piece.lastIndexOf("\n", end - 1) + 1, Math.max(end, 0));
}
