// @ts-check
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { fillWords, plain, pointAt, replaceNamed } from "../widgets/words.js";
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
 * @param {{onClose: () => void, onChange: (values: import("../wire.js").Params) => void}} handlers
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
  /** @type {import("../wire.js").Method[]} */
  let methods = [];
  /** Of the method. @type {Knob[]} */
  let knobs = [];
  const stand = createStand(element, stage);

  /** @param {Offer[]} offers @param {string} words before them */
  function offer(offers, words) {
    const buttons = offers.map((each) => changeButton(each, knobs, pointing, onChange));
    replaceNamed(changes, [h("span", { class: "muted" }, words), ...buttons], pointing);
  }

  /** Shows the offers or not. @param {boolean} known */
  function showChanges(known) {
    changes.hidden = !known;
    stand.grown();
  }

  return {
    element,
    /** @param {import("../wire.js").Method[]} next */
    setMethods(next) {
      methods = next;
    },
    /** @param {import("../wire.js").State} state */
    setState({ explanation, method, view }) {
      knobs = (methods.find(({ name }) => name === method) ?? methods[0]).knobs;
      element.hidden = !explanation;
      stand.about(explanation?.at ?? null, explanation?.beam !== shown?.beam);
      shown = explanation;
      if (!explanation) return;
      const beside = view.beside ?? null;
      setText(beam, beside === null ? text.beam(explanation.beam) : text.pair(explanation.beam, beside));
      if (beside === null) fillWords(sentence, explanation.words, pointing);
      versus.set(beside === null ? comparison(explanation, knobs) : null);
      versus.element.hidden = beside !== null;
      stand.place();
    },
    /** Buttons for the changes that would give another answer. @param {import("../wire.js").WhatIf[]} found */
    setChanges(found) {
      const offers = offersOf(found);
      offer(offers, offers.length ? text.changes : text.noChange);
      showChanges(found.length > 0);
    },
    /** Why both selected beams are in one line, or in two. @param {import("../wire.js").Apart | null} apart null: not known yet, or not asked */
    setApart(apart) {
      if (!apart && !versus.element.hidden) return;
      fillWords(sentence, apart?.words ?? [text.pending], pointing);
      const kind = apart?.together ? "part" : "join";
      if (apart) offer(apart.changes.map(offerOf), apart.changes.length ? text[kind] : text.nothing[kind]);
      showChanges(apart !== null);
    },
  };
}

/**
 * Where a card stands so that it does not hide its point. It stays there until it is about another point, and never
 * moves from under the pointer.
 * @param {HTMLElement} card @param {Parameters<typeof createExplanation>[1]} stage
 */
function createStand(card, stage) {
  /** @type {[number, number] | null} */
  let point = null;
  let placed = false;
  const spot = () => (point && !card.matches(":hover") ? stage.project(...point) : null);

  function place() {
    const at = placed ? null : spot();
    if (!at) return;
    placed = true;
    card.classList.toggle("out-of-the-way", isUnder(card, ...at));
  }
  stage.onMove(place);

  return {
    place,
    /** @param {[number, number] | null} next of the plan @param {boolean} other whether it is another point */
    about(next, other) {
      point = next;
      if (other) placed = false;
    },
    /** The card has grown, and may lie over its point now. */
    grown() {
      const at = spot();
      if (at && isUnder(card, ...at)) card.classList.add("out-of-the-way");
    },
  };
}

/** Whether a card would hide this point at its usual place. @param {HTMLElement} card @param {number} left @param {number} top */
function isUnder(card, left, top) {
  const holder = card.offsetParent;
  if (!holder) return false;
  const beside = Math.abs(left - holder.clientWidth / 2) > card.offsetWidth / 2;
  return !beside && top > holder.clientHeight - card.offsetHeight - 48;
}

/** Values that give another answer; beams: the line that there would be. @typedef {{values: import("../wire.js").Params, tip: string, beams?: [number, number]}} Offer */

/** @param {import("../wire.js").WhatIf[]} found @returns {Offer[]} */
function offersOf(found) {
  return found.flatMap(({ name, value, segment, first, last, text: tip }) =>
    value === null ? [] : [{ values: { [name]: value }, tip, beams: segment >= 0 ? [first, last] : undefined }],
  );
}

/** @param {import("../wire.js").Otherwise} change @returns {Offer} */
function offerOf({ values, words, first, last }) {
  return { values, tip: plain(words), beams: first >= 0 ? [first, last] : undefined };
}

/**
 * Sets these values; while it is pointed at, the line that there would be is lit.
 * @param {Offer} offer @param {Knob[]} knobs @param {import("../widgets/words.js").Pointing} pointing
 * @param {(values: import("../wire.js").Params) => void} onChange
 */
function changeButton({ values, tip, beams }, knobs, pointing, onChange) {
  const parts = Object.entries(values).flatMap(([name, value]) => {
    const knob = knobs.find((each) => each.name === name);
    return knob ? [symbol(knob.symbol), h("span", {}, withUnit(knob, value))] : [];
  });
  const onclick = () => onChange(values);
  const button = h("button", { type: "button", class: "button what-if-change", onclick }, ...parts);
  tooltip(button, tip);
  pointAt(button, { text: tip, threshold: Object.keys(values)[0], beams }, pointing);
  return button;
}
