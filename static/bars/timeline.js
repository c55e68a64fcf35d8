// @ts-check
import { Player } from "../widgets/player.js";
import { Strip } from "./strip.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { createSpeed } from "../widgets/speed.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */

const USUAL_SPEED = 10;
// From 2000 to 2100 [s since 1970].
const CENTURY = [946_684_800, 4_102_444_800];

/** @typedef {typeof import("../text/page.js").pageText.timeline} Text */
/**
 * @typedef {object} Handlers
 * @property {(frame: number) => void} onFrame
 * @property {(score: string) => void} onScore
 * @property {() => void} onScores the values of the strip changed
 * @property {(live: boolean) => void} onFollow a live recording is followed, or no longer
 * @property {() => boolean} settled
 * @property {HTMLElement} pill shows whether it is followed
 */

/** Frames of the recording: play, speed, number, scrubber over the strip of scores, stamp. */
export class Timeline {
  #frame = 0;
  #frames = 0;
  /** Number of the first frame in the file or source, and the step to the next. */
  #first = 0;
  #every = 1;
  /** When the scan was taken, if its stamp says so. */
  #clock = "";
  /** Whether the live recording is followed; null if the recording is not live. @type {boolean | null} */
  #live = null;
  #bar;
  #text;
  #handlers;
  #player;
  #strip;
  #controls;

  /** @param {HTMLElement} bar @param {Text} text @param {Handlers} handlers */
  constructor(bar, text, handlers) {
    this.#bar = bar;
    this.#text = text;
    this.#handlers = handlers;
    this.#player = new Player(USUAL_SPEED, {
      ready: handlers.settled,
      atEnd: () => this.#frame >= this.#frames - 1,
      rewind: () => this.#go(0),
      next: () => this.#go(this.#frame + 1),
      onState: () => this.#showPlay(),
    });
    this.#strip = new Strip(text.strip, { onScore: handlers.onScore, onChange: handlers.onScores });
    this.#controls = this.#createControls();
    const { play, speed, number, total, slider, stamp } = this.#controls;
    const track = h("div", { class: "track" }, ...this.#strip.backdrop, slider.element);
    this.#strip.watch(track);
    const counter = h("span", { class: "counter" }, number.element, total, number.error);
    bar.append(play, handlers.pill, speed, counter, track, this.#strip.chooser, stamp);
    bar.setAttribute("aria-label", text.label);
  }

  #createControls() {
    const text = this.#text;
    const speed = createSpeed(text, USUAL_SPEED, (perSecond) => this.#player.setSpeed(perSecond));
    const slider = createSlider({
      label: text.scrubber,
      onPlace: (place) => this.#go(this.#strip.snap(Math.round(place * Math.max(0, this.#frames - 1)))),
      onSteps: (steps) => this.move(steps),
    });
    // A click on the thumb itself moves nothing, but the pixel may show another frame.
    slider.element.addEventListener("click", () => this.#go(this.#strip.snap(this.#frame)));
    const stamp = h("span", { class: "stamp" });
    tooltip(stamp, () => text.stamp(this.#clock));
    return {
      play: iconButton("play", text.play, () => this.toggle()),
      speed,
      number: createNumberField({
        label: text.frame,
        className: "frame-number",
        accept: (typed) => this.#accept(typed),
      }),
      total: h("span", { class: "of" }),
      slider,
      stamp,
    };
  }

  /** @param {string} typed @returns {string | null} why it is refused */
  #accept(typed) {
    const wanted = Number(typed);
    const [least, most] = [this.#first, this.#number(this.#frames - 1)];
    if (!Number.isInteger(wanted) || wanted < least || wanted > most) return this.#text.range(least, most);
    this.#go(Math.round((wanted - least) / this.#every));
    return null;
  }

  /** @param {number} frame */
  #number(frame) {
    return this.#first + this.#every * frame;
  }

  /** @param {number} wanted */
  #go(wanted) {
    const next = clamp(wanted, 0, Math.max(0, this.#frames - 1));
    if (next === this.#frame) return;
    this.#frame = next;
    this.#show();
    this.#handlers.onFrame(next);
  }

  /** @param {number} steps ±Infinity: to the ends */
  move(steps) {
    this.#player.stop();
    if (this.#live === false && steps === Infinity) this.#handlers.onFollow(true);
    else this.#go(this.#frame + steps);
  }

  /** Plays or pauses. At the end of a paused live recording, follows it again. */
  toggle() {
    const atEnd = !this.#player.playing && this.#frame >= this.#frames - 1;
    if (this.#live) this.#handlers.onFollow(false);
    else if (this.#live === false && atEnd) this.#handlers.onFollow(true);
    else if (this.#frames > 1) this.#player.toggle();
  }

  /** Goes to the next or previous frame in the order of the score, worst first. @param {1 | -1} by */
  doubtful(by) {
    this.#player.stop();
    const next = this.#strip.frames.doubtful(this.#frame, by);
    if (next !== null) this.#go(next);
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
    const on = this.#player.playing || this.#live === true;
    this.#controls.play.show(on ? "pause" : "play", on ? this.#text.pause : this.#text.play);
  }

  #show() {
    const frame = this.#frame;
    const words = String(this.#number(frame));
    this.#controls.number.set(words);
    const said = [
      `${words} ${this.#text.of(this.#first, this.#number(this.#frames - 1))}`,
      this.#strip.frames.words(frame),
    ];
    this.#controls.slider.set(this.#frames > 1 ? frame / (this.#frames - 1) : 0, said.filter(Boolean).join(", "));
  }

  /** @param {import("../wire.js").Score[]} scores */
  setScores(scores) {
    this.#strip.setScores(scores);
  }

  /** @param {import("../wire.js").Survey} survey */
  setSurvey(survey) {
    this.#strip.setSurvey(survey);
    this.#show();
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ frame, score, dark }) {
    this.#frame = frame;
    this.#show();
    this.#strip.show(score, dark);
  }

  /** @param {State} state */
  setState(state) {
    const { frames, first, every, live } = state;
    [this.#frames, this.#first, this.#every, this.#live] = [frames, first, every, live];
    if (live) this.#player.stop();
    this.#showPlay();
    this.#bar.classList.toggle("single", frames < 2);
    this.#strip.setState(state);
    const { play, speed, number, slider, total, stamp } = this.#controls;
    for (const control of [play, speed, number.element, slider.element]) control.disabled = frames < 2;
    play.disabled = frames < 2 && live === null;
    const last = this.#number(frames - 1);
    setText(total, this.#text.of(first, last));
    number.element.style.width = `${String(last).length + 2}ch`;
    setText(stamp, state.since === null ? "" : `${state.since.toFixed(3)} s`);
    this.#clock = clockOf(state);
    this.#show();
  }
}

/** The date and time of a stamp of this century, "" for others. @param {State} state */
function clockOf({ stamp, account }) {
  if (stamp === null || account?.believable === false || stamp < CENTURY[0] || stamp >= CENTURY[1]) return "";
  return new Date(1000 * stamp).toISOString().replace("T", " ").replace("Z", " UTC");
}
