// @ts-check
// The dock of mode Learn: the sentence of the current decision, and all ways to move to another.
import { Decision } from "../stepping/decision.js";
import { comparison } from "../stepping/comparison.js";
import { Steps } from "../stepping/steps.js";
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { tooltip } from "../widgets/tooltip.js";
import { createBeamField } from "./beam_field.js";
import { Loop } from "./loop.js";
import { createMarks } from "./marks.js";
import { JUMPS } from "./trace.js";

/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./trace.js").Jump} Jump */
/** @typedef {import("./trace.js").Level} Level */

const USUAL_SPEED = 2;
const LEVELS = /** @type {Level[]} */ (["decision", "phase", "line"]);

/**
 * @typedef {object} Handlers
 * @property {(step: number | null) => void} onStep
 * @property {(beam: number) => void} onBeam
 * @property {import("./glossary.js").Mark} mark for the sentence of the decision
 * @property {() => void} onCloseUp
 * @property {() => boolean} settled
 * @property {(next: number) => boolean} mayStep asked before one step forward; false makes it wait
 * @property {HTMLElement} answers beside the sentence
 * @property {HTMLElement[]} extras below everything
 */

export class Stepper {
  #words;
  #steps;
  #decision;
  /** @type {Trace | null} */ #trace = null;
  #lines = 0;
  /** @type {Level} */ #level = "decision";
  #loop = new Loop();
  #looping;
  #closeUp;
  #marks = createMarks();
  #mayStep;
  /** @type {import("../wire.js").Knob[]} */ #knobs = [];
  /** What is said instead of the decision. @type {string | null} */ #instead = null;

  /**
   * @param {HTMLElement} dock
   * @param {typeof import("../text/learn.js").learnText} words
   * @param {Handlers} handlers
   */
  constructor(dock, words, { onStep, onBeam, mark, onCloseUp, settled, mayStep, extras, answers }) {
    this.#words = words;
    this.#mayStep = mayStep;
    const text = words.steps;
    this.#decision = new Decision(text.leave, () => this.go(null), h("span", {}, answers));
    this.#decision.explainWith(mark);
    this.#steps = new Steps(
      {
        speed: text.speed,
        usualSpeed: USUAL_SPEED,
        kinds: JUMPS.map((name) => [name, text.jumps[name]]),
        backdrop: this.#marks.element,
      },
      {
        settled,
        onStep: (step) => {
          this.say(null);
          onStep(step);
        },
        onPlaying: (playing) => this.#decision.hush(playing),
        moved: (from, by, playing) => this.#moved(from, by, playing),
        loopStart: () => this.#loop.start,
      },
    );
    this.#closeUp = iconButton("zoom", text.closeUp, onCloseUp);
    this.#looping = iconButton("loop", text.loopStart, () => this.#toggleLoop());
    const { buttons, speed, scrubber } = this.#steps;
    const controls = h(
      "div",
      { class: "replay-controls stepper-controls" },
      ...buttons,
      this.#createLevels(),
      speed,
      this.#looping,
      this.#closeUp,
      createBeamField(text, { beams: () => this.#trace?.beams ?? 0, onBeam }),
      h("span", { class: "spacer" }),
      this.#dressJumps(),
    );
    dock.setAttribute("aria-label", text.label);
    dock.append(
      this.#decision.element,
      controls,
      h("div", { class: "stepper-scrubber" }, scrubber.track, scrubber.counter),
      h("div", { class: "stepper-more" }, ...extras),
    );
  }

  #createLevels() {
    const text = this.#words.steps;
    const select = h(
      "select",
      {
        class: "select",
        "aria-label": text.level,
        onchange: () => (this.#level = /** @type {Level} */ (select.value)),
      },
      ...LEVELS.map((name) => h("option", { value: name }, text.levels[name])),
    );
    tooltip(select, text.level);
    return select;
  }

  #dressJumps() {
    const text = this.#words.steps;
    const { jumps } = this.#steps;
    for (const [name, button] of jumps.buttons)
      tooltip(button, () =>
        text.jumpTo(button.textContent ?? "", this.#trace?.marks[/** @type {Jump} */ (name)].length ?? 0),
      );
    jumps.element.setAttribute("role", "group");
    jumps.element.setAttribute("aria-label", text.jump);
    jumps.element.prepend(h("span", { class: "muted" }, text.jump));
    return jumps.element;
  }

  /** @param {number} from @param {number} by @param {boolean} playing */
  #moved(from, by, playing) {
    if (!this.#trace) return null;
    const next = this.#trace.moved(from, by, this.#level);
    const there = playing ? this.#loop.inside(next) : next;
    return there === from + 1 && !this.#mayStep(there) ? null : there;
  }

  #toggleLoop() {
    this.#loop.toggle(this.#steps.at);
    this.#showLoop();
  }

  #showLoop() {
    const { loopStart, loopEnd, loopClear } = this.#words.steps;
    const { range } = this.#loop;
    this.#looping.show("loop", !range ? loopStart : range.to === null ? loopEnd : loopClear);
    this.#looping.setAttribute("aria-pressed", String(range !== null));
    this.#marks.setLoop(range);
  }

  #show() {
    const { at } = this.#steps;
    const event = at !== null && this.#trace && at < this.#trace.length ? this.#trace.at(at) : null;
    const sentence = this.#instead ?? event?.text ?? this.#idle();
    this.#decision.leave.disabled = at === null;
    this.#decision.set(
      event?.phase ?? "whole",
      sentence,
      event && !this.#instead ? comparison(event, this.#knobs) : null,
    );
  }

  /** The sentence about the whole result. */
  #idle() {
    if (!this.#trace) return this.#words.waiting;
    const { length, columns } = this.#trace;
    if (!length) return this.#words.nothing;
    return columns.total > length
      ? this.#words.truncated(length, columns.total)
      : this.#words.whole(this.#lines, length);
  }

  toggle() {
    this.#steps.toggle();
  }

  togglePlay() {
    this.#steps.togglePlay();
  }

  leave() {
    this.#steps.go(null);
  }

  /** @param {number | null} step */
  go(step) {
    this.#steps.go(step);
  }

  /** @param {number} by ±Infinity: to the ends */
  move(by) {
    this.#steps.move(by);
  }

  /** @param {string} name of a kind of decision */
  jump(name) {
    this.#steps.jump(name);
  }

  stop() {
    this.#steps.stop();
  }

  /** Shows another sentence until the next step; null: that of the decision again. @param {string | null} what */
  say(what) {
    this.#instead = what;
    this.#show();
  }

  /** @param {import("../wire.js").Method} method */
  setMethod({ begins, knobs }) {
    this.#knobs = knobs;
    this.#steps.jumps.rename("seed", begins);
    this.#show();
  }

  /** @param {Trace} trace */
  setTrace(trace) {
    this.#trace = trace;
    this.#loop.end();
    this.#showLoop();
    this.#marks.set(trace);
    this.#steps.jumps.offer(new Set(JUMPS.filter((name) => trace.columns.jumps[name])));
    this.#steps.setDecisions(trace.length, trace.marks);
    this.#show();
  }

  /** @param {number | null} step of the View */
  setStep(step) {
    if (step !== this.#steps.at) this.#instead = null;
    this.#steps.setAt(step);
    this.#show();
  }

  /** @param {boolean} on whether decisions are shown from near by */
  setCloseUp(on) {
    this.#closeUp.setAttribute("aria-pressed", String(on));
  }

  /** @param {number} count lines of the whole result */
  setLines(count) {
    this.#lines = count;
    this.#show();
  }
}
