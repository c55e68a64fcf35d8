// @ts-check
// Where the frame of a failure pack came from, and what was said of it.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Pack} Pack */

/**
 * @param {typeof import("../text/export.js").exportText.card} text
 * @param {(pack: Pack) => void} onTake
 */
export function createPackCard(text, onTake) {
  const from = h("span", { class: "muted pack-from" });
  const note = h("p", { class: "pack-note" });
  const take = h("button", { type: "button", class: "button", onclick: () => pack && onTake(pack) }, text.take);
  tooltip(take, text.takeHelp);
  const element = h(
    "section",
    { class: "pack", "aria-label": text.label, hidden: true },
    h("div", { class: "pack-head" }, h("b", {}, text.label), from),
    note,
    take,
  );
  /** @type {Pack | null} */
  let pack = null;
  return {
    element,
    /** @param {State} state */
    setState(state) {
      pack = state.pack;
      element.hidden = !pack;
      if (!pack) return;
      const { recording, frame, method, params } = pack;
      setText(from, text.from(recording, frame + 1));
      from.title = from.textContent ?? "";
      setText(note, pack.note || text.noNote);
      note.classList.toggle("muted", !pack.note);
      take.hidden =
        method === state.method && Object.entries(params).every(([name, value]) => state.params[name] === value);
    },
  };
}
