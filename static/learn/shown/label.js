// @ts-check
// Ten frames to label: which of the lines found are walls, and how many walls were missed. TR and FR follow (Eqs. 9, 10).
import { fetchText } from "../../fetch.js";
import { fromPart } from "../../stage/measure.js";
import { freshCanvas } from "../../widgets/canvas.js";
import { colour, onTheme } from "../../widgets/colours.js";
import { h, setText } from "../../widgets/dom.js";
import { placeOn } from "./place.js";

/** @typedef {import("../../wire.js").FrameToLabel} Frame */
/** @typedef {import("../../wire.js").LineToLabel} Line */
/** @typedef {import("../../wire.js").Counted} Counted */
/** @typedef {[number, number]} Point */
/** wrong: lines that are no walls; missed: walls without a line; done: whether a person has said so. @typedef {{wrong: Set<Line>, missed: number, done: boolean}} Label */

const MOST_MISSED = 30;
// How near to a line a click must be.
const REACH_PX = 14;

export class Labelling {
  #text;
  #session;
  #onLabel;
  /** @type {Frame[]} */ #frames = [];
  /** @type {Label[]} */ #labels = [];
  #at = 0;
  #asked = false;
  #canvas = h("canvas", { class: "label-canvas", role: "img" });
  #chips;
  #place = h("span", { class: "muted" });
  #missed = h("output", { class: "number" }, "0");
  #says;
  #known = h("p", { class: "hint" });
  #back;
  #forth;
  #ready;

