// @ts-check
// JSON from the server; if it cannot be loaded, the place that needs it says so and offers to try again.
import { fetchText } from "../fetch.js";
import { h } from "../widgets/dom.js";

/**
 * @template T
 * @param {HTMLElement} place stands empty unless something is wrong
 * @param {string} url
 * @param {{missing: string, again: string}} text missing: what is not there
 * @param {(json: T) => void} onCome
 */
export async function fetchInto(place, url, text, onCome) {
  place.replaceChildren();
  const { words, trouble } = await fetchText(url);
  if (trouble === null) return onCome(JSON.parse(words));
  const again = h(
    "button",
    { type: "button", class: "button", onclick: () => fetchInto(place, url, text, onCome) },
    text.again,
  );
  return place.replaceChildren(
    h("div", { class: "panel-error trouble-here", role: "alert" }, h("p", {}, `${text.missing} ${trouble}`), again),
  );
}
