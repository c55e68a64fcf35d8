// @ts-check
// Texts of lessons: paragraphs, emphasis, links and pictures (app/shelf/lesson_markup.py). None of it is read as HTML.
import { h } from "../widgets/dom.js";
import { addressOfPicture } from "./picture.js";

/** @typedef {import("./glossary.js").Mark} Mark */
/** Of which lesson a text is, and what happens when a link to another lesson is chosen. @typedef {{id: string, onLesson: (id: string) => void}} Of */

const INLINE = /\*(\S(?:[^*\n]*\S)?)\*|\[([^\]\n]+)\]\(([^()\s]+)\)/u;
const PICTURE = /^!\[([^\]\n]+)\]\(([^()\s]+)\)$/u;
const OPENING = /[(“‘]+$/u;
const CLOSING = /^[.,:;!?)”’]+/u;
const WEB = /^https?:\/\//u;
const LESSON = "lesson:";

/** @param {string} words @param {Mark} mark @param {Of} of */
export function paragraphs(words, mark, of) {
  return words.split("\n\n").map((part) => {
    const picture = part.trim().match(PICTURE);
    return picture ? pictureOf(picture[2], picture[1], of.id) : h("p", {}, ...rich(part, mark, of));
  });
}

/** @param {string} name @param {string} words what it shows @param {string} id */
function pictureOf(name, words, id) {
  return h("figure", { class: "lesson-picture" }, h("img", { src: addressOfPicture(id, name), alt: words }));
}

/** One line of a text. @param {string} words @param {Mark} mark @param {Of} of @returns {(Node | string)[]} */
export function rich(words, mark, of) {
  // Between the plain parts stand what is emphasised, or the words and the target of a link.
  const parts = words.split(new RegExp(INLINE, "gu"));
  return unbroken(
    parts.flatMap((part, k) => {
      if (k % 4 === 0) return mark(part);
      if (k % 4 === 1 && part !== undefined) return [h("em", {}, ...unbroken(mark(part)))];
      return k % 4 === 2 && part !== undefined ? [linkOf(part, parts[k + 1], of)] : [];
    }),
  );
}

/** Keeps a button of a text on one line with the bracket before it and the full stop after it, as a word would be. @param {(Node | string)[]} parts */
function unbroken(parts) {
  /** @type {(Node | string)[]} */
  const kept = [];
  for (let k = 0; k < parts.length; k++) {
    const [part, next] = [parts[k], parts[k + 1]];
    if (!(part instanceof HTMLButtonElement)) {
      kept.push(part);
      continue;
    }
    const [before, after] = [kept.at(-1), next].map((each) => (typeof each === "string" ? each : ""));
    const opening = before.match(OPENING)?.[0] ?? "";
    const closing = after.match(CLOSING)?.[0] ?? "";
    if (opening) kept[kept.length - 1] = before.slice(0, -opening.length);
    if (closing) parts[k + 1] = after.slice(closing.length);
    kept.push(opening || closing ? h("span", { class: "unbroken" }, opening, part, closing) : part);
  }
  return kept;
}

/** @param {string} words @param {string} target @param {Of} of */
function linkOf(words, target, { onLesson }) {
  if (target.startsWith(LESSON)) {
    const go = () => onLesson(target.slice(LESSON.length));
    return h("button", { type: "button", class: "named", onclick: go }, words);
  }
  return WEB.test(target) ? h("a", { href: target, target: "_blank", rel: "noopener noreferrer" }, words) : words;
}
