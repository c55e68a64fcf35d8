// @ts-check
// All that looks wrong in the frame on the screen. One finding at a time can be drawn in the scene.
import { h } from "../widgets/dom.js";
import { fillWords, replaceNamed } from "../widgets/words.js";

/** @typedef {import("../wire.js").Finding} Finding */

/**
 * @param {typeof import("../text/inspect.js").inspectText.said} text
 * @param {import("../widgets/words.js").Pointing & {show: (finding: Finding | null) => void}} pointing
 */
export function createSaid(text, pointing) {
  const list = h("ul", { class: "said", "aria-label": text.label });
  const note = h("p", { class: "said-note muted" });
  const element = h("div", {}, note, list);
  let key = "";
  /** The finding that is drawn. */
  let chosen = -1;
  /** @type {Finding[]} */
  let shown = [];

  /** @param {number} next −1: none */
  function choose(next) {
    chosen = next;
    for (const [k, item] of [...list.children].entries()) item.classList.toggle("chosen", k === chosen);
    pointing.show(shown[chosen] ?? null);
  }

  /** @param {Finding} finding @param {number} k */
  function itemOf(finding, k) {
    const sentence = h("span", {});
    fillWords(sentence, finding.words, pointing);
    const item = h("li", { class: "said-finding", title: text.draw }, sentence);
    item.addEventListener("click", (event) => {
      event.stopPropagation();
      choose(chosen === k ? -1 : k);
    });
    return item;
  }

  return {
    element,
    /** @param {string} tags tags and note of the frame @param {Finding[] | undefined} found undefined: not known yet */
    set(tags, found) {
      const next = JSON.stringify([tags, found]);
      if (next === key) return;
      key = next;
      shown = found ?? [];
      note.hidden = !tags && shown.length > 0;
      note.textContent = [tags, found ? (shown.length ? "" : text.nothing) : text.pending].filter(Boolean).join(" · ");
      replaceNamed(list, shown.map(itemOf), pointing);
      choose(-1);
    },
  };
}
