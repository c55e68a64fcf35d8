// @ts-check
// What both kinds of stage have in common: where things of the plan are on the stage, and who is told that it moved.
import { around, CLOSE, project, towards, unproject, WHOLE } from "./plan.js";
import { placed, placedBox, seenFrom } from "./placed.js";
import { createGrid } from "./grid.js";
import { createScale } from "./scale.js";

/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("../view/store.js").Look} Look */
/** @typedef {import("./viser.js").Stretch} Stretch */
/** @typedef {[number, number]} Point */

// Between a card and the nearest part of the plan.
const BESIDE_PX = 12;

export class PlanStage {
  element;
  /** How the plan is drawn. @type {Stretch | null} */
  stretch = null;
  /** The last fit. @type {[Box, Stretch | null, typeof WHOLE] | null} */
  fitted = null;
  /** Whether the plan is no longer where a close-up put it. */
  away = true;
  #gridded = true;
  /** Where the laser stands; null: the plan is its own. @type {import("../wire.js").World | null} */
  #world = null;
  #riding = false;
  /** @type {(() => void)[]} */
  #moveListeners = [];
  /** @type {((at: Point | null) => void)[]} */
  #hoverListeners = [];
  /** What may lie over the upper part of the scene. @type {HTMLElement[]} */
  #covers = [];
  #scaleMark;
  #grid;

  /** @param {HTMLElement} holder @param {HTMLElement} element that shows the scene @param {(factor: number) => string} across words of the scale */
  constructor(holder, element, across) {
    this.element = element;
    this.#scaleMark = createScale(across);
    this.#grid = createGrid(holder);
    holder.append(element, this.#scaleMark.element);
  }

  /** The plan as it is seen, if it is. @returns {import("./plan.js").Sight | null} */
  get sight() {
    return null;
  }

  /** The middle of the plan on the stage [m], if there is one. @returns {Point | null} */
  get middle() {
    return null;
  }

  /** The visible part of the plan, if a person has moved it. @returns {Look | null} */
  get look() {
    return null;
  }

  /** @param {Look} _look */
  lookAt(_look) {}

  /** Moves the plan. @param {number} _dx @param {number} _dy [m] */
  pan(_dx, _dy) {}

  /** @param {Box} box @param {Stretch | null} stretch @param {typeof WHOLE} room */
  showBox(box, stretch, room) {
    this.fitted = [box, stretch, room];
    this.stretch = stretch;
    this.away = room === WHOLE;
  }

  /** Fits keep clear of these, too, which lie over the upper part of the scene. @param {HTMLElement[]} cards */
  keepClearOf(cards) {
    this.#covers.push(...cards);
    const observer = new ResizeObserver(() => this.refit());
    for (const card of cards) observer.observe(card);
  }

  /** The places of those that are there. @returns {import("./plan.js").Cover[]} */
  get #covered() {
    const stage = this.element.getBoundingClientRect();
    return this.#covers
      .map((card) => card.getBoundingClientRect())
      .filter(({ height }) => height > 0)
      .map(({ left, right, bottom }) => ({
        left: left - stage.left - BESIDE_PX,
        right: right - stage.left + BESIDE_PX,
        bottom: bottom - stage.top + BESIDE_PX,
      }));
  }

  /** Where to look to see all of a box. @param {Box} box @param {typeof WHOLE} room */
  around(box, room) {
    return around(box, this.size, room, this.#covered);
  }

  /** Fits again what was fitted, unless a person has moved the camera since. */
  refit() {
    if (this.sight && this.fitted && this.look === null && this.element.clientHeight) this.showBox(...this.fitted);
  }

  get size() {
    return { width: this.element.clientWidth, height: this.element.clientHeight };
  }

  /** Whether the plan is not where the last close-up put it. */
  get moved() {
    return this.away || this.look !== null;
  }

  /** @param {boolean} shown whether the plan has a grid */
  set gridded(shown) {
    if (shown === this.#gridded) return;
    this.#gridded = shown;
    this.#drawMarks();
  }

  /** Shows the whole box. @param {Box} box */
  fit = (box) => this.showBox(box, null, WHOLE);

  /** Shows the box from near by, with its plan stretched. @param {Box} box as drawn @param {Stretch} stretch */
  closeUp(box, stretch) {
    this.showBox(box, stretch.factor === 1 ? null : stretch, CLOSE);
  }

  /** Moves the plan so that the box of the laser can be seen well, and zooms in if it is too small. @param {Box} box */
  goTo = (box) => {
    const there = placedBox(this.#world, box);
    const look = there && towards(this.sight, this.size, there, this.#covered);
    if (look) this.lookAt(look);
  };

  /** Places the laser in the world; ride: whether the plan moves along. @param {import("../wire.js").World | null} world @param {boolean} ride */
  place(world, ride) {
    const [before, now] = [this.#world?.pose, world?.pose];
    const stays = !world && !this.#world;
    this.#world = world;
    if (stays) return;
    // Whoever begins to ride is taken to the robot.
    const from = this.#riding ? before : this.middle;
    this.#riding = ride && world !== null;
    if (ride && from && now) this.pan(now[0] - from[0], now[1] - from[1]);
    this.tellMoved();
  }

  /** A point of the laser where it is in the plan; null if that is unknown. @param {Point} at @returns {Point | null} */
  placed(at) {
    return placed(this.#world, at);
  }

  /** Position of a point of the laser on the stage [px]; null in a free view. @param {number} x @param {number} y @returns {Point | null} */
  project = (x, y) => {
    const there = this.placed([x, y]);
    return there && this.sight && project(this.sight, ...there);
  };

  /** The same in any view; null if the point cannot be seen. @param {number} x @param {number} y @returns {Point | null} */
  seen = (x, y) => this.project(x, y);

  /** The point of the laser at a place on the stage [px]; null in a free view. @param {number} left @param {number} top @returns {Point | null} */
  unproject = (left, top) => this.sight && seenFrom(this.#world, unproject(this.sight, left, top));

  /** @param {(at: Point | null) => void} listener told where on the stage the pointer is [px]; null: elsewhere, or dragging */
  onHover(listener) {
    this.#hoverListeners.push(listener);
  }

  /** @param {() => void} listener called when the view of the scene changed */
  onMove(listener) {
    this.#moveListeners.push(listener);
  }

  /** @param {Point | null} at */
  hover(at) {
    for (const listener of this.#hoverListeners) listener(at);
  }

  tellMoved() {
    for (const listener of this.#moveListeners) listener();
    this.#drawMarks();
  }

  /** Draws grid and scale. */
  #drawMarks() {
    const sight = this.sight;
    this.#grid.draw(this.#gridded ? sight : null);
    this.#scaleMark.set(sight?.pxPerMetre ?? null, this.stretch);
  }
}
