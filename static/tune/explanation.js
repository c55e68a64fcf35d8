// @ts-check
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { createVersus } from "../widgets/versus.js";
import { comparison } from "./comparison.js";
import { symbol } from "./sliders.js";

/** @typedef {import("../wire.js").Explanation} Explanation */
/** @typedef {import("../wire.js").Knob} Knob */

/**
 * The card that says why the selected point is, or is not, in a line.
 * @param {typeof import("../text/en.js").text.explanation} text
 * @param {{onClose: () => void, onChange: (name: string, value: number) => void}} handlers
 */
export function createExplanation(text, { onClose, onChange }) {
  const beam = h("span", { class: "phase" });
  const sentence = h("p", { class: "decision" });
  const versus = createVersus();
  const changes = h("div", { class: "what-if", hidden: true });
  const close = iconButton("close", text.close, onClose);
  const element = h(
    "section",
    { class: "explanation", "aria-label": text.label, "aria-live": "polite", hidden: true },
    beam,
    sentence,
    versus.element,
    close,
    changes,
  );

  /** @type {Explanation | null} */
  let shown = null;
  let placed = false;

  /** Whether the card, at its usual place, would hide what is there. @param {number} left @param {number} top */
  function isUnder(left, top) {
    const stage = element.offsetParent;
    if (!stage) return false;
    const beside = Math.abs(left - stage.clientWidth / 2) > element.offsetWidth / 2;
    return !beside && top > stage.clientHeight - element.offsetHeight - 48;
  }

  return {
    element,
    /** @param {Explanation | null} explanation @param {Knob[]} knobs */
    set(explanation, knobs) {
      element.hidden = !explanation;
      if (explanation?.beam !== shown?.beam) placed = false;
      shown = explanation;
      if (!explanation) return;
      setText(beam, text.beam(explanation.beam));
      setText(sentence, explanation.text);
      versus.set(comparison(explanation, knobs));
    },
    /**
     * Puts the card where it does not hide its point; where it is, it stays until another point is explained.
     * @param {(x: number, y: number) => [number, number] | null} project where a point is on the stage [px]
     */
    place(project) {
      const spot = shown?.at && !placed ? project(...shown.at) : null;
      if (!spot) return;
      placed = true;
      element.classList.toggle("out-of-the-way", isUnder(...spot));
    },
    /** What would change the answer, as buttons that do it. @param {import("../wire.js").WhatIf[]} found @param {Knob[]} knobs */
    setChanges(found, knobs) {
      const buttons = found.flatMap(({ name, value, text: why }) => {
        const knob = knobs.find((each) => each.name === name);
        if (!knob || value === null) return [];
        const button = h(
          "button",
          { type: "button", class: "button what-if-change", onclick: () => onChange(name, value) },
          symbol(knob.symbol),
          withUnit(knob, value),
        );
        tooltip(button, why);
        return [button];
      });
      changes.hidden = !found.length;
      changes.replaceChildren(h("span", { class: "muted" }, buttons.length ? text.changes : text.noChange), ...buttons);
    },
  };
}
