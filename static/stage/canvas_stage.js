// @ts-check
// The scene on a 2D canvas: the plan of a Picture, to pan, zoom and pinch. It answers what Stage answers about the plan.
import { h } from "../widgets/dom.js";
import { drawPicture } from "./canvas.js";
import { PlanStage } from "./plan_stage.js";

/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("../view/store.js").Look} Look */
/** @typedef {import("./viser.js").Stretch} Stretch */
/** @typedef {[number, number]} Point */

// The smallest height that the stage may show [m].
const LEAST_SPAN = 0.035;
const MOST_SPAN = 20_000;
const WHEEL = 0.0015;
const LINE_PX = 30;
// A press that moves no farther is a click.
const CLICK_PX = 4;
// How near to a point a click must be.
const PICK_PX = 20;

export class CanvasStage extends PlanStage {
  hasFree = false;
  /** @type {import("./canvas.js").Picture} */ #picture = { palette: [], nodes: [] };
  /** What is shown. @type {Look | null} */ #look = null;
  /** What a fit showed. @type {Look | null} */ #whole = null;
  #drawing = 0;
  /** A fit to repeat once the stage has a size. @type {(() => void) | null} */ #pending = null;
  /** The pointers that are down. @type {Map<number, Point>} */ #pressed = new Map();
  /** How far the pointer went since it was pressed. */ #gone = 0;
  #onPick;
  #canvas;

  /**
   * @param {HTMLElement} holder
   * @param {{scene: string, across: (factor: number) => string}} text
   * @param {{onPick: (at: Point, radius: number, shift: boolean) => void}} handlers onPick: a place of the plan was clicked, with a radius around it [m]
   */
  constructor(holder, text, { onPick }) {
    const canvas = h("canvas", { class: "scene ready", tabIndex: 0 });
    super(holder, canvas, text.across);
    this.#canvas = canvas;
    this.#onPick = onPick;
    canvas.setAttribute("aria-label", text.scene);
    canvas.setAttribute("role", "img");
    this.#listen();
    new ResizeObserver(() => {
      if (this.#pending) this.#pending();
      else {
        this.refit();
        this.#moved();
      }
    }).observe(canvas);
  }

  #listen() {
    const { element } = this;
    element.addEventListener("pointerdown", (event) => {
      element.setPointerCapture(event.pointerId);
      if (!this.#pressed.size) this.#gone = 0;
      this.#pressed.set(event.pointerId, [event.offsetX, event.offsetY]);
    });
    element.addEventListener("pointermove", (event) => this.#drag(event));
    element.addEventListener("pointerup", (event) => {
      const alone = this.#pressed.size === 1;
      if (!this.#pressed.delete(event.pointerId) || !alone || this.#gone > CLICK_PX || event.button > 0) return;
      const at = this.unproject(event.offsetX, event.offsetY);
      if (at) this.#onPick(at, PICK_PX / (this.sight?.pxPerMetre ?? 1), event.shiftKey);
    });
    element.addEventListener("pointercancel", (event) => this.#pressed.delete(event.pointerId));
    element.addEventListener("pointerleave", () => this.hover(null));
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const px = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1);
        this.#zoom(Math.exp(px * WHEEL), [event.offsetX, event.offsetY]);
      },
      { passive: false },
    );
  }

  /** @param {PointerEvent} event */
  #drag({ pointerId, offsetX, offsetY }) {
    const before = this.#pressed.get(pointerId);
    if (!before) return this.hover([offsetX, offsetY]);
    const now = /** @type {Point} */ ([offsetX, offsetY]);
    const moved = /** @type {Point} */ ([now[0] - before[0], now[1] - before[1]]);
    this.#gone += Math.hypot(...moved);
    this.hover(null);
    const others = [...this.#pressed].filter(([id]) => id !== pointerId);
    this.#pressed.set(pointerId, now);
    const scale = this.sight?.pxPerMetre;
    if (!scale || others.length > 1) return undefined;
    const [, other] = others[0] ?? [0, null];
    // Each of two fingers moves the plan by half of its own way.
    const share = other ? 0.5 : 1;
    this.pan((-share * moved[0]) / scale, (share * moved[1]) / scale);
    if (!other) return undefined;
    const [was, is] = [before, now].map(([x, y]) => Math.hypot(x - other[0], y - other[1]));
    if (is > 1) this.#zoom(was / is, [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2]);
    return undefined;
  }

  /** Shows `factor` times as much, around a place of the stage. @param {number} factor @param {Point} at [px] */
  #zoom(factor, [left, top]) {
    const [sight, look] = [this.sight, this.#look];
    if (!sight || !look) return;
    const span = Math.min(Math.max(look.span * factor, LEAST_SPAN), MOST_SPAN);
    const less = (1 - span / look.span) / sight.pxPerMetre;
    this.#look = {
      x: look.x + (left - sight.width / 2) * less,
      y: look.y - (top - sight.height / 2) * less,
      span,
    };
    this.#moved();
  }

  /** Zooms around the middle. @param {number} factor */
  zoom(factor) {
    this.#zoom(factor, [this.size.width / 2, this.size.height / 2]);
  }

  /** @returns {import("./plan.js").Sight | null} */
  get sight() {
    const look = this.#look;
    const { width, height } = this.size;
    if (!look || !width || !height) return null;
    return { x: look.x, y: look.y, pxPerMetre: height / look.span, width, height, stretch: this.stretch };
  }

  #moved() {
    this.#draw();
    this.tellMoved();
  }

  #draw() {
    if (this.#drawing) return;
    this.#drawing = requestAnimationFrame(() => {
      this.#drawing = 0;
      const sight = this.sight;
      if (sight) drawPicture(this.#canvas, this.#picture, sight);
    });
  }

  /** @param {import("./canvas.js").Picture} picture */
  show(picture) {
    this.#picture = picture;
    this.#draw();
  }

  /** @type {PlanStage["showBox"]} */
  showBox(box, stretch, room) {
    super.showBox(box, stretch, room);
    const size = this.size;
    this.#pending = size.width && size.height ? null : () => this.showBox(box, stretch, room);
    if (this.#pending) return;
    this.#whole = this.#look = this.around(box, room);
    this.#moved();
  }

  /** The visible part of the plan, if a person has moved it. @returns {Look | null} */
  get look() {
    return this.#look === this.#whole ? null : this.#look;
  }

  /** @param {Look} look */
  lookAt(look) {
    this.#pending = null;
    this.#look = look;
    this.#moved();
  }

  /** @returns {Point | null} */
  get middle() {
    return this.#look && [this.#look.x, this.#look.y];
  }

  /** Passes on a wheel event that an element over the scene received. @param {WheelEvent} event */
  pass = (event) => {
    this.element.dispatchEvent(new WheelEvent("wheel", event));
  };

  /** Moves the plan. @param {number} dx @param {number} dy [m] */
  pan(dx, dy) {
    if (this.#look) this.lookAt({ ...this.#look, x: this.#look.x + dx, y: this.#look.y + dy });
  }

  /** There is the plan alone. */
  setMode() {}

  /** viser needs WebGL. */
  open() {}
}
