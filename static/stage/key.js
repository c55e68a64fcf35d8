// @ts-check
// What the marks of a decision mean.
import { h } from "../widgets/dom.js";

/** @typedef {typeof import("../text/page.js").pageText.stage.key} Text */

/** @param {Text} text */
export function createKey(text) {
  const element = h("ul", { class: "scene-key", "aria-label": text.label, hidden: true });
  return {
    element,
    /** @param {import("../wire.js").State} state */
    setState({ framing, nodes }) {
      const marks = framing ? Object.keys(text.marks).filter((name) => nodes.includes(name)) : [];
      element.hidden = !marks.length;
      element.replaceChildren(
        ...marks.map((name) =>
          h("li", {}, h("i", { class: `mark mark-${name}`, "aria-hidden": "true" }), text.marks[name]),
        ),
      );
    },
  };
}
