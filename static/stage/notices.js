// @ts-check
// What lies over the scene: empty and loading states, errors, the lost connection, the drop target.
import { h, setText } from "../widgets/dom.js";
import { icon, iconButton } from "../widgets/icon.js";

// A load that is over at once should not flash.
const LOADING_DELAY_MS = 150;

/**
 * @param {HTMLElement} stage
 * @param {typeof import("../text/en.js").text.stage} text
 * @param {{onCancel: () => void, onRetry: () => void}} handlers
 */
export function mountNotices(stage, text, { onCancel, onRetry }) {
  const empty = h(
    "div",
    { class: "empty" },
    h("p", { class: "empty-title" }, text.starting),
    h("p", { class: "hint" }),
  );
  const [emptyTitle, emptyHint] = empty.children;

  const label = h("span", { class: "notice-words" });
  const percent = h("span", { class: "muted percent" });
  const bar = h("progress", { class: "progress", max: 1, "aria-label": text.starting });
  const cancel = h("button", { type: "button", class: "button", onclick: onCancel }, text.cancel);
  const loading = h(
    "div",
    { class: "notice loading", hidden: true },
    h("div", { class: "notice-row" }, label, percent, cancel),
    bar,
  );

  const errorWords = h("span", { class: "notice-words" });
  const errorNote = h("span", { class: "muted" });
  /** @type {() => void} */
  let goOn = () => {};
  const wayOn = h("button", { type: "button", class: "button", hidden: true, onclick: () => goOn() });
  const error = h(
    "div",
    { class: "notice error", role: "alert", hidden: true },
    h(
      "div",
      { class: "notice-row" },
      icon("warning"),
      errorWords,
      iconButton("close", text.dismiss, () => dismiss()),
    ),
    errorNote,
    wayOn,
  );
  const retry = h("button", { type: "button", class: "button", onclick: onRetry }, text.retry);
  const lostWords = h("span", { class: "notice-words" }, text.lost);
  const lost = h(
    "div",
    { class: "notice lost", role: "status", hidden: true },
    h("div", { class: "notice-row" }, icon("warning"), lostWords, retry),
  );
  const drop = h(
    "div",
    { class: "drop", hidden: true },
    h("p", { class: "empty-title" }, text.drop),
    h("p", { class: "hint" }, text.dropHint),
  );
  stage.append(empty, h("div", { class: "notices" }, lost, error, loading), drop);

  let timer = 0;
  function dismiss() {
    error.hidden = true;
  }

  return {
    dismiss,
    /** @param {boolean} something there is a picture */
    setDrawn(something) {
      empty.hidden = something;
    },
    /** No recording is open, and none is being opened. */
    setEmpty() {
      setText(emptyTitle, text.empty);
      setText(emptyHint, text.emptyHint);
    },
    /** @param {string} words @param {number} done @param {number} total 0 = not known @param {string} amount */
    setLoading(words, done, total, amount) {
      setText(label, words);
      setText(percent, amount);
      bar.setAttribute("aria-label", words);
      if (total > 0) bar.value = done / total;
      else bar.removeAttribute("value");
      if (loading.hidden && !timer) timer = setTimeout(() => (loading.hidden = false), LOADING_DELAY_MS);
    },
    setLoaded() {
      clearTimeout(timer);
      timer = 0;
      loading.hidden = true;
    },
    /**
     * @param {string} message
     * @param {boolean} kept the old view stays
     * @param {{note: string, label: string, run: () => void}} [way] on, and what comes of it
     */
    setError(message, kept, way) {
      setText(errorWords, message);
      setText(errorNote, way?.note ?? (kept ? text.kept : ""));
      wayOn.hidden = !way;
      setText(wayOn, way?.label ?? "");
      goOn = way?.run ?? goOn;
      error.hidden = false;
    },
    /** @param {boolean} is @param {string} reason */
    setLost(is, reason) {
      lost.hidden = !is;
      setText(lostWords, reason || text.lost);
    },
    /** @param {boolean} over */
    setDropping(over) {
      drop.hidden = !over;
    },
  };
}
