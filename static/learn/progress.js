// @ts-check
// What was answered in lessons: kept in this browser, saved as a small file, and read back on another computer.
import { keep, recall } from "../kept.js";

/** @typedef {{answer: string, right: boolean, when: string}} Answer when: UTC */
/** @typedef {{title: string, done: boolean, answers: Answer[]}} Of what was done in a lesson */
/** @typedef {typeof import("../text/learn.js").learnText.progress} Text */

const KEY = "lineseg.progress";
// Of ids alone, as it was kept before.
const FORMER_KEY = "lineseg.lessons";
const KIND = "progress in lessons";
const MOST_LESSONS = 300;
const MOST_ANSWERS = 50;
const LONGEST = 300;
const LARGEST = 10_000_000;

export class Progress {
  /** @type {Map<string, Of>} */ #of;

  constructor() {
    const former = list(parsed(recall(FORMER_KEY))).filter((id) => typeof id === "string");
    this.#of = new Map(former.map((id) => [id, { title: "", done: true, answers: [] }]));
    for (const [id, each] of entries(parsed(recall(KEY)))) this.#of.set(id, each);
  }

  /** @param {string} id of a lesson */
  isDone(id) {
    return this.#of.get(id)?.done ?? false;
  }

  /** How many lessons are done. */
  get done() {
    return [...this.#of.values()].filter(({ done }) => done).length;
  }

  /** Whether the browser keeps it. @param {{id: string, title: string}} lesson @param {string} answer @param {boolean} right */
  note({ id, title }, answer, right) {
    const before = this.#of.get(id) ?? { title, done: false, answers: [] };
    const said = { answer: answer.slice(0, LONGEST), right, when: new Date().toISOString() };
    const answers = [...before.answers, said].slice(-MOST_ANSWERS);
    this.#of.set(id, { title, done: before.done || right, answers });
    return this.#keep();
  }

  /** The text of a file. */
  file() {
    return `${JSON.stringify({ lineseg: KIND, saved: new Date().toISOString(), lessons: Object.fromEntries(this.#of) }, null, 1)}\n`;
  }

  /** Adds what a file says. @param {string} text @param {Text} words @returns {string} what came, or why nothing did */
  read(text, words) {
    const found = parsed(text);
    if (!isProgress(found)) return words.notOne;
    const read = entries(found.lessons);
    for (const [id, { title, done, answers }] of read) {
      const own = this.#of.get(id);
      const known = new Set(own?.answers.map(({ when, answer }) => when + answer));
      const all = [...(own?.answers ?? []), ...answers.filter(({ when, answer }) => !known.has(when + answer))];
      all.sort((one, other) => one.when.localeCompare(other.when));
      this.#of.set(id, {
        title: own?.title || title,
        done: done || (own?.done ?? false),
        answers: all.slice(-MOST_ANSWERS),
      });
    }
    const kept = this.#keep();
    return `${words.read(read.length, this.done)}${kept ? "" : ` ${words.full}`}`;
  }

  #keep() {
    const kept = keep(KEY, JSON.stringify(Object.fromEntries(this.#of)));
    if (kept) keep(FORMER_KEY, null);
    return kept;
  }
}

/** The text of the file of progress among these, if there is one. @param {File[]} files */
export async function progressIn(files) {
  const small = files.filter(({ name, size }) => /\.json$/i.test(name) && size <= LARGEST);
  const texts = await Promise.all(small.map((file) => file.text()));
  return texts.find((text) => isProgress(parsed(text)));
}

/** @param {any} found */
function isProgress(found) {
  return found?.lineseg === KIND && typeof found.lessons === "object" && found.lessons !== null;
}

/** What is well-formed of what was kept or read, by lesson. @param {any} found @returns {[string, Of][]} */
function entries(found) {
  if (typeof found !== "object" || found === null) return [];
  return Object.entries(found)
    .slice(0, MOST_LESSONS)
    .filter(([id, each]) => id.length <= LONGEST && typeof each === "object" && each !== null)
    .map(([id, each]) => [
      id,
      {
        title: words(each.title),
        done: each.done === true,
        answers: list(each.answers)
          .slice(-MOST_ANSWERS)
          .map((said) => ({ answer: words(said?.answer), right: said?.right === true, when: words(said?.when) })),
      },
    ]);
}

/** @param {unknown} value @returns {any[]} */
function list(value) {
  return Array.isArray(value) ? value : [];
}

/** @param {unknown} value */
function words(value) {
  return typeof value === "string" ? value.slice(0, LONGEST) : "";
}

/** @param {string | null} text @returns {any} null if it is not JSON */
function parsed(text) {
  try {
    return JSON.parse(text ?? "null");
  } catch {
    return null;
  }
}
