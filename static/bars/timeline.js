// @ts-check
import { Player } from "../widgets/player.js";
import { createStrip } from "./strip.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */

const SPEEDS = [1, 2, 5, 10, 20, 40];
const USUAL_SPEED = 10;

/**
 * Frames of the recording: play, speed, number, scrubber over the strip of scores, stamp.
 * @param {HTMLElement} bar
 * @param {typeof import("../text/en.js").text.timeline} text
 * @param {{onFrame: (frame: number) => void, onScore: (score: string) => void, onScores: () => void, onFollow: (live: boolean) => void,
 *          settled: () => boolean, pill: HTMLElement}} handlers
 *   onScores: the strip shows other values; onFollow: of a live recording; pill: shows whether it is followed
 */
export function mountTimeline(bar, text, { onFrame, onScore, onScores, onFollow, settled, pill }) {
  let frame = 0;
  let frames = 0;
  /** Number of the first frame: of a live recording the oldest scans are gone. */
  let first = 0;
  /** Whether a live recording is followed; null of another. @type {boolean | null} */
  let live = null;

  const player = new Player(USUAL_SPEED, {
    ready: settled,
    atEnd: () => frame >= frames - 1,
    rewind: () => go(0),
    next: () => go(frame + 1),
    onState: showPlay,
  });
  const play = iconButton("play", text.play, toggle);
  const speed = h(
    "select",
    { class: "select", "aria-label": text.speed, onchange: () => player.setSpeed(Number(speed.value)) },
    ...SPEEDS.map((n) => h("option", { value: String(n), selected: n === USUAL_SPEED }, text.perSecond(n))),
  );
  tooltip(speed, text.speed);
  const number = createNumberField({
    label: text.frame,
    className: "frame-number",
    accept(typed) {
      const wanted = Number(typed);
      const [least, most] = [first + 1, first + frames];
      if (!Number.isInteger(wanted) || wanted < least || wanted > most) return text.range(least, most);
      go(wanted - least);
      return null;
    },
  });
  const total = h("span", { class: "of" });
  const slider = createSlider({
    label: text.scrubber,
    onPlace: (place) => go(strip.snap(Math.round(place * Math.max(0, frames - 1)))),
    onSteps: (steps) => move(steps),
  });
  const stamp = h("span", { class: "stamp" });
  tooltip(stamp, text.stamp);
  const strip = createStrip(text.strip, { onScore, onChange: onScores });
  const track = h("div", { class: "track" }, ...strip.backdrop, slider.element);
  strip.watch(track);
  // Where the thumb stands already the scrubber tells nothing, yet the pixel may show another frame.
  slider.element.addEventListener("click", () => go(strip.snap(frame)));
  bar.append(
    play,
    pill,
    speed,
    h("span", { class: "counter" }, number.element, total, number.error),
    track,
    strip.chooser,
    stamp,
  );

  /** @param {number} wanted */
  function go(wanted) {
    const next = clamp(wanted, 0, Math.max(0, frames - 1));
    if (next === frame) return;
    frame = next;
    show();
    onFrame(next);
  }

  /** @param {number} steps ±Infinity: to the ends */
  function move(steps) {
    player.stop();
    if (live === false && steps === Infinity) onFollow(true);
    else go(frame + steps);
  }

  /** Play or pause. Who stands at the end of a live recording that was paused follows it again. */
  function toggle() {
    if (live) onFollow(false);
    else if (live === false && !player.playing && frame >= frames - 1) onFollow(true);
    else if (frames > 1) player.toggle();
  }

  function showPlay() {
    const on = player.playing || live === true;
    play.show(on ? "pause" : "play", on ? text.pause : text.play);
  }

  function show() {
    const words = String(first + frame + 1);
    number.set(words);
    slider.set(
      frames > 1 ? frame / (frames - 1) : 0,
      [`${words} ${text.of(first + frames)}`, strip.words(frame)].filter(Boolean).join(", "),
    );
  }

  return {
    toggle,
    stop: () => player.stop(),
    move,
    /** To the next or former of the frames in the order of their score, the worst first. @param {1 | -1} by */
    doubtful(by) {
      player.stop();
      const next = strip.doubtful(frame, by);
      if (next !== null) go(next);
    },
    setScores: strip.setScores,
    showStrip: strip.show,
    /** @param {import("../wire.js").Survey} survey */
    setSurvey(survey) {
      strip.setSurvey(survey);
      show();
    },
    get strip() {
      return strip.current;
    },
    words: strip.words,
    number: strip.number,
    summary: strip.summary,
    different: () => strip.different(frame),
    /** @param {number} next frame of the View */
    setFrame(next) {
      frame = next;
      show();
    },
    /** @param {State} state */
    setState(state) {
      ({ frames, first, live } = state);
      if (live) player.stop();
      showPlay();
      bar.classList.toggle("single", frames < 2);
      strip.setState(state);
      for (const control of [play, speed, number.element, slider.element]) control.disabled = frames < 2;
      play.disabled = frames < 2 && live === null;
      setText(total, text.of(first + frames));
      number.element.style.width = `${String(first + frames).length + 2}ch`;
      setText(stamp, state.stamp === null ? "" : `${state.stamp.toFixed(3)} s`);
      show();
    },
  };
}
