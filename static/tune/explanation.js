// @ts-check
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { fillWords, pointAt } from "../widgets/words.js";
import { createVersus } from "../widgets/versus.js";
import { comparison } from "../stepping/comparison.js";
import { symbol } from "./symbol.js";

/** @typedef {import("../wire.js").Explanation} Explanation */
/** @typedef {import("../wire.js").Knob} Knob */

/**
 * The card that says why the selected point is in a line or not.
 * @param {typeof import("../text/page.js").pageText.explanation} text
 * @param {{project: (x: number, y: number) => [number, number] | null, onMove: (listener: () => void) => void}} stage
 *   project: position of a point on the stage [px]
 * @param {import("../widgets/words.js").Pointing} pointing
 * @param {{onClose: () => void, onChange: (name: string, value: number) => void}} handlers
 */
export function createExplanation(text, stage, pointing, { onClose, onChange }) {
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
  /** @type {import("../wire.js").Method[]} */
  let methods = [];
  /** Of the method. @type {Knob[]} */
  let knobs = [];
  stage.onMove(place);

  /** Whether the card would hide this point at its usual place. @param {number} left @param {number} top */
  function isUnder(left, top) {
    const holder = element.offsetParent;
    if (!holder) return false;
    const beside = Math.abs(left - holder.clientWidth / 2) > element.offsetWidth / 2;
    return !beside && top > holder.clientHeight - element.offsetHeight - 48;
  }

  /** Puts the card where it does not hide its point. It stays there until another point is explained. */
  function place() {
    const spot = shown?.at && !placed ? stage.project(...shown.at) : null;
    if (!spot) return;
    placed = true;
    element.classList.toggle("out-of-the-way", isUnder(...spot));
  }

  return {
    element,
    /** @param {import("../wire.js").Method[]} next */
    setMethods(next) {
      methods = next;
    },
    /** @param {import("../wire.js").State} state */
    setState({ explanation, method }) {
      knobs = (methods.find(({ name }) => name === method) ?? methods[0]).knobs;
      element.hidden = !explanation;
      if (explanation?.beam !== shown?.beam) placed = false;
      shown = explanation;
      if (!explanation) return;
      setText(beam, text.beam(explanation.beam));
      fillWords(sentence, explanation.words, pointing);
      versus.set(comparison(explanation, knobs));
      place();
    },
    /** Buttons for the changes that would give another answer. @param {import("../wire.js").WhatIf[]} found */
    setChanges(found) {
      const buttons = found.flatMap((change) => {
        const knob = knobs.find((each) => each.name === change.name);
        return knob && change.value !== null ? [changeButton(change, change.value, knob, { pointing, onChange })] : [];
      });
      changes.hidden = !found.length;
      changes.replaceChildren(h("span", { class: "muted" }, buttons.length ? text.changes : text.noChange), ...buttons);
    },
  };
}

/**
 * Sets the value that gives another answer; while it is pointed at, the line that the beam would be in is lit.
 * @param {import("../wire.js").WhatIf} change @param {number} value @param {Knob} knob
 * @param {{pointing: import("../widgets/words.js").Pointing, onChange: (name: string, value: number) => void}} handlers
 */
function changeButton({ name, segment, first, last, text }, value, knob, { pointing, onChange }) {
  const onclick = () => onChange(name, value);
  const props = { type: "button", class: "button what-if-change", onclick };
  const button = h("button", props, symbol(knob.symbol), withUnit(knob, value));
  tooltip(button, text);
  const beams = segment >= 0 ? /** @type {[number, number]} */ ([first, last]) : undefined;
  pointAt(button, { text: knob.symbol, threshold: name, beams }, pointing);
  return button;
}
