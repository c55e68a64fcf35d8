// @ts-check
// How much each score counts in the suspicion.
import { h, setText } from "../widgets/dom.js";
import { fieldOf } from "../view/fields.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Score} Score */

const { most: MOST } = fieldOf("weights");
const STEP = 0.5;
const NO_PART = new Set(["suspicion", "difference"]);

/**
 * @param {typeof import("../text/inspect.js").inspectText.weights} text
 * @param {(weights: Record<string, number>) => void} onWeights
 */
export function createWeights(text, onWeights) {
  const rows = h("div", { class: "weights" });
  const reset = h("button", { type: "button", class: "button" }, text.reset);
  const element = h(
    "details",
    { class: "weights-holder" },
    h("summary", {}, text.title),
    h("p", { class: "hint" }, text.help),
    rows,
    reset,
  );
  /** @type {Map<string, {input: HTMLInputElement, shown: HTMLElement}>} */
  const inputs = new Map();
  /** @type {Score[]} */
  let scores = [];
  reset.addEventListener("click", () =>
    onWeights(Object.fromEntries(scores.map(({ name, weight }) => [name, weight]))),
  );

  return {
    element,
    /** @param {Score[]} next */
    setScores(next) {
      const parts = next.filter(({ name }) => !NO_PART.has(name));
      scores = [...parts.filter(({ weight }) => weight), ...parts.filter(({ weight }) => !weight)];
      inputs.clear();
      rows.replaceChildren(
        ...scores.map(({ name, label, help, weight }) => {
          const input = h("input", {
            type: "range",
            class: "range",
            min: "0",
            max: String(MOST),
            step: String(STEP),
            value: String(weight),
          });
          const shown = h("span", { class: "weight-value" }, String(weight));
          input.addEventListener(
            "input",
            () => (setText(shown, input.value), onWeights({ [name]: Number(input.value) })),
          );
          inputs.set(name, { input, shown });
          const row = h("label", { class: "weight" }, h("span", {}, label), input, shown);
          tooltip(row, help, "left");
          return row;
        }),
      );
    },
    /** @param {import("../wire.js").State} state */
    setState({ weights }) {
      for (const [name, { input, shown }] of inputs) {
        const value = String(weights[name] ?? 0);
        if (document.activeElement !== input) input.value = value;
        setText(shown, value);
      }
      reset.disabled = scores.every(({ name, weight }) => weights[name] === weight);
    },
  };
}
