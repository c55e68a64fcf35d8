// @ts-check
// Length and count of a growing line, each divided by its threshold, so that one dashed line serves both.
import { colour } from "../widgets/colours.js";
import { tooltip } from "../widgets/tooltip.js";
import { Plot } from "./plot.js";

// The axis has room for this many steps, however few there are.
const LEAST_STEPS = 20;

/** @typedef {{points: number, length: number}} Grown */

export class GrowthChart {
  #symbol;
  #plot;
  /** @type {Grown[]} */ #steps = [];

  /** @param {{title: string, y: string}} text y: words at the dashed line */
  constructor({ title, y }) {
    this.#symbol = y;
    this.#plot = new Plot(title, false);
    this.element = this.#plot.element;
    tooltip(this.#plot.canvas, (event) => this.#valueAt(event), "left");
  }

  /** @param {Event} event */
  #valueAt(event) {
    const last = this.#steps.length - 1;
    if (last < 0 || !(event instanceof PointerEvent)) return "";
    const { left, right } = this.#plot.box;
    const place = ((event.offsetX - left - 6) / (right - left - 12)) * Math.max(last, LEAST_STEPS);
    const { points, length } = this.#steps[Math.min(last, Math.max(0, Math.round(place)))];
    return `L ${length.toFixed(3)} m, P ${points}`;
  }

  measure() {
    this.#plot.measure();
  }

  /** @param {string} why */
  clear(why) {
    this.#steps = [];
    this.#plot.blank(why);
  }

  /** @param {Grown[]} steps @param {number} minLength @param {number} minPoints @param {string} words */
  set(steps, minLength, minPoints, words) {
    this.#steps = steps;
    this.#plot.say(words);
    const { pen, box } = this.#plot.begin();
    const lengths = steps.map(({ length }) => length / Math.max(minLength, 1e-9));
    const counts = steps.map(({ points }) => points / Math.max(minPoints, 1));
    const top = Math.max(1.6, Math.min(1.1 * Math.max(...lengths, ...counts), 12));
    const x = (/** @type {number} */ k) =>
      box.left + 6 + (k / Math.max(steps.length - 1, LEAST_STEPS)) * (box.right - box.left - 12);
    const y = (/** @type {number} */ value) => box.bottom - (Math.min(value, top) / top) * (box.bottom - box.top);
    this.#plot.threshold(pen, [y(1), y(1)], this.#symbol);
    const last = steps[steps.length - 1];
    const curves = /** @type {const} */ ([
      [lengths, "--accent", `L ${last.length.toFixed(2)} m`],
      [counts, "--good", `P ${last.points}`],
    ]);
    curves.forEach(([values, tone, label], k) => {
      pen.strokeStyle = pen.fillStyle = colour(tone);
      pen.lineWidth = 1.6;
      pen.beginPath();
      for (const [place, value] of values.entries()) pen.lineTo(x(place), y(value));
      pen.stroke();
      pen.beginPath();
      pen.arc(x(values.length - 1), y(values[values.length - 1]), 2.5, 0, 7);
      pen.fill();
      pen.textAlign = "left";
      pen.fillText(label, box.left + 8 + k * 62, box.bottom + 12);
    });
  }
}
