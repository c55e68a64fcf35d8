// @ts-check
// A, the pinned result, beside B, the current one.
import { keyOf } from "../view/key.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { format, withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { createAbTable } from "./ab_table.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Survey} Survey */
/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").Against} Against */

const PARTS = /** @type {const} */ (["place", "method", "params", "against"]);

/**
 * The button that pins, and the card that tells how the two differ.
 * @param {typeof import("../text/inspect.js").inspectText.ab} text
 * @param {{onToggle: () => void, onSwap: () => void, onAdopt: () => void, onNext: () => void}} handlers
 */
export function createAb(text, { onToggle, onSwap, onAdopt, onNext }) {
  const button = h(
    "button",
    { type: "button", class: "button quiet", "aria-pressed": "false", onclick: onToggle },
    text.label,
  );
  tooltip(button, text.pinHelp);
  const what = h("span", { class: "ab-what" });
  const table = createAbTable(text);
  const action = (/** @type {string} */ label, /** @type {string} */ help, /** @type {() => void} */ run) => {
    const made = h("button", { type: "button", class: "button", onclick: run }, label);
    tooltip(made, help);
    return made;
  };
  const next = action(text.next, text.nextHelp, onNext);
  const element = h(
    "section",
    { class: "ab", "aria-label": text.label, hidden: true },
    h("div", { class: "ab-head" }, h("b", {}, text.a), what, iconButton("close", text.unpin, onToggle)),
    table.element,
    h(
      "p",
      { class: "ab-keys muted" },
      h("span", { class: "ab-key" }),
      text.keys.same,
      h("span", { class: "ab-key changed" }),
      text.keys.changed,
    ),
    h(
      "div",
      { class: "ab-actions" },
      next,
      action(text.swap, text.swapHelp, onSwap),
      action(text.adopt, text.adoptHelp, onAdopt),
    ),
  );
  /** @type {Against | null} */
  let against = null;
  /** @type {State | null} */
  let drawn = null;
  /** @type {Method[]} */
  let methods = [];
  /** Key of the totals. */
  let counted = "";

  return {
    button,
    element,
    /** @param {Method[]} next */
    setMethods(next) {
      methods = next;
    },
    /** @param {State} state */
    setState(state) {
      drawn = state;
      against = state.against;
      button.setAttribute("aria-pressed", String(against !== null));
      element.hidden = against === null;
      if (!against) return;
      setText(what, words(against, state, methods, text));
      table.fill("frame", state.difference);
      if (counted !== keyOf(state, ...PARTS)) table.fill("all", null);
    },
    /** @param {Survey} survey */
    setSurvey(survey) {
      if (!survey.totals || !against || !drawn) return;
      counted = keyOf({ ...drawn, params: survey.params }, ...PARTS);
      table.fill("all", survey.totals);
    },
  };
}

/**
 * How A differs from B: "ε 0.030 m, P_min 10", and its method if it differs.
 * @param {Against} against @param {State} state @param {Method[]} methods @param {typeof import("../text/inspect.js").inspectText.ab} text
 */
function words(against, state, methods, text) {
  const method = methods.find(({ name }) => name === against.method);
  const other = against.method !== state.method;
  const differing = (method?.knobs ?? []).filter(
    ({ name, default: usual }) => against.params[name] !== (other ? usual : state.params[name]),
  );
  const said = differing.map(
    (knob) =>
      `${knob.symbol} ${knob.unit ? withUnit(knob, against.params[knob.name]) : format(knob, against.params[knob.name])}`,
  );
  return [...(other && method ? [method.label] : []), ...said].join(", ") || text.same;
}
