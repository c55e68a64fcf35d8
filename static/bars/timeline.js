// @ts-check
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";
import { fieldOf } from "../view/fields.js";
import { Playback } from "./playback.js";
import { Strip } from "./strip.js";
import { STEADY, Times } from "./times.js";
import { createWhen } from "./when.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").View["speed"]} Speed */

const SPEEDS = /** @type {Speed[]} */ (fieldOf("speed").choices);

/** @typedef {typeof import("../text/page.js").pageText.timeline} Text */
/**
 * @typedef {object} Handlers
 * @property {(frame: number) => void} onFrame
 * @property {(speed: Speed) => void} onSpeed
 * @property {(score: string) => void} onScore
 * @property {() => void} onScores the values of the strip changed
 * @property {(live: boolean) => void} onFollow a live recording is followed, or no longer
 * @property {() => boolean} settled
 * @property {HTMLElement} pill shows whether it is followed
 */

/** Frames of the recording: play, speed, number, scrubber over the strip of scores, time. A place counts from 0 without steps. */
export class Timeline {
  #frame = 0;
  #frames = 0;
  /** Number of the first frame in the file or source, and the step to the next. */
  #first = 0;
  #every = 1;
  #times = new Times(0, null);
  /** The last message about times. @type {import("../wire.js").Times | null} */
  #told = null;
  /** The one that is in use. @type {import("../wire.js").Times | null} */
  #used = null;
  /** @type {State | null} */
  #state = null;
  #bar;
  #text;
  #handlers;
  #playback;
  #strip;
  #controls;
  /** The scrubber over the strip. */
  track;

