// @ts-check
// Draws over the scene, in its coordinates: points, lines, and labels at points. Each shape has a name of its own.
import { svg } from "../widgets/dom.js";

/** @typedef {[number, number]} Point */
/** Of labels that would touch, the first one is drawn. @typedef {{at: Point, text: string}} Label */
/** @typedef {{dots?: Point[], lines?: [Point, Point][], thin?: [Point, Point][], labels?: Label[]}} Shape */
/** project: where a point of the plan is on the stage [px], null if it cannot be seen @typedef {{project: (x: number, y: number) => Point | null, onMove: (listener: () => void) => void}} Seen */

const HEIGHT_PX = 14;
const LETTER_PX = 7;
// From the laser, a label stands behind its point by this.
const AWAY_PX = 12;

/** @param {HTMLElement} stage @param {Seen} view */
export function createOverlay(stage, view) {
  const element = svg("svg", { class: "overlay", "aria-hidden": "true" });
  stage.append(element);
  /** @type {Map<string, Shape>} */
  const shapes = new Map();

  function draw() {
    element.replaceChildren(...[...shapes].map(([name, shape]) => drawn(name, shape, view.project)));
  }
  view.onMove(() => shapes.size && draw());

  return {
    /** @param {string} name */
    has: (name) => shapes.has(name),
    /** @param {string} name @param {Shape | null} shape */
    set(name, shape) {
      if (!shape && !shapes.has(name)) return;
      if (shape) shapes.set(name, shape);
      else shapes.delete(name);
      draw();
    },
  };
}

/** @param {string} name @param {Shape} shape @param {Seen["project"]} project */
function drawn(name, { lines = [], thin = [], dots = [], labels = [] }, project) {
  const group = svg("g", { class: `overlay-shape overlay-${name}` });
  for (const [from, to] of [...lines, ...thin]) {
    const [one, other] = [project(...from), project(...to)];
    if (one && other) group.append(svg("line", { x1: one[0], y1: one[1], x2: other[0], y2: other[1] }));
  }
  for (const line of [...group.children].slice(lines.length)) line.classList.add("thin");
  for (const dot of dots) {
    const at = project(...dot);
    if (at) group.append(svg("circle", { cx: at[0], cy: at[1], r: 8 }));
  }
  group.append(...written(labels, project));
  return group;
}

/** The labels that have room. @param {Label[]} labels @param {Seen["project"]} project */
function written(labels, project) {
  const laser = project(0, 0);
  /** @type {[number, number, number][]} */
  const taken = [];
  /** @type {SVGElement[]} */
  const texts = [];
  for (const { at, text } of labels) {
    const spot = project(...at);
    if (!spot || !laser) continue;
    const far = Math.hypot(spot[0] - laser[0], spot[1] - laser[1]) || 1;
    const [x, y] = [0, 1].map((k) => spot[k] + (AWAY_PX * (spot[k] - laser[k])) / far);
    const half = (LETTER_PX * text.length) / 2 + 2;
    if (taken.some(([tx, ty, th]) => Math.abs(tx - x) < th + half && Math.abs(ty - y) < HEIGHT_PX)) continue;
    taken.push([x, y, half]);
    const label = svg("text", { x, y });
    label.textContent = text;
    texts.push(label);
  }
  return texts;
}
