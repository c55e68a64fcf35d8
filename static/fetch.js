// @ts-check
// Answers of the server as text, or a sentence that says why there is none.
import { pageText } from "./text/page.js";

/** @param {string} url @param {RequestInit} [options] @returns {Promise<{words: string, trouble: string | null}>} */
export async function fetchText(url, options) {
  try {
    const response = await fetch(url, options);
    const words = await response.text();
    return { words, trouble: response.ok ? null : messageOf(words) };
  } catch (error) {
    return { words: "", trouble: String(error) };
  }
}

/** The message in an error of the server. @param {string} body */
export function messageOf(body) {
  try {
    return String(JSON.parse(body).message);
  } catch {
    return body.slice(0, 300) || pageText.noAnswer;
  }
}
