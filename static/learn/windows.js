// @ts-check
// Every window that was tried as a seed, over the beams, in four lanes, one for each outcome.
import { freshCanvas } from "../widgets/canvas.js";
import { h, setText } from "../widgets/dom.js";
import { createWalk } from "../widgets/walk.js";
import { colour, onTheme } from "../widgets/colours.js";

/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {typeof import("../text/learn.js").learnText.ladder} Text */

const TONES = /** @type {Record<string, string>} */ ({
  "": "--accent",
  delta: "--failed",
  epsilon: "--trouble",
  other: "--muted",
});

export class Windows {
  #text;
  /** @type {Trace | null} */ #trace = null;
  /** Decisions about windows. @type {number[]} */ #tried = [];
  #canvas = h("canvas", { class: "chart-canvas" });
  #said = h("span", { class: "off-screen" });
  /** The window under the pointer. */
  #named = h("span", { class: "muted", "aria-hidden": "true" });
  #walk;

  /** @param {Text} text @param {(step: number) => void} onGo */
  constructor(text, onGo) {
    this.#text = text;
    const legend = h(
      "span",
      { class: "ladder-legend" },
      ...Object.entries(text.tones).map(([check, words]) =>
        h("span", {}, h("i", { class: `key key-${check || "found"}` }), words),
      ),
    );
    const title = h("figcaption", {}, text.seeds, legend, this.#named);
    this.element = h("figure", { class: "chart" }, title, this.#canvas, this.#said);
    this.#walk = createWalk(this.#canvas, text.seeds, {
      count: () => this.#tried.length,
      start: () => 0,
      say: (at) => this.#say(this.#tried[at]),
      onAt: (at) => {
        this.#name(at === null ? null : this.#tried[at]);
        this.draw();
      },
      onTake: (at) => onGo(this.#tried[at]),
    });
    this.#canvas.addEventListener("pointermove", (event) => this.#name(this.#under(event)));
    this.#canvas.addEventListener("pointerleave", () => this.#name(null));
    this.#canvas.addEventListener("click", (event) => {
      const index = this.#under(event);
      if (index !== null) onGo(index);
    });
    onTheme(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.#canvas);
  }

  /** The decision about the window that begins nearest to the pointer. @param {MouseEvent} event */
  #under({ offsetX }) {
    if (!this.#trace) return null;
    const { first } = this.#trace.columns;
    const beam = (offsetX / this.#canvas.clientWidth) * this.#trace.beams;
    let best = null;
    for (const index of this.#tried)
      if (best === null || Math.abs(first[index] - beam) < Math.abs(first[best] - beam)) best = index;
    return best;
  }

  /** @param {number | null} index of a decision about a window */
  #name(index) {
    setText(this.#named, index === null ? "" : this.#say(index));
  }

  /** @param {number} index of a decision about a window */
  #say(index) {
    const { columns: c } = /** @type {Trace} */ (this.#trace);
    const { tones, window } = this.#text;
    return window(c.first[index], c.last[index], tones[c.checks[c.check[index]]] ?? tones.other);
  }

  draw() {
    if (!this.#trace || !this.#canvas.clientWidth) return;
    const { pen, width, height } = freshCanvas(this.#canvas);
    const { columns: c, beams } = this.#trace;
    const lanes = Object.keys(this.#text.tones);
    const tall = height / lanes.length;
    const marked = this.#tried[this.#walk.at ?? -1];
    /** @type {Map<string, number>} */
    const counts = new Map();
    /** @type {[number, number, number, number] | null} */
    let frame = null;
    pen.strokeStyle = colour("--ink");
    for (const index of this.#tried) {
      const check = c.checks[c.check[index]];
      const lane = lanes.includes(check) ? lanes.indexOf(check) : lanes.length - 1;
      counts.set(lanes[lane], (counts.get(lanes[lane]) ?? 0) + 1);
      pen.fillStyle = colour(TONES[check] ?? TONES.other);
      pen.globalAlpha = index === marked ? 1 : 0.55;
      const { from, wide } = placeOf(c.first[index], c.last[index], beams, width);
      pen.fillRect(from, lane * tall + 2, wide, tall - 4);
      if (index === marked) frame = [from, lane * tall, wide, tall];
    }
    pen.globalAlpha = 1;
    if (frame) pen.strokeRect(...frame);
    setText(this.#said, [...counts].map(([check, n]) => `${this.#text.tones[check]}: ${n}`).join(", "));
  }

  /** @param {Trace} trace */
  setTrace(trace) {
    const { kinds, kind } = trace.columns;
    const wanted = ["seed rejected", "seed found"].map((name) => kinds.indexOf(name));
    this.#trace = trace;
    this.#tried = kind.flatMap((each, k) => (wanted.includes(each) ? [k] : []));
    this.#walk.renew(null);
    this.draw();
  }
}

/** Position of a window in a picture; it is as wide as its beams. @param {number} first @param {number} last @param {number} beams @param {number} width */
function placeOf(first, last, beams, width) {
  const count = ((last - first + beams) % beams) + 1;
  return { from: (first / beams) * width, wide: Math.max((count / beams) * width, 1) };
}
