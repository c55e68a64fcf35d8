// @ts-check
// Points that can be dragged, with the line of least squares across itself and the one of vertical least squares.
import { h, setText, svg } from "../../widgets/dom.js";

/** @typedef {typeof import("../../text/shown.js").shownText.fits} Text */
/** @typedef {[number, number]} Point in metres, y upwards */

const [WIDTH, HEIGHT] = [400, 210];
/** Pixels of a metre. */
const SCALE = 80;
const [STEP, TURN] = [0.05, 30];
/** Points on a wall: how far along it, and how far beside it [m]. @type {Point[]} */
const WALL = [
  [-1.1, 0.1],
  [-0.8, -0.16],
  [-0.5, 0.12],
  [-0.2, 0.2],
  [0.1, -0.18],
  [0.4, -0.14],
  [0.7, 0.2],
  [1.0, -0.14],
];

/** @param {Text} text */
export function createFits(text) {
  // Through a level wall, both lines are the same.
  let angle = TURN;
  /** @type {Point[]} */
  let points = turned(angle);
  const picture = svg("svg", { class: "fits", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "group" });
  picture.setAttribute("aria-label", text.label);
  const lines = svg("g");
  const dots = WALL.map((_, k) => {
    const dot = svg("circle", { class: "fits-point", r: 6, tabindex: 0, role: "button" });
    dot.setAttribute("aria-label", text.point(k + 1));
    dragging(/** @type {SVGSVGElement} */ (picture), dot, (at) => move(k, at));
    dot.addEventListener("keydown", (event) => {
      const by = steps[/** @type {KeyboardEvent} */ (event).key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      move(k, [points[k][0] + by[0], points[k][1] + by[1]]);
    });
    return dot;
  });
  picture.append(lines, ...dots);
  const says = h("p", { class: "fits-says", role: "status" });
  const turn = h("button", { type: "button", class: "button" }, text.turn);
  turn.addEventListener("click", () => {
    angle = (angle + TURN) % 180;
    points = turned(angle);
    draw();
  });

  /** @param {number} k @param {Point} at */
  function move(k, [x, y]) {
    const [most, high] = [WIDTH / 2 / SCALE - 0.1, HEIGHT / 2 / SCALE - 0.1];
    points[k] = [Math.min(Math.max(x, -most), most), Math.min(Math.max(y, -high), high)];
    draw();
  }

  function draw() {
    const [across, upright] = [orthogonal(points), vertical(points)];
    lines.replaceChildren(
      ...points.flatMap((point) => [residual(point, across), ...(upright ? [drop(point, upright)] : [])]),
      ...[upright && lineOf(upright, "fits-vertical"), lineOf(across, "fits-across")].filter((each) => each !== null),
    );
    dots.forEach((dot, k) => {
      const [x, y] = onPicture(points[k]);
      dot.setAttribute("cx", String(x));
      dot.setAttribute("cy", String(y));
    });
    setText(says, text.sums(rms(points, across), upright ? rms(points, upright) : null));
  }

  draw();
  const key = h(
    "p",
    { class: "fits-key" },
    h("span", { class: "fits-key-across" }, text.across),
    h("span", { class: "fits-key-vertical" }, text.vertical),
  );
  const element = h("div", { class: "shown-fits" }, /** @type {any} */ (picture), key, says, turn);
  return { element };
}

/** @type {Record<string, Point>} */
const steps = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] };

/** The wall at an angle. @param {number} degrees @returns {Point[]} */
function turned(degrees) {
  const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return WALL.map(([along, beside]) => [along * cos - beside * sin, along * sin + beside * cos]);
}

/** a, b, c of the line that minimises the squared distances across it (Eq. 2). @param {Point[]} points @returns {[number, number, number]} */
export function orthogonal(points) {
  const { mx, my, xx, xy, yy } = moments(points);
  const angle = 0.5 * Math.atan2(2 * xy, xx - yy) + Math.PI / 2;
  const [a, b] = [Math.cos(angle), Math.sin(angle)];
  return [a, b, -(a * mx + b * my)];
}

/** The line that minimises the squared vertical distances; null if it would be upright. @param {Point[]} points @returns {[number, number, number] | null} */
export function vertical(points) {
  const { mx, my, xx, xy } = moments(points);
  if (xx < 1e-9) return null;
  const slope = xy / xx;
  const length = Math.hypot(slope, 1);
  return [slope / length, -1 / length, (my - slope * mx) / length];
}

/** @param {Point[]} points */
function moments(points) {
  const n = points.length;
  const [mx, my] = [0, 1].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / n);
  const sum = (/** @type {(dx: number, dy: number) => number} */ of) =>
    points.reduce((total, [x, y]) => total + of(x - mx, y - my), 0);
  return { mx, my, xx: sum((dx) => dx * dx), xy: sum((dx, dy) => dx * dy), yy: sum((_, dy) => dy * dy) };
}

/** Root mean square distance across the line [m]. @param {Point[]} points @param {[number, number, number]} line */
function rms(points, [a, b, c]) {
  return Math.sqrt(points.reduce((sum, [x, y]) => sum + (a * x + b * y + c) ** 2, 0) / points.length);
}

/** @param {Point} point @returns {Point} */
function onPicture([x, y]) {
  return [WIDTH / 2 + SCALE * x, HEIGHT / 2 - SCALE * y];
}

/** @param {Point} from @param {Point} to @param {string} name */
function stroke(from, to, name) {
  const [[x1, y1], [x2, y2]] = [onPicture(from), onPicture(to)];
  return svg("line", { class: name, x1, y1, x2, y2 });
}

/** @param {[number, number, number]} line @param {string} name */
function lineOf([a, b, c], name) {
  const far = 4;
  return stroke([-a * c - b * far, -b * c + a * far], [-a * c + b * far, -b * c - a * far], name);
}

/** The distance of a point across a line. @param {Point} point @param {[number, number, number]} line */
function residual([x, y], [a, b, c]) {
  const d = a * x + b * y + c;
  return stroke([x, y], [x - a * d, y - b * d], "fits-residual across");
}

/** The vertical distance of a point from a line. @param {Point} point @param {[number, number, number]} line */
function drop([x, y], [a, b, c]) {
  return stroke([x, y], [x, -(a * x + c) / b], "fits-residual");
}

/** @param {SVGSVGElement} picture @param {SVGElement} dot @param {(at: Point) => void} onMove */
function dragging(picture, dot, onMove) {
  dot.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    /** @type {any} */ (dot).focus();
    dot.setPointerCapture(event.pointerId);
  });
  dot.addEventListener("pointermove", (event) => {
    if (!dot.hasPointerCapture(event.pointerId)) return;
    const box = picture.getBoundingClientRect();
    const scale = WIDTH / box.width;
    onMove([
      ((event.clientX - box.left) * scale - WIDTH / 2) / SCALE,
      (HEIGHT / 2 - (event.clientY - box.top) * scale) / SCALE,
    ]);
  });
}
