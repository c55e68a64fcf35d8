// @ts-check
// Over the scene, once for each recording: what was guessed of it, what looks wrong, and the change that would mend it.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { changeWords } from "./reread_fields.js";

// The page of the truth says it.
const ELSEWHERE = "truth by many views";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Reading} Reading */

/**
 * @param {typeof import("../text/reading.js").readingText} text
 * @param {{entries: () => import("../wire.js").ReadingEntry[], onMend: (values: Reading) => void, onChange: () => void}} handlers onChange: opens the panel
 */
export function createNoticed(text, { entries, onMend, onChange }) {
  const list = h("ul", { class: "noticed-list" });
  const change = h("button", { type: "button", class: "button", onclick: onChange }, text.change);
  const close = iconButton("close", text.dismiss, () => (element.hidden = true));
  const line = h("p", { class: "muted noticed-line" });
  const element = h(
    "section",
    { class: "notice noticed", "aria-label": text.takenFor, hidden: true },
    h("div", { class: "notice-row" }, line, change, close),
    list,
  );
  let place = "";
  /** What was told of each recording. @type {Set<string>} */
  const told = new Set();

  /** @param {string} words @param {Reading} values */
  function entry(words, values) {
    const label = text.set(changeWords(entries(), values));
    const button = h("button", { type: "button", class: "button", onclick: () => onMend(values) }, label);
    return h("li", {}, h("span", {}, words), Object.keys(values).length ? button : null);
  }

  /** @param {State} state */
  function items({ account }) {
    if (!account) return [];
    const notices = account.notices
      .filter(({ kind }) => kind !== ELSEWHERE)
      .map(({ text: words, change: values }) => ({ words, values }));
    const guesses = account.guesses.map(({ field, value }) => text.guessedValue(field, value)).join(", ");
    const others = [guesses && text.guessed(guesses), account.skipped].filter(Boolean);
    return [...notices, ...others.map((words) => ({ words, values: {} }))];
  }

  return {
    element,
    /** @param {State} state */
    setState(state) {
      if (state.growing) element.hidden ||= state.place !== place;
      if (state.growing || state.place === place) return;
      place = state.place;
      const fresh = items(state).filter(({ words }) => !told.has(`${state.recording} ${words}`));
      for (const { words } of fresh) told.add(`${state.recording} ${words}`);
      element.hidden = fresh.length === 0;
      line.textContent = state.account?.line ?? "";
      list.replaceChildren(...fresh.map(({ words, values }) => entry(words, values)));
    },
  };
}
