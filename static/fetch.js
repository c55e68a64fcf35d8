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

/**
 * Has the server do something long, which tells its progress in lines of JSON; the last one is the answer.
 * @param {string} url @param {string} broken what to say if the connection breaks @param {AbortSignal} signal
 * @param {(told: any) => void} onProgress
 * @returns {Promise<any>} rejected with a sentence
 */
export async function linesOf(url, broken, signal, onProgress) {
  const response = await fetch(url, { method: "POST", signal });
  if (!response.ok || !response.body) throw new Error(messageOf(await response.text()));
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  let answer = null;
  for (;;) {
    const { done, value } = await reader.read();
    if (done && answer) return answer;
    if (done) throw new Error(broken);
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) {
      const told = JSON.parse(line);
      if (told.message) throw new Error(told.message);
      if ("total" in told) onProgress(told);
      else answer = told;
    }
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
