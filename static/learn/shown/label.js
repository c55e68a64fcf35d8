// @ts-check
// Ten frames to label: which of the lines found are walls, and how many walls were missed. TR and FR follow (Eqs. 9, 10).
import { fetchText } from "../../fetch.js";
import { freshCanvas } from "../../widgets/canvas.js";
import { colour, onTheme } from "../../widgets/colours.js";
import { h, setText } from "../../widgets/dom.js";

/** @typedef {import("../../wire.js").FrameToLabel} Frame */
/** @typedef {import("../../wire.js").LineToLabel} Line */
/** @typedef {[number, number]} Point */
/** wrong: lines that are no walls; missed: walls without a line; done: whether a person has said so. @typedef {{wrong: Set<Line>, missed: number, done: boolean}} Label */

const MARGIN = 14;
const MOST_MISSED = 30;
// How near to a line a click must be.
const REACH_PX = 14;

/** @param {typeof import("../../text/shown.js").shownText.label} text @param {() => string} session @param {(labelled: number) => void} onLabel */
export function createLabelling(text, session, onLabel) {
  /** @type {Frame[]} */
  let frames = [];
  /** @type {Label[]} */
  let labels = [];
  let [at, asked] = [0, false];
  const canvas = h("canvas", { class: "label-canvas", role: "img" });
  const chips = h("div", { class: "label-lines", role: "group", "aria-label": text.lines });
  const place = h("span", { class: "muted" });
  const missed = h("output", { class: "number" }, "0");
  const says = h("p", { role: "status" }, text.loading);
  const known = h("p", { class: "hint" });
  const turn = (/** @type {number} */ by) => go(Math.min(Math.max(at + by, 0), frames.length - 1));
  const button = (/** @type {string} */ words, /** @type {string} */ label, /** @type {() => void} */ onclick) =>
    h("button", { type: "button", class: "button", "aria-label": label, onclick }, words);
  const ready = h("button", { type: "button", class: "button", onclick: judged }, text.ready);
  const [back, forth] = [button("‹", text.back, () => turn(-1)), button("›", text.forth, () => turn(1))];
  const element = h(
    "section",
    { class: "shown-label", "aria-label": text.label },
    h("div", { class: "beside-head" }, back, place, forth),
    canvas,
    chips,
    h(
      "div",
      { class: "label-missed" },
      text.missed,
      button("−", text.less, () => miss(-1)),
      missed,
      button("+", text.more, () => miss(1)),
      ready,
    ),
    says,
    known,
  );
  canvas.addEventListener("click", ({ offsetX, offsetY }) => {
    const line = frames[at] && lineAt(frames[at], [offsetX, offsetY], placeOf(frames[at], canvas));
    if (line) toggle(line);
  });

  async function load() {
    const { words, trouble } = await fetchText(`/api/lessons/frames?${new URLSearchParams({ session: session() })}`);
    if (trouble !== null) return setText(says, trouble);
    frames = JSON.parse(words);
    labels = frames.map(() => ({ wrong: new Set(), missed: 0, done: false }));
    return show();
  }

  /** @param {number} to */
  function go(to) {
    at = to;
    show();
  }

  /** @param {Line} line */
  function toggle(line) {
    const { wrong } = labels[at];
    if (!wrong.delete(line)) wrong.add(line);
    show();
  }

  /** @param {number} by */
  function miss(by) {
    if (!labels[at]) return;
    labels[at].missed = Math.min(Math.max(labels[at].missed + by, 0), MOST_MISSED);
    show();
  }

  /** This frame is labelled: on to the next that is not. */
  function judged() {
    if (!labels[at]) return;
    labels[at].done = true;
    const next = labels.findIndex((label, k) => !label.done && k > at);
    const any = next >= 0 ? next : labels.findIndex((label) => !label.done);
    go(any >= 0 ? any : at);
    onLabel(labels.filter(({ done }) => done).length);
  }

  function show() {
    const frame = frames[at];
    if (!frame) return;
    const label = labels[at];
    setText(place, text.place(at + 1, frames.length, frame.frame, label.done));
    setText(missed, String(label.missed));
    back.disabled = at === 0;
    forth.disabled = at === frames.length - 1;
    ready.disabled = label.done && labels.every(({ done }) => done);
    const held = chips.contains(document.activeElement)
      ? [...chips.children].indexOf(/** @type {any} */ (document.activeElement))
      : -1;
    chips.replaceChildren(...frame.lines.map((line, k) => chipOf(line, k, label.wrong.has(line))));
    /** @type {HTMLElement | undefined} */ (chips.children[held])?.focus();
    const done = labels.flatMap((each, k) => (each.done ? [countOf(frames[k], each)] : []));
    setText(says, done.length ? text.says(done.length, sum(done)) : text.begin);
    const walls = frames.map((each) => each.known).filter((each) => each !== null);
    setText(known, done.length === frames.length && walls.length === frames.length ? text.known(sum(walls)) : "");
    draw();
  }

  /** @param {Line} line @param {number} k @param {boolean} wrong */
  function chipOf(line, k, wrong) {
    const words = text.line(k + 1, line.first, line.last, wrong);
    const attributes = { type: "button", class: "chip", "aria-pressed": String(wrong), "aria-label": words };
    return h("button", { ...attributes, title: words, onclick: () => toggle(line) }, `${k + 1} ${wrong ? "✗" : "✓"}`);
  }

  function draw() {
    if (frames[at] && canvas.isConnected) paint(canvas, frames[at], labels[at].wrong);
    canvas.setAttribute("aria-label", text.picture(frames[at]?.frame ?? 0));
  }

  onTheme(draw);
  new ResizeObserver(draw).observe(canvas);
  return {
    element,
    set() {
      if (asked) return draw();
      asked = true;
      return void load();
    },
  };
}

