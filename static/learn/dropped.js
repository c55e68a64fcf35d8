// @ts-check
// Files of lessons that were dropped on the page, with the pictures and recordings that belong to them.
import { fetchText } from "../fetch.js";

/** @typedef {import("./lessons.js").Lesson} Lesson */

const LARGEST = 1_000_000;

/** Whether one of these files is a lesson, if perhaps one with mistakes. @param {File[]} files */
export async function hasLesson(files) {
  const small = files.filter(({ name, size }) => /\.json$/i.test(name) && size <= LARGEST);
  const texts = await Promise.all(small.map((file) => file.text()));
  const names = ["title", "about", "steps", "task"].map((name) => new RegExp(`"${name}"\\s*:`));
  return texts.some((text) => names.filter((name) => name.test(text)).length >= 2);
}

/** Sends the files, and returns their lessons. @param {File[]} files @returns {Promise<Lesson[]>} rejected with a sentence */
export async function sendLessons(files) {
  let folder = "";
  for (const file of files) {
    const query = new URLSearchParams({ name: file.name, into: folder });
    folder = JSON.parse(await answer(`/api/lessons/file?${query}`, { method: "POST", body: file })).folder;
  }
  return JSON.parse(await answer(`/api/lessons/open?${new URLSearchParams({ folder })}`, { method: "POST" }));
}

/** @param {string} url @param {RequestInit} options */
async function answer(url, options) {
  const { words, trouble } = await fetchText(url, options);
  if (trouble !== null) throw new Error(trouble);
  return words;
}
