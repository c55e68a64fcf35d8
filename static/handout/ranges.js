// @ts-check
// The thresholds that can be dragged, one at a time.
import { Threshold } from "../tune/threshold.js";
import { h } from "../widgets/dom.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("./stands.js").Place} Place */

/**
 * @param {typeof import("../text/handout.js").handoutText} text
 * @param {typeof import("../text/page.js").pageText.tune} words
 * @param {(params: import("../wire.js").Params) => void} onChange
 */
export function createRanges(text, words, onChange) {
  const holder = h("div", { class: "thresholds" });
  const element = h(
    "details",
    { class: "handout-ranges" },
    h("summary", {}, text.ranges),
    h("p", { class: "hint" }, text.rangesHint),
    holder,
  );
  /** @type {import("../wire.js").Stand | null} */
  let made = null;
  /** @type {Threshold[]} */
  let rows = [];

  return {
    element,
    /** @param {Place} place @param {Knob[]} knobs of its method */
    set({ stand, params }, knobs) {
      if (stand !== made) {
        made = stand;
        // A reset leads back to the thresholds whose decisions are stored.
        const ranged = knobs.filter(({ name }) => stand.ranges[name]);
        rows = ranged.map(
          (knob) =>
            new Threshold({ ...knob, default: stand.params[knob.name] }, words, (name, value) =>
              onChange({ [name]: value }),
            ),
        );
        for (const row of rows) row.setHistogram(undefined);
        holder.replaceChildren(...rows.map((row) => row.element));
        element.hidden = rows.length === 0;
      }
      for (const row of rows) row.set(params[row.knob.name]);
    },
  };
}
