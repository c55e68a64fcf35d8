// @ts-check
// Walls, circles and the laser over the plan, with handles for the pointer and the keyboard.
import { svg } from "../widgets/dom.js";
import { handlesOf } from "./handles_of.js";
import { inPlan, inWorld } from "./world.js";

/** @typedef {import("./world.js").World} World */
/** @typedef {import("./world.js").Thing} Thing */
/** @typedef {import("./world.js").Point} Point */
/** @typedef {import("./handles_of.js").Handle} Handle */
/** @typedef {{project: (x: number, y: number) => Point | null, unproject: (left: number, top: number) => Point | null,
 *            onMove: (listener: () => void) => void}} PlanView */
/**
 * @typedef {object} Handlers
 * @property {(thing: Thing) => void} onChoose
 * @property {(thing: Thing, numbers: number[], done: boolean) => void} onNumbers new numbers for a thing; done: they end the gesture
 * @property {(thing: Thing) => void} onRemove
 */

const STEP = 0.05;
const SNAP = 0.01;

export class Handles {
  #view;
  #text;
  #handlers;
  /** @type {World | null} */ #world = null;
  /** @type {Thing | null} */ #chosen = null;
  /** The drag under way, with the handle and the world as they were when it began. @type {{handle: Handle, from: Point, world: World} | null} */
  #drag = null;
  #shapes = svg("g");
  #knobs = svg("g");
  #element = svg("svg", { class: "draw-overlay", role: "group" });

  /**
   * @param {HTMLElement} stage
   * @param {PlanView} view
   * @param {typeof import("../text/draw.js").drawText.handle} text
   * @param {Handlers} handlers
   */
  constructor(stage, view, text, handlers) {
    this.#view = view;
    this.#text = text;
    this.#handlers = handlers;
    this.#element.append(this.#shapes, this.#knobs);
    stage.append(this.#element);
    view.onMove(() => this.#draw());
  }

  #draw() {
    const world = this.#world;
    this.#element.toggleAttribute("hidden", world === null);
    if (!world) return;
    const plan = this.#drag?.handle.thing.kind === "laser" ? this.#drag.world : world;
    const place = (/** @type {Point} */ point) => this.#view.project(...inPlan(plan, point));
    this.#shapes.replaceChildren(...shapesOf(world, place));
    const handles = handlesOf(world, this.#text);
    while (this.#knobs.children.length > handles.length) this.#knobs.lastElementChild?.remove();
    while (this.#knobs.children.length < handles.length) this.#knobs.append(this.#createKnob());
    for (const [k, handle] of handles.entries()) this.#drawKnob(this.#knobs.children[k], handle, place(handle.at));
  }

  /** @param {Element} knob @param {Handle} handle @param {Point | null} at */
  #drawKnob(knob, { thing, label }, at) {
    knob.toggleAttribute("hidden", at === null);
    if (at) {
      knob.setAttribute("cx", String(at[0]));
      knob.setAttribute("cy", String(at[1]));
    }
    knob.setAttribute("aria-label", label);
    knob.classList.toggle("chosen", this.#chosen?.kind === thing.kind && this.#chosen.index === thing.index);
  }

  #createKnob() {
    const knob = svg("circle", { class: "draw-handle", r: 6, tabindex: 0, role: "button" });
    const mine = () =>
      handlesOf(/** @type {World} */ (this.#world), this.#text)[[...this.#knobs.children].indexOf(knob)];
    knob.addEventListener("focus", () => this.#handlers.onChoose(mine().thing));
    knob.addEventListener("pointerdown", (event) => {
      const from = this.#pointOf(event);
      if (!this.#world || !from) return;
      event.preventDefault();
      knob.setPointerCapture(event.pointerId);
      knob.focus();
      this.#drag = { handle: mine(), from, world: this.#world };
    });
    knob.addEventListener("pointermove", (event) => this.#move(event, false));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
      knob.addEventListener(kind, (event) => this.#move(event, true));
    knob.addEventListener("keydown", (event) => this.#press(event, mine()));
    return knob;
  }

  /** @param {KeyboardEvent} event @param {Handle} handle */
  #press(event, { thing, moved }) {
    const step = event.shiftKey ? 10 * STEP : STEP;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (by) this.#handlers.onNumbers(thing, moved(/** @type {Point} */ (by)), true);
    else if (event.key === "Delete" || event.key === "Backspace") this.#handlers.onRemove(thing);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Position of the pointer in the world as it was when the drag began. @param {PointerEvent} event @returns {Point | null} */
  #pointOf(event) {
    const box = this.#element.getBoundingClientRect();
    const at = this.#view.unproject(event.clientX - box.left, event.clientY - box.top);
    const frame = this.#drag?.world ?? this.#world;
    return at && frame ? inWorld(frame, at) : null;
  }

  /** @param {PointerEvent} event @param {boolean} done */
  #move(event, done) {
    if (!this.#drag) return;
    const { handle, from } = this.#drag;
    const at = this.#pointOf(event);
    if (done) this.#drag = null;
    if (!at) return;
    const by = /** @type {Point} */ ([at[0] - from[0], at[1] - from[1]].map((each) => Math.round(each / SNAP) * SNAP));
    this.#handlers.onNumbers(handle.thing, handle.moved(by), done);
  }

  /** @param {World | null} world null: nothing to edit @param {Thing | null} chosen */
  set(world, chosen) {
    this.#world = world;
    this.#chosen = chosen;
    this.#draw();
  }
}

/** @param {World} world @param {(point: Point) => Point | null} place @returns {SVGElement[]} */
function shapesOf(world, place) {
  const walls = world.wall.flatMap(([x1, y1, x2, y2]) => {
    const [one, other] = [place([x1, y1]), place([x2, y2])];
    if (!one || !other) return [];
    return [svg("line", { class: "draw-wall", x1: one[0], y1: one[1], x2: other[0], y2: other[1] })];
  });
  const circles = world.circle.flatMap(([x, y, radius]) => {
    const [centre, edge] = [place([x, y]), place([x + radius, y])];
    if (!centre || !edge) return [];
    const r = Math.hypot(edge[0] - centre[0], edge[1] - centre[1]);
    return [svg("circle", { class: "draw-wall", cx: centre[0], cy: centre[1], r })];
  });
  return [...walls, ...circles];
}
