// @ts-check
// The replay of one frame, decision by decision.
import { Player } from "../widgets/player.js";
import { h, sentenceCase, setText } from "../widgets/dom.js";
import { icon, iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { tooltip } from "../widgets/tooltip.js";
import { createVersus } from "../widgets/versus.js";
import { comparison } from "./comparison.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Marks} Marks */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Method} Method */

const SPEEDS = [1, 2, 5, 10, 20, 40];
const USUAL_SPEED = 5;

/**
 * @param {HTMLElement} dock
 * @param {typeof import("../text/page.js").pageText} words
 * @param {{onStep: (step: number | null) => void, settled: () => boolean}} handlers
 */
export function mountReplay(dock, words, { onStep, settled }) {
  const text = words.replay;
  /** @type {number | null} */
  let step = null;
  let steps = 0;
  /** @type {Marks} */
  let marks = {};
  /** @type {Knob[]} */
  let knobs = [];

  const enter = h(
    "button",
    { type: "button", class: "button replay-enter", onclick: () => go(0) },
    icon("play"),
    text.enter,
  );
  const count = h("span", { class: "muted" });
  const idle = h("div", { class: "replay-idle" }, enter, count);

  const phase = h("span", { class: "phase" });
  const sentence = h("p", { class: "decision" });
  const versus = createVersus();
  const leave = iconButton("close", text.leave, () => go(null));
  const said = h("div", { class: "replay-said", "aria-live": "polite" }, phase, sentence, versus.element, leave);

  const player = new Player(USUAL_SPEED, {
    ready: settled,
    atEnd: () => step === null || step >= steps - 1,
    rewind: () => go(0),
    next: () => move(1, true),
    onState: (playing) => play.show(playing ? "pause" : "play", playing ? text.pause : text.play),
  });
  const play = iconButton("play", text.play, () => player.toggle());
  const speed = h(
    "select",
    { class: "select", "aria-label": text.speed, onchange: () => player.setSpeed(Number(speed.value)) },
    ...SPEEDS.map((n) => h("option", { value: String(n), selected: n === USUAL_SPEED }, text.perSecond(n))),
  );
  tooltip(speed, text.speed);
  const jumps = h(
    "span",
    { class: "jumps" },
    jumpButton(text.next("seed"), "seed"),
    jumpButton(text.nextLine, "line"),
    jumpButton(text.nextDrop, "drop"),
  );
  const number = createNumberField({
    label: text.scrubber,
    className: "frame-number",
    accept(typed) {
      const wanted = Number(typed);
      if (!Number.isInteger(wanted) || wanted < 1 || wanted > steps) return words.timeline.stepRange(steps);
      go(wanted - 1);
      return null;
    },
  });
  const total = h("span", { class: "of" });
  const slider = createSlider({
    label: text.scrubber,
    onPlace: (place) => go(Math.round(place * Math.max(0, steps - 1))),
    onSteps: (by) => move(by),
  });
  const controls = h(
    "div",
    { class: "replay-controls" },
    iconButton("first", text.first, () => move(-Infinity)),
    iconButton("back", text.back, () => move(-1)),
    play,
    iconButton("forward", text.forward, () => move(1)),
    iconButton("last", text.last, () => move(Infinity)),
    speed,
    jumps,
    h("div", { class: "track" }, slider.element),
    h("span", { class: "counter" }, number.element, total, number.error),
  );
  const active = h("div", { class: "replay-active", hidden: true }, said, controls);
  dock.setAttribute("aria-label", text.label);
  dock.append(idle, active);

  /** @param {string} label @param {string} mark */
  function jumpButton(label, mark) {
    return h("button", { type: "button", class: "button", "data-jump": mark, onclick: () => jump(mark) }, label);
  }

  /** @param {number | null} next */
  function go(next) {
    const wanted = next === null ? null : clamp(next, 0, Math.max(0, steps - 1));
    if (wanted === null) player.stop();
    if (wanted === step) return;
    step = wanted;
    show();
    onStep(step);
  }

  /** @param {number} by ±Infinity: to the ends @param {boolean} [playing] a hand stops the clock */
  function move(by, playing = false) {
    if (!playing) player.stop();
    if (step !== null) go(step + by);
  }

  /** @param {string} mark */
  function jump(mark) {
    player.stop();
    const from = step;
    const next = from === null ? undefined : (marks[mark] ?? []).find((index) => index > from);
    if (next !== undefined) go(next);
  }

  function show() {
    const on = step !== null;
    idle.hidden = on;
    active.hidden = !on;
    if (step === null) return;
    number.set(String(step + 1));
    slider.set(steps > 1 ? step / (steps - 1) : 0, `${step + 1} ${text.of(steps)}`);
    for (const button of jumps.querySelectorAll("button")) {
      const last = marks[button.dataset.jump ?? ""]?.at(-1) ?? -1;
      button.disabled = last <= step;
    }
  }

  return {
    toggle: () => go(step === null ? 0 : null),
    togglePlay: () => steps > 1 && player.toggle(),
    leave: () => go(null),
    move: (/** @type {number} */ by) => move(by),
    jump,
    /** @param {Method} method */
    setMethod(method) {
      knobs = method.knobs;
      setText(/** @type {Element} */ (jumps.firstElementChild), text.next(method.begins));
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView(view) {
      const next = view.mode === "learn" ? null : view.step;
      if (next === null) player.stop();
      step = next;
      show();
    },
    /** @param {State} state */
    setState(state) {
      steps = state.steps;
      marks = state.marks ?? marks;
      enter.disabled = steps === 0;
      setText(count, steps ? text.decisions(steps) : text.none);
      setText(total, text.of(steps));
      number.element.style.width = `${String(steps).length + 2}ch`;
      const { decision } = state;
      setText(phase, decision ? (text.phases[decision.phase] ?? sentenceCase(decision.phase)) : "");
      phase.dataset.phase = decision?.phase ?? "";
      setText(sentence, decision?.text ?? "");
      versus.set(decision ? comparison(decision, knobs) : null);
      show();
    },
  };
}