  /** @param {typeof import("../../text/shown.js").shownText.label} text @param {() => string} session @param {(labelled: number) => void} onLabel */
  constructor(text, session, onLabel) {
    this.#text = text;
    this.#session = session;
    this.#onLabel = onLabel;
    this.#chips = h("div", { class: "label-lines", role: "group", "aria-label": text.lines });
    this.#says = h("p", { role: "status" }, text.loading);
    const button = (/** @type {string} */ words, /** @type {string} */ label, /** @type {() => void} */ onclick) =>
      h("button", { type: "button", class: "button", "aria-label": label, onclick }, words);
    this.#back = button("‹", text.back, () => this.#go(this.#at - 1));
    this.#forth = button("›", text.forth, () => this.#go(this.#at + 1));
    this.#ready = h("button", { type: "button", class: "button", onclick: () => this.#judged() }, text.ready);
    const [less, more] = [button("−", text.less, () => this.#miss(-1)), button("+", text.more, () => this.#miss(1))];
    this.element = h(
      "section",
      { class: "shown-label", "aria-label": text.label },
      h("div", { class: "beside-head" }, this.#back, this.#place, this.#forth),
      this.#canvas,
      this.#chips,
      h("div", { class: "label-missed" }, text.missed, less, this.#missed, more, this.#ready),
      this.#says,
      this.#known,
    );
    this.#canvas.addEventListener("click", ({ offsetX, offsetY }) => {
      const frame = this.#frames[this.#at];
      const line = frame && lineAt(frame, [offsetX, offsetY], placeOf(frame, this.#canvas));
      if (line) this.#toggle(line);
    });
    onTheme(() => this.#draw());
    new ResizeObserver(() => this.#draw()).observe(this.#canvas);
  }

  set() {
    if (this.#asked) return this.#draw();
    this.#asked = true;
    return void this.#load();
  }

  async #load() {
    const query = new URLSearchParams({ session: this.#session() });
    const { words, trouble } = await fetchText(`/api/lessons/frames?${query}`);
    if (trouble !== null) {
      this.#asked = false;
      return setText(this.#says, trouble);
    }
    this.#frames = JSON.parse(words);
    this.#labels = this.#frames.map(() => ({ wrong: new Set(), missed: 0, done: false }));
    return this.#show();
  }

  /** @param {number} to */
  #go(to) {
    this.#at = Math.min(Math.max(to, 0), this.#frames.length - 1);
    this.#show();
  }

  /** @param {Line} line */
  #toggle(line) {
    const { wrong } = this.#labels[this.#at];
    if (!wrong.delete(line)) wrong.add(line);
    this.#show();
  }

  /** @param {number} by */
  #miss(by) {
    const label = this.#labels[this.#at];
    if (!label) return;
    label.missed = Math.min(Math.max(label.missed + by, 0), MOST_MISSED);
    this.#show();
  }

  /** This frame is labelled: on to the next that is not. */
  #judged() {
    const labels = this.#labels;
    if (!labels[this.#at]) return;
    labels[this.#at].done = true;
    const later = labels.findIndex(({ done }, k) => !done && k > this.#at);
    const next = later >= 0 ? later : labels.findIndex(({ done }) => !done);
    this.#go(next >= 0 ? next : this.#at);
    this.#onLabel(labels.filter(({ done }) => done).length);
  }

  #show() {
    const [text, frames, labels, at] = [this.#text, this.#frames, this.#labels, this.#at];
    const frame = frames[at];
    if (!frame) return;
    const label = labels[at];
    setText(this.#place, text.place(at + 1, frames.length, frame.frame, label.done));
    setText(this.#missed, String(label.missed));
    this.#back.disabled = at === 0;
    this.#forth.disabled = at === frames.length - 1;
    this.#ready.disabled = labels.every(({ done }) => done);
    const chips = this.#chips;
    const held = [...chips.children].indexOf(/** @type {Element} */ (document.activeElement));
    chips.replaceChildren(...frame.lines.map((line, k) => this.#chipOf(line, k, label.wrong.has(line))));
    /** @type {HTMLElement | undefined} */ (chips.children[held])?.focus();
    const done = labels.flatMap((each, k) => (each.done ? [countOf(frames[k], each)] : []));
    setText(this.#says, done.length ? text.says(done.length, sum(done)) : text.begin);
    const walls = frames.map((each) => each.known).filter((each) => each !== null);
    const all = done.length === frames.length && walls.length === frames.length;
    setText(this.#known, all ? text.known(sum(walls)) : "");
    this.#draw();
  }

  /** @param {Line} line @param {number} k @param {boolean} wrong */
  #chipOf(line, k, wrong) {
    const words = this.#text.line(k + 1, line.first, line.last, wrong);
    const attributes = { type: "button", class: "chip", "aria-pressed": String(wrong), "aria-label": words };
    const onclick = () => this.#toggle(line);
    return h("button", { ...attributes, title: words, onclick }, `${k + 1} ${wrong ? "✗" : "✓"}`);
  }

  #draw() {
    const frame = this.#frames[this.#at];
    if (!frame || !this.#canvas.isConnected) return;
    paint(this.#canvas, frame, this.#labels[this.#at].wrong);
    this.#canvas.setAttribute("aria-label", this.#text.picture(frame.frame));
  }
}

/** What a person says of a frame. @param {Frame} frame @param {Label} label @returns {Counted} */
function countOf({ lines }, { wrong, missed }) {
  const matched = lines.length - wrong.size;
  return { true: matched + missed, found: lines.length, matched };
}

/** @param {Counted[]} counts @returns {Counted} */
function sum(counts) {
  const of = (/** @type {keyof Counted} */ name) => counts.reduce((total, count) => total + count[name], 0);
  return { true: of("true"), found: of("found"), matched: of("matched") };
}

/** Where places of the plan are on a canvas. @param {Frame} frame @param {HTMLCanvasElement} canvas */
function placeOf({ x, y }, { clientWidth: width, clientHeight: height }) {
  const [xs, ys] = [x, y].map((values) => values.filter((value) => value !== null));
  return placeOn({ width, height }, xs, ys);
}

/** The line that was clicked. @param {Frame} frame @param {Point} spot @param {(at: Point) => Point} on */
function lineAt({ lines }, spot, on) {
  const far = lines.map(({ start, end }) => fromPart(spot, [on(start), on(end)]));
  const nearest = far.indexOf(Math.min(...far));
  return far[nearest] <= REACH_PX ? lines[nearest] : null;
}

/** @param {HTMLCanvasElement} canvas @param {Frame} frame @param {Set<Line>} wrong */
function paint(canvas, frame, wrong) {
  const { pen } = freshCanvas(canvas);
  const on = placeOf(frame, canvas);
  pen.fillStyle = colour("--muted");
  frame.x.forEach((x, beam) => {
    const y = frame.y[beam];
    if (x === null || y === null) return;
    const [left, top] = on([x, y]);
    pen.fillRect(left - 1, top - 1, 2, 2);
  });
  pen.font = "600 12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  frame.lines.forEach((line, k) => {
    const [[x1, y1], [x2, y2]] = [on(line.start), on(line.end)];
    pen.strokeStyle = pen.fillStyle = colour(wrong.has(line) ? "--failed" : "--good");
    pen.lineWidth = 3;
    pen.setLineDash(wrong.has(line) ? [4, 4] : []);
    pen.beginPath();
    pen.moveTo(x1, y1);
    pen.lineTo(x2, y2);
    pen.stroke();
    pen.setLineDash([]);
    // Beside the line, on the far side from the laser: walls that face each other keep their numbers apart.
    const [laser] = [on([0, 0])];
    const [mx, my] = [(x1 + x2) / 2, (y1 + y2) / 2];
    const far = Math.hypot(x2 - x1, y2 - y1) || 1;
    const side = -Math.sign((y1 - y2) * (laser[0] - mx) + (x2 - x1) * (laser[1] - my)) || 1;
    pen.fillText(String(k + 1), mx + (11 * side * (y1 - y2)) / far, my + (11 * side * (x2 - x1)) / far);
  });
}
