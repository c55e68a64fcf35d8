// @ts-check
// Notices over the scene: empty and loading states, errors, the lost connection, the drop target.
import { h, setText } from "../widgets/dom.js";
import { icon, iconButton } from "../widgets/icon.js";

// A short load should not flash.
const LOADING_DELAY_MS = 150;
// Nor should a connection that is lost only briefly.
const LOST_DELAY_MS = 600;

/** @typedef {typeof import("../text/page.js").pageText.stage} Text */

/** Shown while there is no picture. @param {Text} text */
function createEmpty(text) {
  const [title, hint] = [h("p", { class: "empty-title" }, text.starting), h("p", { class: "hint" })];
  return {
    element: h("div", { class: "empty" }, title, hint),
    /** No recording is open, and none is being opened. */
    setEmpty() {
      setText(title, text.empty);
      setText(hint, text.emptyHint);
    },
  };
}

/** @param {Text} text @param {() => void} onCancel */
function createLoading(text, onCancel) {
  const label = h("span", { class: "notice-words" });
  const percent = h("span", { class: "muted percent" });
  const bar = h("progress", { class: "progress", max: 1, "aria-label": text.starting });
  const cancel = h("button", { type: "button", class: "button", onclick: onCancel }, text.cancel);
  const row = h("div", { class: "notice-row" }, label, percent, cancel);
  const element = h("div", { class: "notice loading", hidden: true }, row, bar);
  let timer = 0;

  /** @param {string} words @param {number} done @param {number} total 0 = not known @param {string} amount */
  function show(words, done, total, amount) {
    setText(label, words);
    setText(percent, amount);
    bar.setAttribute("aria-label", words);
    if (total > 0) bar.value = done / total;
    else bar.removeAttribute("value");
    if (element.hidden && !timer) timer = setTimeout(() => (element.hidden = false), LOADING_DELAY_MS);
  }

  return {
    element,
    /** @type {typeof show} Something long is under way. */
    show(...what) {
      setText(cancel, text.cancel);
      show(...what);
    },
    /** @param {import("../wire.js").Loading} message */
    setLoading({ label, done, total, note, behind }) {
      setText(cancel, behind ? text.stop : text.cancel);
      show(note || (behind ? text.readingOn : text.loading)(label), done, total, text.scans(done, total));
    },
    setLoaded() {
      clearTimeout(timer);
      timer = 0;
      element.hidden = true;
    },
  };
}

/** @param {Text} text */
function createError(text) {
  const words = h("span", { class: "notice-words" });
  const note = h("span", { class: "muted" });
  /** @type {() => void} */
  let goOn = () => {};
  const wayOn = h("button", { type: "button", class: "button", hidden: true, onclick: () => goOn() });
  const row = h("div", { class: "notice-row" }, icon("warning"), words, iconButton("close", text.dismiss, dismiss));
  const element = h("div", { class: "notice error", role: "alert", hidden: true }, row, note, wayOn);

  function dismiss() {
    element.hidden = true;
  }

  return {
    element,
    dismiss,
    /**
     * @param {string} message
     * @param {boolean} kept the old view stays
     * @param {{note: string, label: string, run: () => void}} [way] on, and what comes of it
     */
    setError(message, kept, way) {
      setText(words, message);
      setText(note, way?.note ?? (kept ? text.kept : ""));
      wayOn.hidden = !way;
      setText(wayOn, way?.label ?? "");
      goOn = way?.run ?? goOn;
      element.hidden = false;
    },
  };
}

/** @param {Text} text @param {() => void} onRetry */
function createLost(text, onRetry) {
  const retry = h("button", { type: "button", class: "button", onclick: onRetry }, text.retry);
  const words = h("span", { class: "notice-words" }, text.lost);
  const row = h("div", { class: "notice-row" }, icon("warning"), words, retry);
  const element = h("div", { class: "notice lost", role: "status", hidden: true }, row);
  let timer = 0;

  /** @param {boolean} is @param {string} reason */
  function set(is, reason) {
    element.hidden = !is;
    setText(words, reason || text.lost);
  }

  return {
    element,
    /** @param {import("../view/link.js").Connection} connection @param {string} reason */
    setConnection(connection, reason) {
      if (connection === "open") {
        clearTimeout(timer);
        timer = 0;
        set(false, "");
      } else if (connection === "lost" && !timer) {
        timer = setTimeout(() => set(true, reason), LOST_DELAY_MS);
      }
    },
  };
}

/**
 * When a notice goes, the next moves up under the pointer: the second click of a double click does not reach it.
 * @param {HTMLElement} notices
 */
function ignoreSecondClicks(notices) {
  /** @type {Element | null} */
  let first = null;
  notices.addEventListener(
    "click",
    (event) => {
      const hit = /** @type {Element} */ (event.target).closest("button");
      if (event.detail < 2) first = hit;
      else if (hit !== first) event.stopPropagation();
    },
    true,
  );
}

/**
 * @param {HTMLElement} stage
 * @param {Text} text
 * @param {{onCancel: () => void, onRetry: () => void}} handlers
 */
export function mountNotices(stage, text, { onCancel, onRetry }) {
  const empty = createEmpty(text);
  const loading = createLoading(text, onCancel);
  const error = createError(text);
  const lost = createLost(text, onRetry);
  const drop = h(
    "div",
    { class: "drop", hidden: true },
    h("p", { class: "empty-title" }, text.drop),
    h("p", { class: "hint" }, text.dropHint),
  );
  const notices = h("div", { class: "notices" }, lost.element, error.element, loading.element);
  ignoreSecondClicks(notices);
  stage.append(empty.element, notices, drop);
  /** The place of the last drawn state. @type {string | null} */
  let shown = null;

  return {
    dismiss: error.dismiss,
    show: loading.show,
    setEmpty: empty.setEmpty,
    setLoading: loading.setLoading,
    setLoaded: loading.setLoaded,
    setError: error.setError,
    setConnection: lost.setConnection,
    /** @param {import("../wire.js").State} state */
    setState({ place }) {
      empty.element.hidden = true;
      if (shown && place !== shown) error.dismiss();
      shown = place;
    },
    /** Another notice, below the others. @param {HTMLElement} notice */
    add: (notice) => notices.append(notice),
    /** @param {boolean} over */
    setDropping(over) {
      drop.hidden = !over;
    },
  };
}
