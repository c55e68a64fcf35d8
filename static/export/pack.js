// @ts-check
// Where the frame of a failure pack came from, and its note.
import { isIn } from "../view/key.js";
import { h, setText } from "../widgets/dom.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Pack} Pack */

/**
 * @param {import("../page.js").Page} page
 * @param {typeof import("../text/export.js").exportText.card} text
 */
export function createPackCard(page, text) {
  const from = h("span", { class: "muted pack-from" });
  const note = h("p", { class: "pack-note" });
  const button = h("button", { type: "button", class: "button", onclick: () => pack && take(pack) }, text.take);
  tooltip(button, text.takeHelp);
  const element = h(
    "section",
    { class: "pack", "aria-label": text.label, hidden: true },
    h("div", { class: "pack-head" }, h("b", {}, text.label), from),
    note,
    button,
  );
  /** @type {Pack | null} */
  let pack = null;

  /** Shows where the frame of a failure pack came from. @param {Pack} pack */
  function take({ method, params }) {
    if (page.looksAt(method, params)) return;
    page.change({ method, params });
    toast(text.taken);
  }

  return {
    element,
    take,
    /** @param {State} state */
    setState(state) {
      pack = state.pack;
      element.hidden = !pack;
      if (!pack) return;
      const { recording, frame, method, params } = pack;
      setText(from, text.from(recording, frame));
      from.title = from.textContent ?? "";
      setText(note, pack.note || text.noNote);
      note.classList.toggle("muted", !pack.note);
      button.hidden = method === state.method && isIn(params, state.params);
    },
  };
}
