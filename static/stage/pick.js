// @ts-check
// Asks why about a place of the plan: the beam whose point is nearest is selected.
import { fetchText } from "../fetch.js";

/** @param {import("../page.js").Page} page */
export function createPick(page) {
  /** @param {[number, number]} at @param {number} radius [m] @param {boolean} beside compare with the selected beam */
  return async ([x, y], radius, beside) => {
    const query = { session: page.sessionId(), x: String(x), y: String(y), radius: String(radius) };
    const { words, trouble } = await fetchText(`/api/beam?${new URLSearchParams(query)}`);
    if (trouble) return;
    const { beam } = /** @type {import("../wire.js").Near} */ (JSON.parse(words));
    if (!beside || page.view.selected === null) page.change({ selected: beam });
    else if (beam !== null) page.change({ beside: beam });
  };
}
