// @ts-check
// Another method on the same scan, stepped together with the one in the scene: each at the same share of its decisions.
import { fetchText } from "../../fetch.js";
import { learnText } from "../../text/learn.js";
import { freshCanvas } from "../../widgets/canvas.js";
import { colour, onTheme } from "../../widgets/colours.js";
import { h, setText } from "../../widgets/dom.js";
import { foot } from "../geometry.js";
import { SplitListing } from "../split_listing.js";
import { Trace } from "../trace.js";
import { placeOn } from "./place.js";

/** @typedef {import("../trace.js").Event} Event */
/** @typedef {[number, number]} Point */

/** After these decisions there is a line. */
const STANDS = new Set(["stretch kept", "line kept", "line fitted", "lines merged"]);

export class Beside {
  #text;
  #session;
  #canvas;
  #listing = new SplitListing(learnText.listing);
  #said = h("p", { class: "beside-said" });
  #count = h("p", { class: "muted" });
  #select;
  /** @type {Trace | null} */ #trace = null;
  #asked = "";
  /** Share of the decisions that were made. */ #share = 1;

  /** @param {typeof import("../../text/shown.js").shownText.beside} text @param {() => string} session */
  constructor(text, session) {
    this.#text = text;
    this.#session = session;
    this.#canvas = h("canvas", { class: "beside-canvas", role: "img", "aria-label": text.scene });
    this.#select = h(
      "select",
      { class: "select", "aria-label": text.method, onchange: () => this.#ask() },
      ...text.methods.map(([value, label]) => h("option", { value }, label)),
    );
    this.element = h(
      "section",
      { class: "shown-beside", "aria-label": text.label },
      h("div", { class: "beside-head" }, this.#select, this.#count),
      this.#canvas,
      this.#said,
      this.#listing.element,
    );
    onTheme(() => this.#draw());
  }

  /** @param {import("../../wire.js").State} state */
  set({ place, frame, step, steps }) {
    this.#share = step === null ? 1 : steps > 1 ? step / (steps - 1) : 1;
    const wanted = `${place} ${frame}`;
    if (wanted !== this.#asked) {
      this.#asked = wanted;
      this.#ask();
    } else this.#draw();
  }

  async #ask() {
    const method = this.#select.value;
    setText(this.#said, this.#text.waiting);
    const query = new URLSearchParams({ session: this.#session(), method });
    const { words, trouble } = await fetchText(`/api/lessons/decisions?${query}`);
    // Another may have been chosen by then.
    if (method !== this.#select.value) return;
    if (trouble !== null) return setText(this.#said, trouble);
    this.#trace = new Trace(JSON.parse(words));
    this.#listing.setMethod(method, this.#select.selectedOptions[0].label);
    this.#draw();
  }

  #draw() {
    const trace = this.#trace;
    if (!trace?.length || !this.#canvas.isConnected) return;
    const index = Math.round(this.#share * (trace.length - 1));
    const event = trace.at(index);
    setText(this.#said, event.text);
    setText(this.#count, this.#text.place(index + 1, trace.length));
    this.#listing.light(event.kind);
    paint(this.#canvas, trace, event, linesAt(trace, index));
  }
}

/** The lines after a decision, by candidate. @param {Trace} trace @param {number} index */
function linesAt(trace, index) {
  /** @type {Map<number, Event>} */
  const lines = new Map();
  for (let k = 0; k <= index; k++) {
    const event = trace.at(k);
    if (event.kind === "line dropped") lines.delete(event.candidate);
    if (!STANDS.has(event.kind) || !event.line) continue;
    if (event.kind === "lines merged")
      for (const [key, { first, last }] of lines) if (event.first <= first && last <= event.last) lines.delete(key);
    lines.set(event.candidate, event);
  }
  return [...lines.values()];
}

/** @param {HTMLCanvasElement} canvas @param {Trace} trace @param {Event} event @param {Event[]} lines */
function paint(canvas, trace, event, lines) {
  const { pen, width, height } = freshCanvas(canvas);
  const points = Array.from({ length: trace.beams }, (_, beam) => trace.point(beam));
  const there = points.filter((point) => point !== null);
  const [xs, ys] = [0, 1].map((axis) => there.map((point) => point[axis]));
  const at = placeOn({ width, height }, xs, ys);
  const tested = new Set(trace.span(event.first, event.last));
  points.forEach((point, beam) => {
    if (!point) return;
    const [x, y] = at(point);
    pen.fillStyle = colour(tested.has(beam) ? "--accent" : "--muted");
    pen.fillRect(x - 1.5, y - 1.5, 3, 3);
  });
  const stroke = (/** @type {Event} */ { first, last, line }) => {
    const [one, other] = [trace.point(first), trace.point(last)];
    if (!one || !other || !line) return;
    pen.beginPath();
    pen.moveTo(...at(foot(one, line)));
    pen.lineTo(...at(foot(other, line)));
    pen.stroke();
  };
  pen.lineWidth = 2.5;
  pen.strokeStyle = colour("--good");
  lines.forEach(stroke);
  pen.lineWidth = 1.5;
  pen.strokeStyle = colour("--accent");
  stroke(event);
  const tip = trace.point(event.beam);
  if (!tip) return;
  pen.strokeStyle = colour("--failed");
  pen.beginPath();
  pen.arc(...at(tip), 5, 0, 2 * Math.PI);
  pen.stroke();
}