  /** @param {HTMLElement} bar @param {Text} text @param {Handlers} handlers */
  constructor(bar, text, handlers) {
    this.#bar = bar;
    this.#text = text;
    this.#handlers = handlers;
    this.#playback = new Playback({
      ready: handlers.settled,
      place: () => this.#place,
      last: () => this.#frames - 1,
      after: (from, seconds) => this.#times.after(from, seconds),
      show: (place) => this.#playTo(place),
      onState: () => this.#showPlay(),
    });
    this.#strip = new Strip(text.strip, { onScore: handlers.onScore, onChange: handlers.onScores });
    this.#controls = this.#createControls();
    const { play, speed, number, total, slider, when } = this.#controls;
    const track = h("div", { class: "track" }, ...this.#strip.backdrop, slider.element);
    this.track = track;
    this.#strip.watch(track);
    const counter = h("span", { class: "counter" }, number.element, total, number.error);
    bar.append(play, handlers.pill, speed, counter, track, this.#strip.chooser, when.element);
    bar.setAttribute("aria-label", text.label);
  }

  #createControls() {
    const text = this.#text;
    const slider = createSlider({
      label: text.scrubber,
      onPlace: (place) => this.#go(this.#strip.snap(Math.round(place * Math.max(0, this.#frames - 1)))),
      onSteps: (steps) => this.move(steps),
    });
    // A click on the thumb itself moves nothing, but the pixel may show another frame.
    slider.element.addEventListener("click", () => this.#go(this.#strip.snap(this.#place)));
    return {
      play: iconButton("play", text.play, () => this.toggle()),
      speed: this.#createSpeed(),
      number: createNumberField({
        label: text.frame,
        className: "frame-number",
        accept: (typed) => this.#accept(typed),
      }),
      total: h("span", { class: "of" }),
      slider,
      when: createWhen(text.when),
    };
  }

  #createSpeed() {
    const text = this.#text;
    const select = h(
      "select",
      {
        class: "select",
        "aria-label": text.speed,
        onchange: () => this.#handlers.onSpeed(/** @type {Speed} */ (select.value)),
      },
      ...SPEEDS.map((speed) => h("option", { value: speed }, text.times(Number(speed)))),
    );
    tooltip(select, () => (this.#times.real ? text.realTime : text.steady(STEADY)));
    return select;
  }

  /** @param {string} typed @returns {string | null} why it is refused */
  #accept(typed) {
    const wanted = Number(typed);
    const [least, most] = [this.#first, this.#number(this.#frames - 1)];
    if (!Number.isInteger(wanted) || wanted < least || wanted > most) return this.#text.range(least, most);
    this.#go(Math.round((wanted - least) / this.#every));
    return null;
  }

  /** The number of the frame at a place. @param {number} place */
  #number(place) {
    return this.#first + this.#every * place;
  }

  get #place() {
    return clamp(Math.round((this.#frame - this.#first) / this.#every), 0, Math.max(0, this.#frames - 1));
  }

  /** Moves by hand. @param {number} place */
  #go(place) {
    this.#show(place);
    this.#playback.restart();
  }

  /** @param {number} place */
  #playTo(place) {
    const gap = this.#times.skipped(this.#place, place);
    if (gap) toast(this.#text.skipped(gap));
    this.#show(place);
  }

  /** @param {number} place */
  #show(place) {
    const frame = this.#number(clamp(place, 0, Math.max(0, this.#frames - 1)));
    if (frame === this.#frame) return;
    this.#frame = frame;
    this.#paint();
    this.#handlers.onFrame(frame);
  }

  /** @param {number} steps ±Infinity: to the ends */
  move(steps) {
    this.#playback.stop();
    if (this.#state?.live === false && steps === Infinity) this.#handlers.onFollow(true);
    else this.#go(this.#place + steps);
  }

  /** Plays or pauses. At the end of a paused live recording, follows it again. */
  toggle() {
    const live = this.#state?.live ?? null;
    const atEnd = !this.#playback.playing && this.#place >= this.#frames - 1;
    if (live) this.#handlers.onFollow(false);
    else if (live === false && atEnd) this.#handlers.onFollow(true);
    else if (this.#frames > 1) this.#playback.toggle();
  }

  /** Chooses the next slower or faster speed. @param {1 | -1} by */
  pace(by) {
    const { speed } = this.#controls;
    const next = SPEEDS[SPEEDS.indexOf(/** @type {Speed} */ (speed.value)) + by];
    if (next && !speed.disabled) this.#handlers.onSpeed(next);
  }

  /** Goes to the next or previous frame in the order of the score, worst first. @param {1 | -1} by */
  doubtful(by) {
    this.#playback.stop();
    const next = this.#strip.frames.doubtful(this.#frame, by);
    if (next !== null) this.#handlers.onFrame(next);
  }

  /** The next frame where A and B differ; null if there is none. */
  different() {
    return this.#strip.frames.different(this.#frame);
  }

  /** The scores of the frames. */
  get scored() {
    return this.#strip.frames;
  }

  #showPlay() {
    const on = this.#playback.playing || this.#state?.live === true;
    this.#controls.play.show(on ? "pause" : "play", on ? this.#text.pause : this.#text.play);
  }

  #showWhen() {
    if (this.#state) this.#controls.when.show(this.#state, this.#times.why, STEADY * this.#playback.speed);
  }

  #paint() {
    const frame = this.#frame;
    this.#controls.number.set(String(frame));
    const gap = this.#times.gaps.find(({ place }) => place === this.#place);
    const said = [
      `${frame} ${this.#text.of(this.#first, this.#number(this.#frames - 1))}`,
      this.#strip.frames.words(frame),
      gap ? this.#text.strip.gap(gap.seconds, frame) : "",
    ];
    const share = this.#frames > 1 ? this.#place / (this.#frames - 1) : 0;
    this.#controls.slider.set(share, said.filter(Boolean).join(", "));
  }

  /** @param {import("../wire.js").Score[]} scores */
  setScores(scores) {
    this.#strip.setScores(scores);
  }

  /** @param {import("../wire.js").Survey} survey */
  setSurvey(survey) {
    this.#strip.setSurvey(survey);
    this.#paint();
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ frame, score, dark, speed }) {
    const moved = frame !== this.#frame;
    this.#frame = frame;
    if (moved) this.#playback.restart();
    this.#playback.speed = Number(speed);
    this.#controls.speed.value = speed;
    this.#showWhen();
    this.#paint();
    this.#strip.show(score, dark);
  }

  /** @param {import("../wire.js").Times} told */
  setTimes(told) {
    this.#told = told;
  }

  /** Uses the times that belong to the recording on the screen. @param {string} place @param {number} frames */
  #retime(place, frames) {
    const told = this.#told?.place === place && (this.#told.since?.length ?? frames) === frames ? this.#told : null;
    if (told === this.#used && frames === this.#times.frames) return;
    this.#used = told;
    this.#times = new Times(frames, told?.since ?? null, told?.why);
    this.#strip.setGaps(this.#times.gaps, frames);
    this.#playback.restart();
  }

  /** @param {State} state */
  setState(state) {
    const { frames, first, every, live, place } = state;
    [this.#frames, this.#first, this.#every, this.#state] = [frames, first, every, state];
    this.#retime(place, frames);
    if (live) this.#playback.stop();
    this.#showPlay();
    this.#bar.classList.toggle("single", frames < 2);
    this.#strip.setState(state);
    const { play, speed, number, slider, total } = this.#controls;
    for (const control of [play, speed, number.element, slider.element]) control.disabled = frames < 2;
    play.disabled = frames < 2 && live === null;
    const last = this.#number(frames - 1);
    setText(total, this.#text.of(first, last));
    number.element.style.width = `${String(last).length + 2}ch`;
    this.#showWhen();
    this.#paint();
  }
}
