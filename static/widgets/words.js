// @ts-check
// A sentence whose words can be pointed at: beams, segments, lines, thresholds.
import { symbol } from "../tune/symbol.js";
import { h } from "./dom.js";

/** @typedef {import("../wire.js").Words} Words */
/** @typedef {import("../wire.js").Link} Link */
/** What happens when a word is pointed at (null: no more), and when it is chosen. @typedef {{at: (named: Link | null) => void, go: (named: Link) => void}} Pointing */

/** The sentence as text. @param {string | Words} words */
export function plain(words) {
  if (typeof words === "string") return words;
  return words.map((part) => (typeof part === "string" ? part : part.text)).join("");
}

/** @param {HTMLElement} element @param {Words} words @param {Pointing} pointing */
export function fillWords(element, words, pointing) {
  const key = JSON.stringify(words);
  if (element.dataset.words === key) return;
  element.dataset.words = key;
  replaceNamed(element, unbroken(words, pointing), pointing);
}

/** The parts of a sentence; a comma or a full stop never begins a line after a word that can be pointed at. @param {Words} words @param {Pointing} pointing */
function unbroken(words, pointing) {
  /** @type {(Node | string)[]} */
  const parts = [];
  for (const part of words) {
    const [stop] = (typeof part === "string" && part.match(/^[,.;:)]+/)) || [""];
    const word = stop && parts.at(-1);
    if (word instanceof HTMLElement) parts.splice(-1, 1, h("span", { class: "unbroken" }, word, stop));
    parts.push(
      typeof part === "string" ? (word instanceof HTMLElement ? part.slice(stop.length) : part) : link(part, pointing),
    );
  }
  return parts;
}

/** Replaces what an element holds, some of which may be pointed at: what is removed never tells that the pointer has left it. @param {HTMLElement} element @param {(Node | string)[]} parts @param {Pick<Pointing, "at">} pointing */
export function replaceNamed(element, parts, { at }) {
  if (element.matches(":hover, :focus-within")) at(null);
  element.replaceChildren(...parts);
}

/** @param {Link} named @param {Pointing} pointing */
function link(named, { at, go }) {
  const shown = named.threshold ? symbol(named.text) : named.text;
  const word = h("button", { type: "button", class: "named" }, shown);
  word.addEventListener("click", (event) => (event.stopPropagation(), go(named)));
  pointAt(word, named, { at });
  return word;
}

/** Lights in the scene what an element speaks of while it is pointed at. @param {HTMLElement} element @param {Link} named @param {Pick<Pointing, "at">} pointing */
export function pointAt(element, named, { at }) {
  for (const kind of ["pointerenter", "focus"]) element.addEventListener(kind, () => at(named));
  for (const kind of ["pointerleave", "blur"]) element.addEventListener(kind, () => at(null));
}
