// @ts-check
// Where labels are saved, whether they are saved, and why not.
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("./keep.js").Status} Status */

/**
 * @param {typeof import("../text/label.js").labelText.status} text
 * @param {{onRetry: () => void, onMine: () => void}} handlers
 */
export function createStatus(text, { onRetry, onMine }) {
  const words = h("span");
  const retry = h("button", { type: "button", class: "button", onclick: onRetry, hidden: true }, text.retry);
  const element = h("div", { class: "labels-status", role: "status" }, words, retry);
  const why = h("span");
  const mine = h("button", { type: "button", class: "button", onclick: onMine }, text.mine);
  const trouble = h("div", { class: "labels-status trouble", role: "alert", hidden: true }, why, mine);

  /** @param {Status} status @param {string} message @param {string} place @param {boolean} something */
  function wordsOf(status, message, place, something) {
    if (status === "saving") return text.saving;
    if (status === "away") return text.away;
    if (status === "refused") return text.refused(message);
    return something ? text.saved(place) : text.nothing(place);
  }

  return {
    element,
    /** Shown above everything: why nothing can be saved, or what was not saved. */
    trouble,
    /**
     * @param {{status: Status, message: string, conflict: number | null}} kept @param {import("../wire.js").Labels | null} labels
     * @param {boolean} something is said of the frame
     */
    set({ status, message, conflict }, labels, something) {
      const wrong =
        labels === null
          ? text.live
          : labels.trouble
            ? text.trouble(labels.trouble)
            : conflict !== null
              ? text.conflict(conflict)
              : "";
      trouble.hidden = !wrong;
      setText(why, wrong);
      mine.hidden = conflict === null || !labels || Boolean(labels.trouble);
      element.hidden = labels === null || Boolean(labels.trouble);
      const place = labels?.apart ? text.apart(labels.file) : (labels?.file ?? "");
      setText(words, wordsOf(status, message, place, something));
      words.title = labels ? `${labels.folder}/${labels.file}` : "";
      retry.hidden = status !== "refused" && status !== "away";
      element.classList.toggle("trouble", status === "refused" || status === "away");
      element.dataset.status = status;
    },
  };
}
