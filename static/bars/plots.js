// @ts-check
// The scores of all frames as plots with axes, one above the other, when the timeline is pulled up.
import { freshCanvas } from "../widgets/canvas.js";
import { colour, onTheme } from "../widgets/colours.js";
import { h } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";
import { format } from "./scored.js";

/** @typedef {import("./scored.js").ScoredFrames} ScoredFrames */
/** @typedef {import("../wire.js").Score} Score */

const INSET = { top: 17, bottom: 5 };
const AXIS_PX = 16;
const TICK_PX = 90;

/**
 * @param {HTMLElement} holder
 * @param {{label: string}} text
 * @param {{scored: () => ScoredFrames, track: () => HTMLElement, onFrame: (frame: number) => void}} handlers track: of the timeline, with which they are aligned
 */
export function createPlots(holder, text, { scored, track, onFrame }) {
  const rows = h("div", { class: "plot-rows" });
  const axis = h("canvas", { class: "plot-axis" });
  const element = h("div", { class: "plot-box", role: "img", "aria-label": text.label }, rows, axis);
  holder.append(element);
  /** @type {import("../wire.js").State | null} */
  let state = null;
  /** The frame under the pointer. @type {number | null} */
  let pointed = null;
  let painting = 0;
  // Asking the element would lay the page out at every change.
  let height = 0;
  onTheme(paintSoon);
  new ResizeObserver(([{ contentRect }]) => {
    height = contentRect.height;
    paintSoon();
  }).observe(element);
  element.addEventListener("pointermove", (event) => {
    pointed = frameAt(event);
    paintSoon();
  });
  element.addEventListener("pointerleave", () => {
    pointed = null;
    paintSoon();
  });
  element.addEventListener("click", (event) => {
    const frame = frameAt(event);
    if (frame !== null) onFrame(frame);
  });

  /** @param {MouseEvent} event */
  function frameAt({ clientX }) {
    const survey = scored().survey;
    const { left, width } = axis.getBoundingClientRect();
    if (!survey || !width) return null;
    return scored().number(Math.round(clamp((clientX - left) / width, 0, 1) * (survey.frames - 1)));
  }

  function paintSoon() {
    if (!painting && height) painting = requestAnimationFrame(paint);
  }

  function paint() {
    painting = 0;
    const frames = scored();
    const { left, width } = track().getBoundingClientRect();
    element.style.paddingLeft = `${Math.round(left - holder.getBoundingClientRect().left + 3)}px`;
    element.style.setProperty("--wide", `${Math.round(width - 6)}px`);
    const shown = frames.scores
      .filter(({ name }) => frames.column(name).length)
      .sort((one, other) => Number(other.name === frames.score) - Number(one.name === frames.score));
    while (rows.childElementCount > shown.length) rows.lastElementChild?.remove();
    while (rows.childElementCount < shown.length) rows.append(h("canvas", { class: "plot" }));
    for (const [k, score] of shown.entries())
      paintPlot(/** @type {HTMLCanvasElement} */ (rows.children[k]), score, frames, state?.frame ?? null, pointed);
    paintAxis(axis, frames);
  }

  return {
    /** @param {import("../wire.js").State} next */
    setState(next) {
      state = next;
      paintSoon();
    },
    setSurvey: paintSoon,
    setView: paintSoon,
  };
}

/**
 * One score over the frames.
 * @param {HTMLCanvasElement} canvas @param {Score} score @param {ScoredFrames} frames
 * @param {number | null} present the frame that is shown @param {number | null} pointed the frame under the pointer
 */
function paintPlot(canvas, score, frames, present, pointed) {
  const { pen, width, height } = freshCanvas(canvas);
  const known = frames.column(score.name);
  const [low, high] = rangeOf(known);
  const at = (/** @type {number} */ value) =>
    height - INSET.bottom - ((value - low) / (high - low || 1)) * (height - INSET.top - INSET.bottom);
  pen.strokeStyle = colour("--axis");
  for (const value of [low, high]) line(pen, [0, at(value)], [width, at(value)]);
  pen.strokeStyle = colour("--accent");
  pen.beginPath();
  for (const [k, value] of known.entries()) pen.lineTo((k * width) / Math.max(1, known.length - 1), at(value));
  pen.stroke();
  pen.font = "11.5px system-ui, sans-serif";
  pen.fillStyle = colour("--ink");
  pen.fillText(score.label, 2, 11);
  const wide = pen.measureText(score.label).width;
  pen.fillStyle = colour("--muted");
  pen.fillText(`${format(low, score.unit)} to ${format(high, score.unit)}`, wide + 12, 11);
  for (const [frame, tone] of /** @type {[number | null, string][]} */ ([
    [present, "--muted"],
    [pointed, "--ink"],
  ])) {
    if (frame === null) continue;
    pen.strokeStyle = colour(tone);
    line(pen, [across(frames, frame, width), INSET.top], [across(frames, frame, width), height]);
  }
  pen.fillStyle = colour("--ink");
  pen.textAlign = "right";
  pen.fillText(frames.valueWords(score, pointed ?? present ?? 0), width - 2, 11);
  pen.textAlign = "left";
}

/** Numbers of frames below the plots. @param {HTMLCanvasElement} axis @param {ScoredFrames} frames */
function paintAxis(axis, frames) {
  const { pen, width } = freshCanvas(axis);
  const { survey } = frames;
  if (!survey) return;
  pen.font = "11px system-ui, sans-serif";
  pen.fillStyle = pen.strokeStyle = colour("--muted");
  const every = roundUp((survey.frames * survey.every * TICK_PX) / Math.max(1, width));
  const last = frames.number(survey.frames - 1);
  for (let frame = Math.ceil(survey.first / every) * every; frame <= last; frame += every) {
    const x = across(frames, frame, width);
    line(pen, [x, 0], [x, 3]);
    pen.textAlign = x < 12 ? "left" : x > width - 12 ? "right" : "center";
    pen.fillText(String(frame), x, AXIS_PX - 3);
  }
}

/** Where a frame is. @param {ScoredFrames} frames @param {number} frame @param {number} width */
function across({ survey }, frame, width) {
  return survey ? (((frame - survey.first) / survey.every) * width) / Math.max(1, survey.frames - 1) : 0;
}

/** @param {CanvasRenderingContext2D} pen @param {[number, number]} from @param {[number, number]} to */
function line(pen, from, to) {
  pen.beginPath();
  pen.moveTo(...from);
  pen.lineTo(...to);
  pen.stroke();
}

/** The least and the greatest. @param {Float32Array} values @returns {[number, number]} */
function rangeOf(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
  return [low, high];
}

/** The next of 1, 2, 5 · 10ⁿ. @param {number} least */
function roundUp(least) {
  const power = 10 ** Math.floor(Math.log10(Math.max(1, least)));
  return power * ([1, 2, 5, 10].find((step) => step * power >= least) ?? 10);
}
