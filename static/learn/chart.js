// @ts-check
// One chart of the dock: values by beam against a threshold, or two curves of a growing line.
import { h, setText } from "../widgets/dom.js";
import { createWalk } from "../widgets/walk.js";
import { colour } from "./colours.js";

/** @typedef {{x: number, y: number, inside: boolean, now: boolean}} Dot x: its beam */

// Values are drawn up to so many times the threshold; what is above is shown as an arrow at the edge.
const REACH = 3;
const PAD = { left: 34, right: 8, top: 6, bottom: 15 };

/**
 * @param {{title: string, y: string}} text
 * @param {{onBeam: (beam: number | null) => void, onRun: (beam: number) => void, say: (beam: number, value: number) => string} | null} beams
 *   what is done with a beam under the pointer or the keyboard, and with one that is chosen; null where there are none
 */
export function createChart(text, beams) {
  const canvas = h("canvas", { class: "chart-canvas", "aria-hidden": beams ? null : "true" });
  const said = h("span", { class: "off-screen" });
  const note = h("p", { class: "chart-note muted" });
  const element = h("figure", { class: "chart" }, h("figcaption", {}, text.title), canvas, note, said);
  /** @type {Dot[]} */
  let dots = [];
  let limit = 0;
  /** By the pointer or the keyboard. @type {number | null} */
  let pointed = null;
  let size = { width: 0, height: 0 };
  const walk =
    beams &&
    createWalk(canvas, text.title, {
      count: () => dots.length,
      start: () => dots.findIndex((dot) => dot.now),
      say: (at) => beams.say(dots[at].x, dots[at].y),
      onAt(at) {
        point(at);
      },
      onTake: (at) => beams.onRun(dots[at].x),
    });
  if (beams) listen(beams);

  /** @param {NonNullable<typeof beams>} beams */
  function listen({ onRun }) {
    canvas.addEventListener("pointermove", (event) => point(nearest(event)));
    canvas.addEventListener("pointerleave", () => point(null));
    canvas.addEventListener("click", (event) => {
      const at = nearest(event);
      if (at !== null) onRun(dots[at].x);
    });
  }

  /** @param {number | null} at */
  function point(at) {
    if (at === pointed) return;
    pointed = at;
    beams?.onBeam(at === null ? null : dots[at].x);
    if (dots.length) drawDots();
  }

  /** Which dot is under the pointer. @param {MouseEvent} event */
  function nearest(event) {
    const x = placing(boxOf());
    let best = null;
    for (let k = 0; k < dots.length; k++)
      if (best === null || Math.abs(x(k) - event.offsetX) < Math.abs(x(best) - event.offsetX)) best = k;
    return best === null || Math.abs(x(best) - event.offsetX) > 20 ? null : best;
  }

  /** @param {{left: number, right: number}} box where the k-th dot lies */
  function placing({ left, right }) {
    return (/** @type {number} */ place) => left + 6 + (place / Math.max(1, dots.length - 1)) * (right - left - 12);
  }

  function boxOf() {
    return { left: PAD.left, right: size.width - PAD.right, top: PAD.top, bottom: size.height - PAD.bottom };
  }

  /** Pen over a fresh canvas. */
  function fresh() {
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    const { width, height } = size;
    const pixels = devicePixelRatio;
    if (canvas.width !== Math.round(width * pixels)) canvas.width = Math.round(width * pixels);
    if (canvas.height !== Math.round(height * pixels)) canvas.height = Math.round(height * pixels);
    pen.setTransform(pixels, 0, 0, pixels, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "10.5px system-ui, sans-serif";
    return { pen, box: boxOf() };
  }

  /** @param {CanvasRenderingContext2D} pen @param {{left: number, right: number, top: number, bottom: number}} box */
  function axes(pen, box) {
    pen.strokeStyle = colour("--line-strong");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(box.left, box.top);
    pen.lineTo(box.left, box.bottom + 0.5);
    pen.lineTo(box.right, box.bottom + 0.5);
    pen.stroke();
  }

  /** @param {CanvasRenderingContext2D} pen @param {{left: number, right: number}} box @param {number} y @param {string} words */
  function threshold(pen, box, y, words) {
    pen.strokeStyle = colour("--ink");
    pen.setLineDash([4, 3]);
    pen.beginPath();
    pen.moveTo(box.left, y);
    pen.lineTo(box.right, y);
    pen.stroke();
    pen.setLineDash([]);
    pen.fillStyle = colour("--ink");
    pen.textAlign = "right";
    pen.fillText(words, box.left - 4, y + 3.5);
  }

  function drawDots() {
    const { pen, box } = fresh();
    const top = REACH * limit;
    const x = placing(box);
    const y = (/** @type {number} */ value) => box.bottom - (Math.min(value, top) / top) * (box.bottom - box.top);
    axes(pen, box);
    threshold(pen, box, y(limit), text.y);
    const radius = dots.length > 150 ? 1.4 : 2.2;
    dots.forEach((dot, place) => {
      const beyond = !(dot.y <= top);
      const at = beyond ? box.top + 3 : y(dot.y);
      pen.fillStyle = colour(dot.y > limit || Number.isNaN(dot.y) ? "--failed" : "--passed");
      pen.globalAlpha = dot.inside || dot.now ? 1 : 0.38;
      pen.beginPath();
      if (beyond) {
        pen.moveTo(x(place) - 2.5, box.top + 4);
        pen.lineTo(x(place), box.top);
        pen.lineTo(x(place) + 2.5, box.top + 4);
      } else pen.arc(x(place), at, radius, 0, 7);
      pen.fill();
      pen.globalAlpha = 1;
      if (dot.now) ring(pen, x(place), at, "--ink");
      if (place === pointed) ring(pen, x(place), at, "--accent");
    });
    if (pointed !== null && beams) {
      pen.fillStyle = colour("--accent");
      pen.textAlign = "right";
      pen.fillText(beams.say(dots[pointed].x, dots[pointed].y), box.right, box.bottom + 12);
    }
    pen.fillStyle = colour("--muted");
    const labels = /** @type {["left" | "right", number][]} */ ([
      ["left", 0],
      ["right", dots.length - 1],
    ]).slice(0, pointed === null ? 2 : 1);
    for (const [align, place] of labels) {
      pen.textAlign = align;
      if (dots[place]) pen.fillText(String(dots[place].x), x(place), box.bottom + 12);
    }
    pen.textAlign = "right";
    pen.fillText("0", box.left - 4, box.bottom + 3);
  }

  return {
    element,
    measure() {
      size = { width: canvas.clientWidth, height: canvas.clientHeight };
    },
    /** @param {string} why */
    clear(why) {
      point(null);
      dots = [];
      walk?.renew(null);
      canvas.classList.add("blank");
      setText(note, why);
      setText(said, "");
    },
    /** @param {Dot[]} next @param {number} bound @param {string} words */
    set(next, bound, words) {
      const beam = pointed === null ? null : dots[pointed].x;
      [dots, limit] = [next, bound];
      const at = dots.findIndex((dot) => dot.x === beam);
      point(at < 0 ? null : at);
      walk?.renew(pointed);
      setText(note, "");
      canvas.classList.remove("blank");
      setText(said, words);
      drawDots();
    },
    /**
     * Length and count, each in units of what is asked for, so that one dashed line stands for both.
     * @param {{points: number, length: number}[]} steps @param {number} minLength @param {number} minPoints @param {string} words
     */
    set2(steps, minLength, minPoints, words) {
      dots = [];
      setText(note, "");
      canvas.classList.remove("blank");
      setText(said, words);
      const { pen, box } = fresh();
      const lengths = steps.map(({ length }) => length / Math.max(minLength, 1e-9));
      const counts = steps.map(({ points }) => points / Math.max(minPoints, 1));
      const top = Math.max(1.6, Math.min(1.1 * Math.max(...lengths, ...counts), 12));
      const x = (/** @type {number} */ place) =>
        box.left + 6 + (place / Math.max(steps.length - 1, 20)) * (box.right - box.left - 12);
      const y = (/** @type {number} */ value) => box.bottom - (Math.min(value, top) / top) * (box.bottom - box.top);
      axes(pen, box);
      threshold(pen, box, y(1), text.y);
      const last = steps[steps.length - 1];
      const curves = /** @type {const} */ ([
        [lengths, "--accent", `L ${last.length.toFixed(2)} m`],
        [counts, "--good", `P ${last.points}`],
      ]);
      curves.forEach(([values, tone, label], k) => {
        pen.strokeStyle = pen.fillStyle = colour(tone);
        pen.lineWidth = 1.6;
        pen.beginPath();
        values.forEach((value, place) => (place ? pen.lineTo(x(place), y(value)) : pen.moveTo(x(place), y(value))));
        pen.stroke();
        pen.beginPath();
        pen.arc(x(values.length - 1), y(values[values.length - 1]), 2.5, 0, 7);
        pen.fill();
        pen.textAlign = "left";
        pen.fillText(label, box.left + 8 + k * 62, box.bottom + 12);
      });
    },
  };
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {string} tone */
function ring(pen, x, y, tone) {
  pen.strokeStyle = colour(tone);
  pen.beginPath();
  pen.arc(x, y, tone === "--accent" ? 6.5 : 4.5, 0, 7);
  pen.stroke();
}
