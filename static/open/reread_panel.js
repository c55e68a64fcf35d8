// @ts-check
// The panel "Read as": the fields of the Reading beside the first scans as it would have them.
import { h, setText } from "../widgets/dom.js";
import { openDialog } from "../widgets/dialog.js";
import { createPlan, Looks } from "./look.js";
import { changeWords, createFields } from "./reread_fields.js";

/** @typedef {import("../wire.js").Previewed} Previewed */
/** @typedef {import("../wire.js").Reading} Reading */
/** @typedef {import("../wire.js").ReadingEntry} Entry */
/** @typedef {import("./reread_fields.js").Values} Values */
/** @typedef {typeof import("../text/reading.js").readingText} Text */
/** What to read: a recording, how it is read so far, and the fields to begin with. @typedef {{recording: string, label: string, topic: string | null, reading: Values, named: string[]}} Subject */

// A field that is typed in is not tried after each key.
const REST_MS = 150;
const BUSY_MS = 250;

/** What was found, why the file cannot be read, and the changes that are offered. @param {Text} text @param {Entry[]} entries @param {(change: Reading) => void} onChange */
function createFindings(text, entries, onChange) {
  const line = h("p", { class: "reread-line" });
  const error = h("p", { class: "panel-error", role: "alert", hidden: true });
  const head = h("pre", { class: "reread-head", "aria-label": text.firstLines });
  const list = h("ul", { class: "reread-findings" });

  /** @param {string} words @param {Reading} change */
  function entry(words, change) {
    const run = () => onChange(change);
    const button = h(
      "button",
      { type: "button", class: "button", onclick: run },
      text.set(changeWords(entries, change)),
    );
    return h("li", {}, h("span", {}, words), Object.keys(change).length ? button : null);
  }

  return {
    elements: [line, error, head, list],
    /** @param {Previewed} seen */
    show({ message, account, whole, lines }) {
      setText(head, lines.join("\n"));
      head.hidden = lines.length === 0;
      setText(error, message ?? "");
      error.hidden = message === null;
      setText(line, account?.line ?? "");
      const guesses = (account?.guesses ?? []).map(({ field, value, why, change }) =>
        entry(text.guess(text.guessedValue(field, value), why), change),
      );
      const notices = (account?.notices ?? []).map(({ text: words, change }) => entry(words, change));
      const notes = [account?.skipped, whole ? "" : text.beginning].filter(Boolean);
      list.replaceChildren(...notices, ...guesses, ...notes.map((words) => entry(String(words), {})));
    },
  };
}

/**
 * Opens the panel.
 * @param {Entry[]} entries
 * @param {Text} text
 * @param {Subject} subject
 * @param {(values: Values) => void} onTake
 */
export function openPanel(entries, text, { recording, label, topic, reading, named }, onTake) {
  /** @type {Previewed | null} */
  let seen = null;
  let [rest, busy] = [0, 0];
  const plan = createPlan();
  const caption = h("p", { class: "muted reread-caption", role: "status" }, text.reading);
  const looks = new Looks(show);
  const fields = createFields(entries, text, trySoon);
  const findings = createFindings(text, entries, (change) => (fields.set(change), tryNow()));
  const apply = h("button", { type: "button", class: "button primary", onclick: take }, text.apply);
  const cancel = h("button", { type: "button", class: "button", onclick: () => dialog.close() }, text.cancel);
  const usual = h("button", { type: "button", class: "button", title: text.usualHelp, onclick: reset }, text.usual);
  const look = h("div", { class: "reread-look" }, plan.element, caption, ...findings.elements);
  const dialog = openDialog(
    text.title(label),
    text.close,
    h("div", { class: "reread" }, fields.element, look),
    h("div", { class: "dialog-buttons" }, usual, h("span", { class: "spacer" }), cancel, apply),
  );
  dialog.classList.add("wide");
  dialog.addEventListener("close", () => (looks.close(), clearTimeout(rest), clearTimeout(busy)));
  fields.element.addEventListener("keydown", ({ key }) => key === "Enter" && !apply.disabled && take());
  fields.set({ ...reading, topic });
  tryNow();

  function trySoon() {
    clearTimeout(rest);
    rest = setTimeout(tryNow, REST_MS);
  }

  function tryNow() {
    clearTimeout(rest);
    clearTimeout(busy);
    busy = setTimeout(() => setText(caption, text.reading), BUSY_MS);
    looks.ask(recording, fields.values);
  }

  /** @param {Previewed} now */
  function show(now) {
    clearTimeout(busy);
    const first = seen === null;
    seen = now;
    // What the first sentence asked for stays marked while it is being tried.
    const marked = [...new Set([...named, ...now.named])];
    fields.show({ ...now, named: marked });
    findings.show(now);
    const count = now.scans.length;
    const words = now.scans.some(({ length }) => length) ? text.points(count) : text.noPoints;
    setText(caption, now.message === null ? words : "");
    plan.element.hidden = caption.hidden = now.message !== null;
    if (now.message === null) plan.draw(now.scans, now.account?.line ?? "");
    apply.disabled = now.message !== null;
    if (first && marked.length) fields.focus(marked);
  }

  function reset() {
    fields.set(Object.fromEntries(entries.map(({ name }) => [name, null])));
    tryNow();
  }

  function take() {
    const values = fields.values;
    dialog.close();
    onTake(values);
  }
}
