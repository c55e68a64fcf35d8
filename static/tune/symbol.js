// @ts-check
import { h } from "../widgets/dom.js";

/** The paper's symbol with its index as a subscript: S_num. @param {string} name */
export function symbol(name) {
  const [base, index] = name.split("_");
  return h("span", { class: "symbol" }, h("i", {}, base), index ? h("sub", {}, index) : null);
}
