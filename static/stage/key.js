// @ts-check
// What the marks of a decision mean. On a low stage only its title is there until it is opened.
import { h } from "../widgets/dom.js";

/** @typedef {typeof import("../text/page.js").pageText.stage.key} Text */

const TALL_PX = 420;

/** @param {HTMLElement} holder the stage @param {Text} text */
export function createKey(holder, text) {
  const list = h("ul");
  const element = h("details", { class: "scene-key", hidden: true }, h("summary", {}, text.label), list);
  // Whoever opens or closes it decides for the rest.
  let chosen = false;
  element.firstElementChild?.addEventListener("click", () => (chosen = true));
  return {
    element,
    /** @param {import("../wire.js").State} state */
    setState({ framing, nodes }) {
      const marks = framing ? Object.keys(text.marks).filter((name) => nodes.includes(name)) : [];
      element.hidden = !marks.length;
      if (element.hidden) return;
      if (!chosen) element.open = holder.clientHeight >= TALL_PX;
      list.replaceChildren(
        ...marks.map((name) =>
          h("li", {}, h("i", { class: `mark mark-${name}`, "aria-hidden": "true" }), text.marks[name]),
        ),
      );
    },
  };
}
