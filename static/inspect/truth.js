// @ts-check
// The numbers of the paper's Table 4 and more, of the frame and of the recording.
import { keyOf } from "../view/key.js";
import { fetchText } from "../fetch.js";
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Agreement} Agreement */

const REST_MS = 300;
const PARTS = /** @type {const} */ (["recording", "method", "params", "judgedBy", "labelled"]);

/** What the numbers of the recording belong to. @param {State} state */
function keyOfAll(state) {
  return keyOf({ ...state, labelled: state.judgedBy === "labels" ? state.labels?.stamp : "" }, ...PARTS);
}

/**
 * @param {typeof import("../text/inspect.js").inspectText.truth} text
 * @param {{session: () => string, onShow: (shown: boolean) => void, onReference: (reference: "labels" | "wall") => void}} handlers
 */
export function createTruth(text, { session, onShow, onReference }) {
  const show = h("input", { type: "checkbox", onchange: () => onShow(show.checked) });
  const key = (/** @type {string} */ name, /** @type {string} */ label) =>
    h("span", { class: "verdict-key" }, h("span", { class: `verdict ${name}` }), label);
  const all = h("th", { scope: "col" }, text.all);
  const rows = text.rows.map(([name, label, help, kind]) => {
    const head = h("th", { scope: "row" }, label);
    tooltip(head, help, "left");
    const cells = [h("td"), h("td")];
    return { name, kind, cells, element: h("tr", {}, head, ...cells) };
  });
  const by = h("select", {
    class: "select",
    "aria-label": text.judgedBy,
    onchange: () => onReference(/** @type {"labels" | "wall"} */ (by.value)),
  });
  const unlabelled = h("p", { class: "hint" }, text.unlabelled);
  const explained = h("p", { class: "hint" });
  const known = h(
    "div",
    {},
    h("label", { class: "truth-by" }, text.judgedBy, by),
    unlabelled,
    h("label", { class: "truth-show" }, show, text.show),
    h(
      "p",
      { class: "verdict-keys muted" },
      key("matched", text.matched),
      key("false", text.false),
      key("missed", text.missed),
    ),
    h(
      "table",
      { class: "table truth-table" },
      h("thead", {}, h("tr", {}, h("td"), h("th", { scope: "col" }, text.frame), all)),
      h("tbody", {}, ...rows.map(({ element }) => element)),
    ),
    explained,
  );
  const unknown = h("p", { class: "hint" }, text.unknown);
  const element = h("div", { class: "truth", "aria-label": text.label }, known, unknown);
  let asked = "";
  let waiting = 0;
  new MutationObserver(askSoon).observe(element, { attributeFilter: ["hidden"] });

  /** @param {number} column @param {Agreement | null} agreement */
  function fill(column, agreement) {
    for (const { name, kind, cells } of rows) {
      const value = agreement?.[name];
      setText(
        cells[column],
        agreement === null
          ? text.pending
          : value === null || value === undefined
            ? "–"
            : kind === "count"
              ? value.toLocaleString("en")
              : text[kind](value),
      );
    }
  }

  /** @type {State | null} */
  let state = null;
  function askSoon() {
    if (!state?.judgedBy || state.mode !== "inspect" || element.hidden) return;
    const key = keyOfAll(state);
    if (key === asked) return;
    asked = key;
    fill(1, null);
    clearTimeout(waiting);
    waiting = setTimeout(ask, REST_MS);
  }

  async function ask() {
    const { words, trouble } = await fetchText(`/api/truth?${new URLSearchParams({ session: session() })}`);
    if (trouble) return;
    const answer = JSON.parse(words);
    // It may belong to what was on the screen a moment ago; then the next answer is on its way, or is asked for again.
    if (keyOf(answer, ...PARTS) !== asked)
      return void (asked === (state && keyOfAll(state)) && (waiting = setTimeout(ask, REST_MS)));
    setText(
      all,
      answer.stride > 1 ? text.sampled(answer.stride) : answer.judgedBy === "labels" ? text.labelled : text.all,
    );
    fill(1, answer.agreement);
  }

  return {
    element,
    /** @param {State} next */
    setState(next) {
      state = next;
      show.checked = next.layers.verdicts;
      const { judgedBy, references } = next;
      known.hidden = judgedBy === "";
      unknown.hidden = judgedBy !== "";
      by.replaceChildren(...references.map((name) => h("option", { value: name }, text.references[name])));
      by.value = judgedBy;
      by.disabled = references.length < 2;
      unlabelled.hidden = judgedBy !== "labels" || next.agreement !== null;
      if (judgedBy) setText(explained, `${text.matching} ${text.explained[judgedBy]}`);
      fill(0, next.agreement ?? {});
      askSoon();
    },
  };
}
