// @ts-check
// The grid of the plan, below the scene. Its squares are as long as the scale bar, at every zoom.
import { freshCanvas } from "../widgets/canvas.js";
import { colour, onTheme } from "../widgets/colours.js";
import { h } from "../widgets/dom.js";
import { project, unproject } from "./plan.js";

/** @typedef {import("./plan.js").Sight} Sight */

// The widest that a square may be [px].
const SQUARE_PX = 130;

/** @param {HTMLElement} holder */
export function createGrid(holder) {
  const element = h("canvas", { class: "grid", "aria-hidden": "true" });
  holder.append(element);
  /** @type {Sight | null} */
  let shown = null;
  onTheme(draw);

  function draw() {
    element.hidden = shown === null;
    if (shown?.width && shown.height) drawGrid(element, shown);
  }

  return {
    /** @param {Sight | null} sight null: there is no plan, or its grid is hidden */
    draw(sight) {
      shown = sight;
      draw();
    },
  };
}

/** @param {HTMLCanvasElement} canvas @param {Sight} sight */
function drawGrid(canvas, sight) {
  const { pen } = freshCanvas(canvas, sight);
  const square = squareOf(sight.pxPerMetre);
  const corners = [0, sight.width].flatMap((left) => [0, sight.height].map((top) => unproject(sight, left, top)));
  const [xs, ys] = [0, 1].map((k) => corners.map((corner) => corner[k]));
  const [low, high] = [Math.min, Math.max].map((most) => [most(...xs), most(...ys)]);
  for (const k of [0, 1]) {
    for (let number = Math.floor(low[k] / square); number * square <= high[k]; number++) {
      const [from, to] = [low, high].map(({ [1 - k]: along }) =>
        k === 0 ? project(sight, number * square, along) : project(sight, along, number * square),
      );
      pen.strokeStyle = colour(number === 0 ? "--grid-axis" : "--grid");
      pen.lineWidth = Math.max(1, Math.floor(devicePixelRatio)) / (devicePixelRatio || 1);
      pen.beginPath();
      pen.moveTo(...sharp(from));
      pen.lineTo(...sharp(to));
      pen.stroke();
    }
  }
}

/** The middle of a dot of the screen, where a line is not blurred. @param {[number, number]} at @returns {[number, number]} */
function sharp(at) {
  const dots = devicePixelRatio || 1;
  const [left, top] = at.map((px) => (Math.floor(px * dots) + 0.5) / dots);
  return [left, top];
}

/** Side of the squares [m]. @param {number} pxPerMetre */
export function squareOf(pxPerMetre) {
  return niceLength(SQUARE_PX / pxPerMetre);
}

/** The largest of 1, 2, 5 · 10ⁿ that is at most `most`. @param {number} most */
export function niceLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  const factor = most / power >= 5 ? 5 : most / power >= 2 ? 2 : 1;
  return Number((factor * power).toPrecision(1));
}
