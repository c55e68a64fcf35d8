// @ts-check
// Draws a Picture on a 2D canvas, as viser draws it in space: sizes and widths are those of the screen at any zoom.
import { freshCanvas } from "../widgets/canvas.js";
import { project } from "./plan.js";

/** @typedef {import("./plan.js").Sight} Sight */
/**
 * One kind of thing in a Picture. xy: of points x, y, …; of lines x1, y1, x2, y2, … [m]. tones: the colour of each, a
 * number of the palette.
 * @typedef {import("../wire.js").Look & {xy: ArrayLike<number>, tones: ArrayLike<number>}} Node
 */
/** Nodes in the order in which they are drawn. @typedef {{palette: string[], nodes: Node[]}} Picture */

/** @param {HTMLCanvasElement} canvas @param {Picture} picture @param {Sight} sight */
export function drawPicture(canvas, { palette, nodes }, sight) {
  const { pen } = freshCanvas(canvas, sight);
  // The plan is drawn by one affine map: its columns, and where the laser is.
  const [x0, y0] = project(sight, 0, 0);
  const [right, up] = [project(sight, 1, 0), project(sight, 0, 1)];
  const map = { ax: right[0] - x0, ay: right[1] - y0, bx: up[0] - x0, by: up[1] - y0, x0, y0 };
  for (const node of nodes) (node.kind === "lines" ? drawLines : drawPoints)(pen, node, palette, map);
}

/** @typedef {{ax: number, ay: number, bx: number, by: number, x0: number, y0: number}} Affine */

/** @param {CanvasRenderingContext2D} pen @param {Node} node @param {string[]} palette @param {Affine} map */
function drawLines(pen, { px, xy, tones }, palette, { ax, ay, bx, by, x0, y0 }) {
  pen.lineWidth = px;
  for (let k = 0; k < tones.length; ) {
    const tone = tones[k];
    pen.strokeStyle = palette[tone];
    pen.beginPath();
    for (; k < tones.length && tones[k] === tone; k++) {
      const [x1, y1, x2, y2] = [xy[4 * k], xy[4 * k + 1], xy[4 * k + 2], xy[4 * k + 3]];
      pen.moveTo(x0 + ax * x1 + bx * y1, y0 + ay * x1 + by * y1);
      pen.lineTo(x0 + ax * x2 + bx * y2, y0 + ay * x2 + by * y2);
    }
    pen.stroke();
  }
}

/** @param {CanvasRenderingContext2D} pen @param {Node} node @param {string[]} palette @param {Affine} map */
function drawPoints(pen, { px, shape, xy, tones }, palette, { ax, ay, bx, by, x0, y0 }) {
  for (let k = 0; k < tones.length; ) {
    const tone = tones[k];
    pen.fillStyle = palette[tone];
    pen.beginPath();
    for (; k < tones.length && tones[k] === tone; k++) {
      const [x, y] = [xy[2 * k], xy[2 * k + 1]];
      outline[shape || "circle"](pen, x0 + ax * x + bx * y, y0 + ay * x + by * y, px);
    }
    pen.fill();
  }
}

/** @type {Record<"circle" | "square" | "diamond", (pen: CanvasRenderingContext2D, x: number, y: number, px: number) => void>} */
const outline = {
  circle: (pen, x, y, px) => {
    pen.moveTo(x + px, y);
    pen.arc(x, y, px, 0, 7);
  },
  square: (pen, x, y, px) => pen.rect(x - px, y - px, 2 * px, 2 * px),
  diamond: (pen, x, y, px) => {
    pen.moveTo(x + px, y);
    pen.lineTo(x, y + px);
    pen.lineTo(x - px, y);
    pen.lineTo(x, y - px);
    pen.closePath();
  },
};
