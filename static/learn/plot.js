// @ts-check
// The canvas of a chart: its size, its axes, the dashed line of a threshold, and text if there is nothing to draw.
import { freshCanvas } from "../widgets/canvas.js";
import { h, setText } from "../widgets/dom.js";
import { colour } from "../widgets/colours.js";

/** @typedef {{left: number, right: number, top: number, bottom: number}} Box */

const PAD = { left: 34, right: 8, top: 6, bottom: 15 };

export class Plot {
  #size = { width: 0, height: 0 };
  #said = h("span", { class: "off-screen" });
  #note = h("p", { class: "chart-note muted" });

  /** @param {string} title @param {boolean} spoken whether the canvas itself speaks */
  constructor(title, spoken) {
    this.canvas = h("canvas", { class: "chart-canvas", "aria-hidden": spoken ? null : "true" });
    this.element = h("figure", { class: "chart" }, h("figcaption", {}, title), this.canvas, this.#note, this.#said);
  }

  /** The size is cached: reading it after a text change would force another layout. */
  measure() {
    this.#size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** Where the curves are. @returns {Box} */
  get box() {
    const { width, height } = this.#size;
    return { left: PAD.left, right: width - PAD.right, top: PAD.top, bottom: height - PAD.bottom };
  }

  /** Shows text instead of a drawing. @param {string} why */
  blank(why) {
    this.canvas.classList.add("blank");
    setText(this.#note, why);
    setText(this.#said, "");
  }

  /** @param {string} words what the chart shows, for those who listen */
  say(words) {
    this.canvas.classList.remove("blank");
    setText(this.#note, "");
    setText(this.#said, words);
  }

  /** Draws new axes and returns the pen. */
  begin() {
    const { pen } = freshCanvas(this.canvas, this.#size);
    const { box } = this;
    pen.font = "10.5px system-ui, sans-serif";
    pen.strokeStyle = colour("--axis");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(box.left, box.top);
    pen.lineTo(box.left, box.bottom + 0.5);
    pen.lineTo(box.right, box.bottom + 0.5);
    pen.stroke();
    return { pen, box };
  }

  /**
   * The dashed line of a threshold through heights at evenly spaced places.
   * @param {CanvasRenderingContext2D} pen
   * @param {number[]} heights
   * @param {string} words
   */
  threshold(pen, heights, words) {
    const { left, right } = this.box;
    pen.strokeStyle = colour("--ink");
    pen.setLineDash([4, 3]);
    pen.beginPath();
    heights.forEach((y, k) => pen.lineTo(left + (k / Math.max(1, heights.length - 1)) * (right - left), y));
    pen.stroke();
    pen.setLineDash([]);
    pen.fillStyle = colour("--ink");
    pen.textAlign = "right";
    pen.fillText(words, left - 4, heights[0] + 3.5);
  }
}
