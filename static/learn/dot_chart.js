// @ts-check
// Values by beam and a threshold; pointer and keyboard can highlight and select a beam.
import { tooltip } from "../widgets/tooltip.js";
import { createWalk } from "../widgets/walk.js";
import { colour } from "../widgets/colours.js";
import { Plot } from "./plot.js";

/** @typedef {import("./plot.js").Box} Box */
/** @typedef {{x: number, y: number, limit: number, inside: boolean, now: boolean}} Dot x: its beam; limit: the threshold there */
/** @typedef {{onBeam: (beam: number | null) => void, onRun: (beam: number) => void, say: (beam: number, value: number) => string}} Beams onBeam: pointed at; onRun: chosen */

// Values are drawn up to this many times the threshold; larger ones are shown as an arrow at the edge.
const REACH = 3;
// The pointer hits a dot within this distance [px].
const NEAR = 20;

export class DotChart {
  #symbol;
  #beams;
  #plot;
  #walk;
  /** @type {Dot[]} */ #dots = [];
  /** By the pointer or the keyboard. @type {number | null} */ #pointed = null;

  /** @param {{title: string, y: string}} text y: the threshold's symbol @param {Beams} beams */
  constructor({ title, y }, beams) {
    this.#symbol = y;
    this.#beams = beams;
    this.#plot = new Plot(title, true);
    this.element = this.#plot.element;
    const { canvas } = this.#plot;
    this.#walk = createWalk(canvas, title, {
      count: () => this.#dots.length,
      start: () => this.#dots.findIndex((dot) => dot.now),
      say: (at) => beams.say(this.#dots[at].x, this.#dots[at].y),
      onAt: (at) => this.#point(at),
      onTake: (at) => beams.onRun(this.#dots[at].x),
    });
    canvas.addEventListener("pointermove", (event) => this.#point(this.#under(event)));
    tooltip(canvas, (event) => this.#valueAt(event), "left");
    canvas.addEventListener("pointerleave", () => this.#point(null));
    canvas.addEventListener("click", (event) => {
      const at = this.#under(event);
      if (at !== null) beams.onRun(this.#dots[at].x);
    });
  }

  /** @param {number | null} at */
  #point(at) {
    if (at === this.#pointed) return;
    this.#pointed = at;
    this.#beams.onBeam(at === null ? null : this.#dots[at].x);
    if (this.#dots.length) this.#draw();
  }

  /** @param {Event} event */
  #valueAt(event) {
    const at = event instanceof PointerEvent ? this.#under(event) : null;
    return at === null ? "" : this.#beams.say(this.#dots[at].x, this.#dots[at].y);
  }

  /** The dot under the pointer. @param {MouseEvent} event */
  #under({ offsetX }) {
    const { box } = this.#plot;
    let [best, least] = [/** @type {number | null} */ (null), NEAR];
    for (let k = 0; k < this.#dots.length; k++) {
      const away = Math.abs(this.#x(k, box) - offsetX);
      if (away < least) [best, least] = [k, away];
    }
    return best;
  }

  /** Position of the k-th dot. @param {number} k @param {Box} box */
  #x(k, { left, right }) {
    return left + 6 + (k / Math.max(1, this.#dots.length - 1)) * (right - left - 12);
  }

  #draw() {
    const { pen, box } = this.#plot.begin();
    const limits = this.#dots.map((dot) => dot.limit);
    const top = REACH * Math.max(...limits, 0);
    const y = (/** @type {number} */ value) => box.bottom - (Math.min(value, top) / top) * (box.bottom - box.top);
    if (limits.length === 1) limits.push(limits[0]);
    if (limits.length) this.#plot.threshold(pen, limits.map(y), this.#symbol);
    const radius = this.#dots.length > 150 ? 1.4 : 2.2;
    this.#dots.forEach((dot, k) => {
      const x = this.#x(k, box);
      const beyond = !(dot.y <= top);
      const at = beyond ? box.top + 3 : y(dot.y);
      pen.fillStyle = colour(dot.y > dot.limit || Number.isNaN(dot.y) ? "--failed" : "--passed");
      pen.globalAlpha = dot.inside || dot.now ? 1 : 0.38;
      pen.beginPath();
      if (beyond) arrow(pen, x, box.top);
      else pen.arc(x, at, radius, 0, 7);
      pen.fill();
      pen.globalAlpha = 1;
      if (dot.now) ring(pen, x, at, 4.5, "--ink");
      if (k === this.#pointed) ring(pen, x, at, 6.5, "--accent");
    });
    this.#label(pen, box);
  }

  /** The beams at both ends; the highlighted beam replaces the last. @param {CanvasRenderingContext2D} pen @param {Box} box */
  #label(pen, box) {
    const below = box.bottom + 12;
    const [first, last] = [this.#dots.at(0), this.#dots.at(-1)];
    const pointed = this.#pointed === null ? null : this.#dots[this.#pointed];
    pen.textAlign = "right";
    if (pointed) {
      pen.fillStyle = colour("--accent");
      pen.fillText(this.#beams.say(pointed.x, pointed.y), box.right, below);
    }
    pen.fillStyle = colour("--muted");
    if (last && !pointed) pen.fillText(String(last.x), this.#x(this.#dots.length - 1, box), below);
    pen.fillText("0", box.left - 4, box.bottom + 3);
    pen.textAlign = "left";
    if (first) pen.fillText(String(first.x), this.#x(0, box), below);
  }

  measure() {
    this.#plot.measure();
  }

  /** @param {string} why */
  clear(why) {
    this.#point(null);
    this.#dots = [];
    this.#walk.renew(null);
    this.#plot.blank(why);
  }

  /** @param {Dot[]} dots @param {string} words */
  set(dots, words) {
    const beam = this.#pointed === null ? null : this.#dots[this.#pointed].x;
    this.#dots = dots;
    const at = dots.findIndex((dot) => dot.x === beam);
    this.#point(at < 0 ? null : at);
    this.#walk.renew(this.#pointed);
    this.#plot.say(words);
    this.#draw();
  }
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} top */
function arrow(pen, x, top) {
  pen.moveTo(x - 2.5, top + 4);
  pen.lineTo(x, top);
  pen.lineTo(x + 2.5, top + 4);
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} radius @param {string} tone */
function ring(pen, x, y, radius, tone) {
  pen.strokeStyle = colour(tone);
  pen.beginPath();
  pen.arc(x, y, radius, 0, 7);
  pen.stroke();
}
