// @ts-check
// A threshold that is on or off.
import { h } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { symbol } from "./symbol.js";

/** @typedef {import("../wire.js").Knob} Knob */

/**
 * A checkbox with the same methods as Threshold.
 * @param {Knob} knob
 * @param {typeof import("../text/page.js").pageText.tune} text
 * @param {(name: string, value: number) => void} onChange 1 for on, 0 for off
 */
export function createSwitch(knob, text, onChange) {
  const box = h("input", { type: "checkbox", "aria-description": knob.help });
  box.addEventListener("change", () => onChange(knob.name, Number(box.checked)));
  const label = h("span", { class: "threshold-label" }, knob.label);
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  const mark = h("span", { class: "switch-mark", hidden: true }, "◆");
  const row = h(
    "div",
    { class: "threshold threshold-switch", "data-knob": knob.name },
    h("label", {}, box, symbol(knob.symbol), label, mark),
    error,
  );
  tooltip(row, `${knob.help}\n${text.usually(knob.default === 1)}`, "left");

  return {
    element: row,
    knob,
    /** @param {number} value */
    set(value) {
      box.checked = value === 1;
      error.hidden = true;
      row.classList.toggle("changed", value !== knob.default);
    },
    /** @param {string} message */
    refuse(message) {
      error.textContent = message;
      error.hidden = false;
    },
    /** @param {{value: number | null, text: string} | undefined} change what turning it would change for the selected beam */
    setMark(change) {
      mark.hidden = change === undefined || change.value === null;
      mark.title = change?.text ?? "";
    },
    setHistogram() {},
    shrink() {},
    setFit() {},
  };
}