/** @typedef {{true: number, found: number, matched: number}} Counted */

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

/** Where places of the plan are on a canvas. @param {Frame} frame @param {HTMLCanvasElement} canvas @returns {(at: Point) => Point} */
function placeOf({ x, y }, { clientWidth: width, clientHeight: height }) {
  const [xs, ys] = [x, y].map((values) => values.filter((value) => value !== null));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min(
    (width - 2 * MARGIN) / Math.max(right - left, 0.1),
    (height - 2 * MARGIN) / Math.max(high - low, 0.1),
  );
  return ([across, up]) => [
    width / 2 + scale * (across - (left + right) / 2),
    height / 2 - scale * (up - (low + high) / 2),
  ];
}

/** The line that was clicked. @param {Frame} frame @param {Point} spot @param {(at: Point) => Point} on */
function lineAt({ lines }, spot, on) {
  const far = lines.map(({ start, end }) => distance(spot, on(start), on(end)));
  const nearest = far.indexOf(Math.min(...far));
  return far[nearest] <= REACH_PX ? lines[nearest] : null;
}

/** From a spot to a stretch. @param {Point} spot @param {Point} start @param {Point} end */
function distance([x, y], [x1, y1], [x2, y2]) {
  const [dx, dy] = [x2 - x1, y2 - y1];
  const along = ((x - x1) * dx + (y - y1) * dy) / Math.max(dx * dx + dy * dy, 1e-9);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(x - x1 - share * dx, y - y1 - share * dy);
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
    // Beside the line, on the side of the laser.
    const [laser] = [on([0, 0])];
    const [mx, my] = [(x1 + x2) / 2, (y1 + y2) / 2];
    const far = Math.hypot(x2 - x1, y2 - y1) || 1;
    const side = Math.sign((y1 - y2) * (laser[0] - mx) + (x2 - x1) * (laser[1] - my)) || 1;
    pen.fillText(String(k + 1), mx + (11 * side * (y1 - y2)) / far, my + (11 * side * (x2 - x1)) / far);
  });
}
