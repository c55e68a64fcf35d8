// @ts-check
// Heights over two thresholds as shades, with contours and a ring at the current values.
import { placeOf, valueAt } from "../widgets/scale.js";
import { contour } from "./contours.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** Axes as they are spanned; heights: a row for each y. @typedef {{x: Knob, y: Knob, xs: number[], ys: number[], heights: (number | null)[][]}} Relief */
/** @typedef {{low: number, high: number}} Range */

const LEVELS = 8;
// Dark to light, like viridis, so that lightness alone distinguishes heights.
const STOPS = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

/** From the lowest height to the highest. */
export const COLOURS = STOPS.map((stop) => `rgb(${stop.join(" ")})`);

/** The smallest and the largest height; null if none is known. @param {Relief} relief @returns {Range | null} */
export function rangeOf({ heights }) {
  const known = heights.flat().filter((height) => height !== null);
  return known.length ? { low: Math.min(...known), high: Math.max(...known) } : null;
}

/** @param {HTMLCanvasElement} canvas @param {Relief} relief @param {Range} range @param {Params} params the current values */
export function paintRelief(canvas, relief, range, params) {
  const pen = canvas.getContext("2d");
  if (!pen) return;
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  const { x, y } = relief;
  const px = relief.xs.map((value) => placeOf(x, value) * canvas.width);
  const py = relief.ys.map((value) => (1 - placeOf(y, value)) * canvas.height);
  paintCells(pen, relief, range, px, py);
  pen.lineWidth = ratio;
  paintContours(pen, relief, range, px, py);
  if (within(x, params) && within(y, params)) {
    const at = [placeOf(x, params[x.name]) * canvas.width, (1 - placeOf(y, params[y.name])) * canvas.height];
    ring(pen, at[0], at[1], ratio);
  }
}

/**
 * The setting at a place of the picture, and its cell.
 * @param {{x: Knob, y: Knob, xs: number[], ys: number[]}} axes @param {number} across 0 to 1 @param {number} down 0 to 1
 */
export function settingAt({ x, y, xs, ys }, across, down) {
  const params = { [x.name]: valueAt(x, across), [y.name]: valueAt(y, 1 - down) };
  return { params, column: nearest(x, xs, params[x.name]), row: nearest(y, ys, params[y.name]) };
}

/** @param {CanvasRenderingContext2D} pen @param {Relief} relief @param {Range} range @param {number[]} px @param {number[]} py */
function paintCells(pen, { heights }, { low, high }, px, py) {
  for (const [j, row] of heights.entries())
    for (const [i, height] of row.entries()) {
      if (height === null) continue;
      pen.fillStyle = shade(high > low ? (height - low) / (high - low) : 1);
      const [left, right] = edges(px, i, 0, pen.canvas.width);
      const [bottom, top] = edges(py, j, pen.canvas.height, 0);
      pen.fillRect(Math.floor(left), Math.floor(top), Math.ceil(right - left) + 1, Math.ceil(bottom - top) + 1);
    }
}

/** @param {CanvasRenderingContext2D} pen @param {Relief} relief @param {Range} range @param {number[]} px @param {number[]} py */
function paintContours(pen, { heights }, { low, high }, px, py) {
  pen.strokeStyle = "rgb(255 255 255 / 75%)";
  pen.beginPath();
  for (let k = 1; k < LEVELS && high > low; k++)
    for (const [x1, y1, x2, y2] of contour(heights, low + ((high - low) * k) / LEVELS)) {
      pen.moveTo(between(px, x1), between(py, y1));
      pen.lineTo(between(px, x2), between(py, y2));
    }
  pen.stroke();
}

/** Whether the current value of a threshold is on its axis. @param {Knob} knob @param {Params} params */
function within({ name, low, high }, params) {
  return params[name] >= low && params[name] <= high;
}

/** @param {number} place 0 to 1 */
function shade(place) {
  const at = place * (STOPS.length - 1);
  const from = Math.min(Math.floor(at), STOPS.length - 2);
  return `rgb(${STOPS[from].map((one, k) => Math.round(one + (at - from) * (STOPS[from + 1][k] - one))).join(" ")})`;
}

/** The borders of a cell, halfway to its neighbours. @param {number[]} places @param {number} k @param {number} first @param {number} last */
function edges(places, k, first, last) {
  return [
    k === 0 ? first : (places[k - 1] + places[k]) / 2,
    k === places.length - 1 ? last : (places[k] + places[k + 1]) / 2,
  ];
}

/** @param {number[]} places @param {number} at */
function between(places, at) {
  const k = Math.min(Math.floor(at), places.length - 2);
  return places[k] + (at - k) * (places[k + 1] - places[k]);
}

/** @param {Knob} knob @param {number[]} values @param {number} value */
function nearest(knob, values, value) {
  const distances = values.map((each) => Math.abs(placeOf(knob, each) - placeOf(knob, value)));
  return distances.indexOf(Math.min(...distances));
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} ratio */
function ring(pen, x, y, ratio) {
  for (const [colour, width] of /** @type {const} */ ([
    ["#000", 4],
    ["#fff", 2],
  ])) {
    pen.strokeStyle = colour;
    pen.lineWidth = width * ratio;
    pen.beginPath();
    pen.arc(x, y, 6 * ratio, 0, 2 * Math.PI);
    pen.stroke();
  }
}
