// @ts-check
// The scene on a 2D canvas: the plan of a Picture, to pan, zoom and pinch. It answers what Stage answers about the plan.
import { h } from "../widgets/dom.js";
import { drawPicture } from "./canvas.js";
import { around, CLOSE, project, towards, unproject, WHOLE } from "./plan.js";
import { placed, placedBox, seenFrom } from "./placed.js";
import { createScale } from "./scale.js";

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

export class CanvasStage {
  hasFree = false;
  element = h("canvas", { class: "scene ready", tabIndex: 0 });
  /** @type {import("./canvas.js").Picture} */ #picture = { palette: [], nodes: [] };
  /** What is shown. @type {Look | null} */ #look = null;
  /** What a fit showed. @type {Look | null} */ #whole = null;
  /** @type {Stretch | null} */ #stretch = null;
  /** The last fit. @type {[Box, Stretch | null, typeof WHOLE] | null} */ #fitted = null;
  #away = true;
  #drawing = 0;
  #square = 0;
  /** Where the laser stands; null: the plan is its own. @type {import("../wire.js").World | null} */ #world = null;
  #riding = false;
  /** A fit to repeat once the stage has a size. @type {(() => void) | null} */ #pending = null;
  /** @type {(() => void)[]} */ #moveListeners = [];
  /** @type {((at: Point | null) => void)[]} */ #hoverListeners = [];
  /** The pointers that are down. @type {Map<number, Point>} */ #pressed = new Map();
  /** How far the pointer went since it was pressed. */ #gone = 0;
  #onPick;
  #scaleMark;

  /**
   * @param {HTMLElement} holder
   * @param {{scene: string, across: (factor: number) => string}} text
   * @param {{onPick: (at: Point, radius: number, shift: boolean) => void}} handlers onPick: a place of the plan was clicked, with a radius around it [m]
   */
  constructor(holder, text, { onPick }) {
    this.#onPick = onPick;
    this.element.setAttribute("aria-label", text.scene);
    this.element.setAttribute("role", "img");
    this.#scaleMark = createScale(text.across);
    holder.append(this.element, this.#scaleMark.element);
    this.#listen();
    new ResizeObserver(() => {
      if (this.#pending) this.#pending();
      else if (this.#fitted && this.look === null) this.#fit(...this.#fitted);
      else this.#moved();
    }).observe(this.element);
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
      if (at) this.#onPick(at, PICK_PX / (this.#sight?.pxPerMetre ?? 1), event.shiftKey);
    });
    element.addEventListener("pointercancel", (event) => this.#pressed.delete(event.pointerId));
    element.addEventListener("pointerleave", () => this.#hover(null));
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
    if (!before) return this.#hover([offsetX, offsetY]);
    const now = /** @type {Point} */ ([offsetX, offsetY]);
    const moved = /** @type {Point} */ ([now[0] - before[0], now[1] - before[1]]);
    this.#gone += Math.hypot(...moved);
    this.#hover(null);
    const others = [...this.#pressed].filter(([id]) => id !== pointerId);
    this.#pressed.set(pointerId, now);
    const scale = this.#sight?.pxPerMetre;
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
    const [sight, look] = [this.#sight, this.#look];
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
    this.#zoom(factor, [this.#size.width / 2, this.#size.height / 2]);
  }

  /** @param {Point | null} at */
  #hover(at) {
    for (const listener of this.#hoverListeners) listener(at);
  }

  get #size() {
    return { width: this.element.clientWidth, height: this.element.clientHeight };
  }

  /** @returns {import("./plan.js").Sight | null} */
  get #sight() {
    const look = this.#look;
    const { width, height } = this.#size;
    if (!look || !width || !height) return null;
    return { x: look.x, y: look.y, pxPerMetre: height / look.span, width, height, stretch: this.#stretch };
  }

  #moved() {
    this.#draw();
    for (const listener of this.#moveListeners) listener();
    this.#scaleMark.set(this.#sight?.pxPerMetre ?? null, this.#stretch, this.#square);
  }

  #draw() {
    if (this.#drawing) return;
    this.#drawing = requestAnimationFrame(() => {
      this.#drawing = 0;
      const sight = this.#sight;
      if (sight) drawPicture(this.element, this.#picture, sight);
    });
  }

  /** @param {import("./canvas.js").Picture} picture */
  show(picture) {
    this.#picture = picture;
    this.#draw();
  }

  /** @param {number} square side of the grid's squares [m] */
  set square(square) {
    if (square === this.#square) return;
    this.#square = square;
    this.#moved();
  }

  /** Shows the whole box. @param {Box} box */
  fit = (box) => this.#fit(box, null, WHOLE);

  /** Shows the box from near by, with its plan stretched. @param {Box} box as drawn @param {Stretch} stretch */
  closeUp(box, stretch) {
    this.#fit(box, stretch.factor === 1 ? null : stretch, CLOSE);
  }

  /** @param {Box} box @param {Stretch | null} stretch @param {typeof WHOLE} room */
  #fit(box, stretch, room) {
    this.#fitted = [box, stretch, room];
    this.#stretch = stretch;
    this.#away = room === WHOLE;
    const size = this.#size;
    this.#pending = size.width && size.height ? null : () => this.#fit(box, stretch, room);
    if (this.#pending) return;
    this.#whole = this.#look = around(box, size, room);
    this.#moved();
  }

  /** Whether the plan is not where the last close-up put it. */
  get moved() {
    return this.#away || this.look !== null;
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

  /** Moves the plan so that the box can be seen well, and zooms in if it is too small. @param {Box} box */
  goTo = (box) => {
    const there = placedBox(this.#world, box);
    const look = there && towards(this.#sight, this.#size, there);
    if (look) this.lookAt(look);
  };

  /** As of the other stage. @param {import("../wire.js").World | null} world @param {boolean} ride */
  place(world, ride) {
    const [before, now, look] = [this.#world?.pose, world?.pose, this.#look];
    this.#world = world;
    const from = this.#riding ? before : look && [look.x, look.y];
    this.#riding = ride && world !== null;
    if (ride && from && now) this.pan(now[0] - from[0], now[1] - from[1]);
  }

  /** Position of a point of the laser on the stage [px]. @param {number} x @param {number} y @returns {Point | null} */
  project = (x, y) => {
    const there = placed(this.#world, [x, y]);
    return there && this.#sight && project(this.#sight, ...there);
  };

  seen = this.project;

  /** The point of the laser at a place on the stage [px]. @param {number} left @param {number} top @returns {Point | null} */
  unproject = (left, top) => this.#sight && seenFrom(this.#world, unproject(this.#sight, left, top));

  /** Passes on a wheel event that an element over the scene received. @param {WheelEvent} event */
  pass = (event) => {
    this.element.dispatchEvent(new WheelEvent("wheel", event));
  };

  /** Moves the plan. @param {number} dx @param {number} dy [m] */
  pan(dx, dy) {
    if (this.#look) this.lookAt({ ...this.#look, x: this.#look.x + dx, y: this.#look.y + dy });
  }

  /** @param {(at: Point | null) => void} listener told where on the stage the pointer is [px]; null: elsewhere, or dragging */
  onHover(listener) {
    this.#hoverListeners.push(listener);
  }

  /** There is the plan alone. */
  setMode() {}

  /** viser needs WebGL. */
  open() {}

  /** @param {() => void} listener called when the view of the scene changed */
  onMove(listener) {
    this.#moveListeners.push(listener);
  }
}
