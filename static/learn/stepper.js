// @ts-check
// The dock of mode Learn: the sentence of the present decision, and every way to another one.
import { Player } from "../widgets/player.js";
import { h, sentenceCase, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { tooltip } from "../widgets/tooltip.js";
import { createVersus } from "../widgets/versus.js";
import { createMarks } from "./marks.js";
import { JUMPS } from "./trace.js";
import { symbolOf } from "./values.js";

/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./trace.js").Jump} Jump */
/** @typedef {import("./trace.js").Level} Level */

const SPEEDS = [1, 2, 5, 10, 20, 40];
const USUAL_SPEED = 2;
const LEVELS = /** @type {Level[]} */ (["decision", "phase", "line"]);
const LEAST = new Set(["min_points", "min_length"]);

/**
 * @param {HTMLElement} dock
 * @param {typeof import("../text/learn.js").learnText} words
 * @param {{onStep: (step: number | null) => void, onBeam: (beam: number) => void, onZoom: () => void,
 *          settled: () => boolean, mayStep: (next: number) => boolean, extras: HTMLElement[], answers: HTMLElement}} handlers
 *   mayStep: asked before a step forward by one; false holds it back
 */
export function mountStepper(dock, words, { onStep, onBeam, onZoom, settled, mayStep, extras, answers }) {
  const text = words.steps;
  /** @type {number | null} */
  let step = null;
  /** @type {Trace | null} */
  let trace = null;
  let lines = 0;
  /** @type {Level} */
  let level = "decision";
  /** @type {{from: number, to: number | null} | null} */
  let loop = null;
  /** @type {string | null} what is said instead of the decision */
  let instead = null;

  const phase = h("span", { class: "phase" });
  const sentence = h("p", { class: "decision" });
  const versus = createVersus();
  const leave = iconButton("close", text.leave, () => go(null));
  const said = h("div", { class: "replay-said" }, phase, sentence, h("span", {}, answers), versus.element, leave);
  sentence.setAttribute("aria-live", "polite");
  sentence.setAttribute("aria-atomic", "true");

  const player = new Player(USUAL_SPEED, {
    ready: settled,
    atEnd: () => (loop?.to === null || loop === null ? last() <= (step ?? -1) : false),
    rewind: () => go(0),
    next: () => move(1, true),
    onState(playing) {
      play.show(playing ? "pause" : "play", playing ? text.pause : text.play);
      // Nobody can listen to several sentences a second; the last one is read when playing ends.
      sentence.setAttribute("aria-live", playing ? "off" : "polite");
    },
  });
  const play = iconButton("play", text.play, () => togglePlay());
  const speed = h(
    "select",
    { class: "select", "aria-label": text.speed, onchange: () => player.setSpeed(Number(speed.value)) },
    ...SPEEDS.map((n) => h("option", { value: String(n), selected: n === USUAL_SPEED }, text.perSecond(n))),
  );
  tooltip(speed, text.speed);
  const levels = h(
    "select",
    { class: "select", "aria-label": text.level, onchange: () => (level = /** @type {Level} */ (levels.value)) },
    ...LEVELS.map((name) => h("option", { value: name }, text.levels[name])),
  );
  tooltip(levels, text.level);
  const jumpButtons = JUMPS.map((name) => {
    const button = h(
      "button",
      { type: "button", class: "button", "data-jump": name, onclick: () => jump(name) },
      text.jumps[name],
    );
    tooltip(button, () => text.jumpTo(button.textContent ?? "", trace?.marks[name].length ?? 0));
    return button;
  });
  const jumps = h(
    "span",
    { class: "jumps", role: "group", "aria-label": text.jump },
    h("span", { class: "muted" }, text.jump),
    ...jumpButtons,
  );
  const looping = iconButton("loop", text.loopStart, toggleLoop);
  const numberField = createNumberField({
    label: text.number,
    className: "frame-number",
    accept(typed) {
      const wanted = Number(typed);
      if (!Number.isInteger(wanted) || wanted < 1 || wanted > length()) return text.range(length());
      go(wanted - 1);
      return null;
    },
  });
  const beamField = createNumberField({
    label: text.beam,
    className: "frame-number beam-number",
    repeats: true,
    accept(typed) {
      const wanted = Number(typed);
      const most = (trace?.beams ?? 0) - 1;
      if (!Number.isInteger(wanted) || wanted < 0 || wanted > most) return text.noBeam(most);
      beamField.set(String(wanted));
      onBeam(wanted);
      return null;
    },
  });
  tooltip(beamField.element, text.beamHint);
  const beamPlace = h(
    "span",
    { class: "counter" },
    h("span", { class: "of" }, text.beam),
    beamField.element,
    beamField.error,
  );
  const total = h("span", { class: "of" });
  const marks = createMarks();
  const slider = createSlider({
    label: text.scrubber,
    onPlace: (place) => (player.stop(), go(Math.round(place * Math.max(0, last())))),
    onSteps: (by) => move(by),
    fill: false,
  });
  const buttons = [
    iconButton("first", text.first, () => move(-Infinity)),
    iconButton("back", text.back, () => move(-1)),
    play,
    iconButton("forward", text.forward, () => move(1)),
    iconButton("last", text.last, () => move(Infinity)),
  ];
  const controls = h(
    "div",
    { class: "replay-controls stepper-controls" },
    ...buttons,
    levels,
    speed,
    looping,
    iconButton("zoom", text.zoom, onZoom),
    beamPlace,
    h("span", { class: "spacer" }),
    jumps,
  );
  const scrubber = h(
    "div",
    { class: "stepper-scrubber" },
    h("div", { class: "track" }, marks.element, slider.element),
    h("span", { class: "counter" }, numberField.element, total, numberField.error),
  );
  const more = h("div", { class: "stepper-more" }, ...extras);
  dock.setAttribute("aria-label", text.label);
  dock.append(said, controls, scrubber, more);

  function length() {
    return trace?.length ?? 0;
  }
  function last() {
    return length() - 1;
  }

  /** @param {number | null} next */
  function go(next) {
    if (next === null) player.stop();
    const wanted = next === null || !length() ? null : clamp(next, 0, last());
    if (wanted === step) return;
    step = wanted;
    instead = null;
    show();
    onStep(step);
  }

  /** @param {number} by ±Infinity: to the ends @param {boolean} [playing] a hand stops the clock */
  function move(by, playing = false) {
    if (!playing) player.stop();
    if (!trace || !length()) return;
    if (step === null) return go(by > 0 ? 0 : last());
    let next = trace.moved(step, by, level);
    if (loop && loop.to !== null && playing && (next > loop.to || next < loop.from)) next = loop.from;
    if (next === step + 1 && !mayStep(next)) return player.stop();
    return go(next);
  }

  /** @param {Jump} name */
  function jump(name) {
    player.stop();
    const from = step ?? -1;
    const next = trace?.marks[name].find((index) => index > from);
    if (next !== undefined) go(next);
  }

  function togglePlay() {
    if (length() < 2) return;
    if (!player.playing && loop && loop.to !== null) go(loop.from);
    player.toggle();
  }

  function toggleLoop() {
    if (loop?.to !== undefined && loop.to !== null) loop = null;
    else if (loop) loop = order(loop.from, step ?? loop.from);
    else loop = { from: step ?? 0, to: null };
    const label = !loop ? text.loopStart : loop.to === null ? text.loopEnd : text.loopClear;
    looping.show("loop", label);
    looping.setAttribute("aria-pressed", String(Boolean(loop)));
    marks.setLoop(loop);
  }

  function show() {
    const event = step !== null && trace && step < trace.length ? trace.at(step) : null;
    setText(phase, event ? (words.phases[event.phase] ?? sentenceCase(event.phase)) : words.phases.whole);
    phase.dataset.phase = event?.phase ?? "";
    setText(sentence, instead ?? event?.text ?? idle());
    leave.disabled = step === null;
    const plain = event && ["lines merged", "lines kept apart", "overlap cut", "endpoints"].includes(event.kind);
    const check = event?.kind === "line kept" ? "min_length" : (event?.check ?? "");
    const shown = event && !plain && !instead && symbolOf(check);
    const unit = check === "min_points" || check === "max_dropout" ? "" : "m";
    const { value = null, limit = null } = event ?? {};
    versus.set(
      shown ? { value, limit, symbol: symbolOf(check).replace("_", " "), unit, least: LEAST.has(check) } : null,
    );
    numberField.set(step === null ? "–" : String(step + 1));
    setText(total, text.of(length()));
    numberField.element.style.width = `${String(length()).length + 2}ch`;
    slider.set(
      step !== null && length() > 1 ? step / last() : 0,
      step === null ? words.phases.whole : `${step + 1} ${text.of(length())}`,
    );
    for (const button of jumpButtons) {
      const name = /** @type {Jump} */ (button.dataset.jump);
      button.disabled = (trace?.marks[name].at(-1) ?? -1) <= (step ?? -1);
    }
  }

  function idle() {
    if (!trace) return words.waiting;
    if (!trace.length) return words.nothing;
    if (trace.columns.total > trace.length) return words.truncated(trace.length, trace.columns.total);
    return words.whole(lines, trace.length);
  }

  return {
    toggle: () => go(step === null ? 0 : null),
    togglePlay,
    leave: () => go(null),
    move: (/** @type {number} */ by) => move(by),
    go,
    jump,
    stop: () => player.stop(),
    /** @param {import("../wire.js").Method} method */
    setMethod({ begins }) {
      setText(jumpButtons[JUMPS.indexOf("seed")], begins);
    },
    /** @param {Trace | null} next */
    setTrace(next) {
      trace = next;
      if (loop) {
        loop = { from: 0, to: 0 };
        toggleLoop();
      }
      marks.set(trace);
      for (const [k, name] of JUMPS.entries()) jumpButtons[k].hidden = !trace?.columns.jumps[name];
      show();
    },
    /** @param {number | null} next step of the View */
    setStep(next) {
      if (next === null) player.stop();
      if (next !== step) instead = null;
      step = next;
      show();
    },
    /** @param {number} count lines of the whole result */
    setLines(count) {
      lines = count;
      show();
    },
    /** Says something else than the decision until the next step; null: the decision again. @param {string | null} what */
    say(what) {
      instead = what;
      show();
    },
  };
}

/** @param {number} one @param {number} other */
function order(one, other) {
  return { from: Math.min(one, other), to: Math.max(one, other) };
}
