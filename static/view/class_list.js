// @ts-check
// The teacher's list of a class: who is where. It is asked for again and again while it is open.
import { fetchText } from "../fetch.js";
import { openDialog } from "../widgets/dialog.js";
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("../wire.js").PupilPlace} PupilPlace */
/** @typedef {typeof import("../text/page.js").pageText.follow.list} Text */

const EVERY_MS = 2000;

/** @param {Text} text @param {() => string} session */
export function openClass(text, session) {
  const rows = h("tbody");
  const says = h("p", { class: "hint", role: "status" });
  const head = h("thead", {}, h("tr", {}, ...text.head.map((words) => h("th", {}, words))));
  const table = h("table", { class: "table class-list" }, head, rows);
  const dialog = openDialog(text.title, text.close, table, says, h("p", { class: "hint" }, text.hint));
  let timer = 0;
  async function ask() {
    const { words, trouble } = await fetchText(`/api/class?${new URLSearchParams({ session: session() })}`);
    if (!dialog.isConnected) return;
    if (trouble === null) {
      /** @type {PupilPlace[]} */
      const pupils = JSON.parse(words);
      rows.replaceChildren(...pupils.map((pupil) => rowOf(pupil, text)));
      table.hidden = !pupils.length;
      setText(says, pupils.length ? "" : text.nobody);
    } else setText(says, trouble);
    timer = setTimeout(ask, EVERY_MS);
  }
  dialog.addEventListener("close", () => clearTimeout(timer));
  ask();
}

/** @param {PupilPlace} pupil @param {Text} text */
function rowOf({ name, follows, lesson, page, pages, recording, frame, done }, text) {
  const cells = [lesson || text.elsewhere(recording, frame), text.page(page, pages), String(done)];
  return h(
    "tr",
    {},
    h("th", { scope: "row", class: name ? "" : "muted" }, name || text.nameless),
    ...cells.map((words) => h("td", {}, words)),
    h("td", { class: "muted" }, follows ? text.follows : text.alone),
  );
}
