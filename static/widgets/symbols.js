// @ts-check
import { h } from "./dom.js";

const SYMBOL = /((?<!\w)[A-Za-zαγ]′?_[a-z0-9]+|\b[ijkdn]\b(?!')|[εδρθκ]′?|\bP′)/u;

/**
 * Text with the symbols of the paper in italics and their indices as subscripts: P_min, S_num, ε, ρ′.
 * @param {string} words
 * @returns {(Node | string)[]}
 */
export function symbols(words) {
  return words.split(new RegExp(SYMBOL, "gu")).map((part, k) => (k % 2 ? symbol(part) : part));
}

/** @param {string} name */
function symbol(name) {
  const [base, index] = name.split("_");
  return h("span", { class: "math-symbol" }, h("i", {}, base), index ? h("sub", {}, index) : null);
}
