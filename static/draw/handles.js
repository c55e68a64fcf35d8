// @ts-check
// Walls, circles and the laser over the plan, with handles for the pointer and the keyboard.
import { svg } from "../widgets/dom.js";
import { inPlan, inWorld } from "./world.js";

/** @typedef {import("./world.js").World} World */
/** @typedef {import("./world.js").Thing} Thing */
/** @typedef {import("./world.js").Point} Point */
/** How a handle changes the numbers of its thing when it moves. @typedef {{thing: Thing, label: string, at: Point, moved: (by: Point) => number[]}} Handle */

const STEP = 0.05;
const SNAP = 0.01;

/**
 * @param {HTMLElement} stage
 * @param {{project: (x: number, y: number) => [number, number] | null, unproject: (left: number, top: number) => [number, number] | null,
 *          onMove: (listener: () => void) => void}} view
 * @param {typeof import("../text/draw.js").drawText.handle} text
 * @param {{onChoose: (thing: Thing) => void, onNumbers: (thing: Thing, numbers: number[], done: boolean) => void,
 *          onRemove: (thing: Thing) => void}} handlers
 *   onNumbers: other numbers for a thing; done: the gesture ends with them
 */
export function createHandles(stage, view, text, { onChoose, onNumbers, onRemove }) {
  const shapes = svg("g", {});
  const knobs = svg("g", {});
  const element = svg("svg", { class: "draw-overlay", role: "group" });
  element.append(shapes, knobs);
  stage.append(element);
  /** @type {World | null} */
  let world = null;
  /** @type {Thing | null} */
  let chosen = null;
  /** The drag under way; its handle stands for the thing as it was. @type {{handle: Handle, from: Point, world: World} | null} */
  let drag = null;
  view.onMove(draw);

  /** @param {World} of @returns {Handle[]} */
  function handlesOf(of) {
    const walls = of.wall.flatMap((wall, index) => {
      const thing = /** @type {Thing} */ ({ kind: "wall", index });
      const [x1, y1, x2, y2] = wall;
      /** @type {Handle[]} */
      const three = [
        { thing, label: text.wallStart(index + 1), at: [x1, y1], moved: ([dx, dy]) => [x1 + dx, y1 + dy, x2, y2] },
        { thing, label: text.wallEnd(index + 1), at: [x2, y2], moved: ([dx, dy]) => [x1, y1, x2 + dx, y2 + dy] },
        {
          thing,
          label: text.wall(index + 1),
          at: [(x1 + x2) / 2, (y1 + y2) / 2],
          moved: ([dx, dy]) => [x1 + dx, y1 + dy, x2 + dx, y2 + dy],
        },
      ];
      return three;
    });
    const circles = of.circle.flatMap(([x, y, radius], index) => {
      const thing = /** @type {Thing} */ ({ kind: "circle", index });
      /** @type {Handle[]} */
      const two = [
        { thing, label: text.circle(index + 1), at: [x, y], moved: ([dx, dy]) => [x + dx, y + dy, radius] },
        {
          thing,
          label: text.radius(index + 1),
          at: [x + radius, y],
          moved: ([dx, dy]) => [x, y, Math.hypot(radius + dx, dy)],
        },
      ];
      return two;
    });
    const [x, y, heading] = of.laser[0];
    /** @type {Handle} */
    const laser = {
      thing: { kind: "laser", index: 0 },
      label: text.laser,
      at: [x, y],
      moved: ([dx, dy]) => [x + dx, y + dy, heading],
    };
    return [...walls, ...circles, laser];
  }

  function draw() {
    element.toggleAttribute("hidden", world === null);
    if (!world) return;
    const shown = world;
    const place = (/** @type {Point} */ point) =>
      view.project(...inPlan(drag?.handle.thing.kind === "laser" ? drag.world : shown, point));
    shapes.replaceChildren();
    for (const [x1, y1, x2, y2] of shown.wall) {
      const [one, other] = [place([x1, y1]), place([x2, y2])];
      if (one && other)
        shapes.append(svg("line", { class: "draw-wall", x1: one[0], y1: one[1], x2: other[0], y2: other[1] }));
    }
    for (const [x, y, radius] of shown.circle) {
      const [centre, edge] = [place([x, y]), place([x + radius, y])];
      if (centre && edge)
        shapes.append(
          svg("circle", {
            class: "draw-wall",
            cx: centre[0],
            cy: centre[1],
            r: Math.hypot(edge[0] - centre[0], edge[1] - centre[1]),
          }),
        );
    }
    const handles = handlesOf(shown);
    while (knobs.children.length > handles.length) knobs.lastElementChild?.remove();
    while (knobs.children.length < handles.length) knobs.append(emptyKnob());
    handles.forEach((handle, k) => {
      const at = place(handle.at);
      const knob = /** @type {SVGElement} */ (knobs.children[k]);
      knob.toggleAttribute("hidden", at === null);
      if (at) {
        knob.setAttribute("cx", String(at[0]));
        knob.setAttribute("cy", String(at[1]));
      }
      knob.setAttribute("aria-label", handle.label);
      knob.classList.toggle("chosen", chosen?.kind === handle.thing.kind && chosen.index === handle.thing.index);
    });
  }

  function emptyKnob() {
    const knob = svg("circle", { class: "draw-handle", r: 6, tabindex: 0, role: "button" });
    const mine = () => handlesOf(/** @type {World} */ (world))[[...knobs.children].indexOf(knob)];
    knob.addEventListener("focus", () => onChoose(mine().thing));
    knob.addEventListener("pointerdown", (event) => {
      const from = pointOf(event);
      if (!world || !from) return;
      event.preventDefault();
      knob.setPointerCapture(event.pointerId);
      knob.focus();
      drag = { handle: mine(), from, world };
    });
    knob.addEventListener("pointermove", (event) => move(event, false));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
      knob.addEventListener(kind, (event) => move(event, true));
    knob.addEventListener("keydown", (event) => {
      const step = event.shiftKey ? 10 * STEP : STEP;
      const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
      const handle = mine();
      if (by) onNumbers(handle.thing, handle.moved(/** @type {Point} */ (by)), true);
      else if (event.key === "Delete" || event.key === "Backspace") onRemove(handle.thing);
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    return knob;
  }

  /** Where the pointer is in the world as it was when the drag began. @param {PointerEvent} event @returns {Point | null} */
  function pointOf(event) {
    const box = element.getBoundingClientRect();
    const at = view.unproject(event.clientX - box.left, event.clientY - box.top);
    const frame = drag?.world ?? world;
    return at && frame ? inWorld(frame, at) : null;
  }

  /** @param {PointerEvent} event @param {boolean} done */
  function move(event, done) {
    if (!drag) return;
    const { handle, from } = drag;
    const at = pointOf(event);
    if (done) drag = null;
    if (!at) return;
    const snapped = /** @type {Point} */ ([at[0] - from[0], at[1] - from[1]].map((by) => Math.round(by / SNAP) * SNAP));
    onNumbers(handle.thing, handle.moved(snapped), done);
  }

  return {
    /** @param {World | null} next null: nothing to edit @param {Thing | null} thing that is chosen */
    set(next, thing) {
      world = next;
      chosen = thing;
      draw();
    },
  };
}
