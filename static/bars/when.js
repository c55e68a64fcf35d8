// @ts-check
// When the scan on the screen was taken, or why that is not known.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {typeof import("../text/page.js").pageText.timeline.when} Text */

// From 2000 to 2100 [s since 1970].
const CENTURY = [946_684_800, 4_102_444_800];

/** @param {Text} text */
export function createWhen(text) {
  const since = h("span", { class: "when-since" });
  const clock = h("span", { class: "when-clock muted" });
  const element = h("span", { class: "when" }, since, clock);
  let help = "";
  tooltip(element, () => help);

  return {
    element,
    /** @param {import("../wire.js").State} state @param {string} why times are not known, in a few words @param {number} perSecond frames, if they are not */
    show({ since: time, stamp, frames }, why, perSecond) {
      const date = time === null ? "" : dateOf(stamp);
      const said = frames > 1 ? why : "";
      setText(since, time === null ? said : `${time.toFixed(3)} s`);
      setText(clock, time === null ? said && text.steady(perSecond) : date);
      element.classList.toggle("unknown", time === null);
      help = time === null ? said && text.unknown(said) : [text.since, date && text.date].filter(Boolean).join(" ");
    },
  };
}

/** The date and time of a stamp of this century, "" for others. @param {number | null} stamp */
function dateOf(stamp) {
  if (stamp === null || stamp < CENTURY[0] || stamp >= CENTURY[1]) return "";
  return new Date(1000 * stamp)
    .toISOString()
    .replace("T", " ")
    .replace(/\.\d+Z$/, " UTC");
}
