// @ts-check
// A strip under the scrubber that shows what happens where in a trace: phases as bands, events as ticks.
import { freshCanvas } from "../widgets/canvas.js";
import { colour, onTheme } from "../widgets/colours.js";

/** @typedef {import("./trace.js").Trace} Trace */

const HEIGHT = 14;
const TICKS = /** @type {const} */ ([
  ["refusal", "--failed", 0.45],
  ["drop", "--failed", 1],
  ["seed", "--accent", 0.7],
  ["line", "--good", 1],
  ["merge", "--ink", 1],
  ["cut", "--ink", 1],
]);

export function createMarks() {
  const canvas = document.createElement("canvas");
  canvas.className = "marks";
  canvas.setAttribute("aria-hidden", "true");
  /** @type {Trace | null} */
  let trace = null;
  /** @type {{from: number, to: number | null} | null} */
  let loop = null;

  function draw() {
    const width = canvas.clientWidth;
    if (!width) return;
    const { pen } = freshCanvas(canvas, { width, height: HEIGHT });
    if (!trace?.length) return;
    // The thumb of a range input stays within its track.
    const room = width - 14;
    const x = (/** @type {number} */ index) =>
      7 + (index / Math.max(1, /** @type {Trace} */ (trace).length - 1)) * room;
    if (loop) {
      pen.fillStyle = colour("--accent-soft");
      pen.fillRect(x(loop.from) - 1, 0, Math.max(2, x(loop.to ?? loop.from) - x(loop.from) + 2), HEIGHT);
    }
    for (const [name, tone, tall] of TICKS) {
      pen.fillStyle = colour(tone);
      for (const index of trace.marks[name]) pen.fillRect(x(index) - 0.6, HEIGHT * (1 - tall), 1.2, HEIGHT * tall);
    }
  }

  new ResizeObserver(draw).observe(canvas);
  onTheme(draw);
  return {
    element: canvas,
    /** @param {Trace | null} next */
    set(next) {
      trace = next;
      draw();
    },
    /** @param {{from: number, to: number | null} | null} range */
    setLoop(range) {
      loop = range;
      draw();
    },
  };
}
