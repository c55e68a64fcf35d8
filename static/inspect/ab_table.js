// @ts-check
// What became of the lines of A in B, counted in the frame and in the recording.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @param {typeof import("../text/inspect.js").inspectText.ab} text */
export function createAbTable(text) {
  const fates = Object.entries(text.fates);
  const heads = fates.map(([, { label, help }]) => {
    const head = h("th", { scope: "col" }, label);
    tooltip(head, help);
    return head;
  });
  const cells = { frame: heads.map(() => h("td")), all: heads.map(() => h("td")) };
  const row = (/** @type {"frame" | "all"} */ of) => h("tr", {}, h("th", { scope: "row" }, text[of]), ...cells[of]);
  return {
    element: h(
      "table",
      { class: "ab-table" },
      h("thead", {}, h("tr", {}, h("td"), ...heads)),
      h("tbody", {}, row("frame"), row("all")),
    ),
    /** @param {"frame" | "all"} of @param {Record<string, number> | null | undefined} counts null: they are still to come */
    fill(of, counts) {
      for (const [k, [fate]] of fates.entries())
        setText(cells[of][k], counts ? counts[fate].toLocaleString("en") : text.pending);
    },
  };
}
