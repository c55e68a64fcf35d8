// @ts-check
// The editor of a world: its card, its undo, and the recording, whose id is the text of the world.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { Fields } from "./fields.js";
import { Handles } from "./handles.js";
import { Past } from "./past.js";
import { idOf, inPlan, inWorld, MOST_CIRCLES, MOST_WALLS, withNumbers, without, worldOf } from "./world.js";

/** @typedef {import("./world.js").World} World */
/** @typedef {import("./world.js").Thing} Thing */
/** @typedef {import("./world.js").Point} Point */
/** @typedef {typeof import("../text/draw.js").drawText} Text */
/** @typedef {import("./handles.js").PlanView & {element: HTMLElement, pan: (dx: number, dy: number) => void}} PlanView */
/** @typedef {{onRecording: (id: string) => void, onSave: () => void}} Handlers */

const LASER = /** @type {Thing} */ ({ kind: "laser", index: 0 });
const BEAMS = /** @type {Thing} */ ({ kind: "beams", index: 0 });

/** @param {HTMLElement} stage @param {PlanView} view @param {Text} text @param {Handlers} handlers */
export function createDraw(stage, view, text, handlers) {
  return new Draw(stage, view, text, handlers);
}

class Draw {
  #view;
  #text;
  #onRecording;
  /** @type {World | null} */ #world = null;
  #chosen = LASER;
  #past = new Past();
  #handles;
  #undo;
  #redo;
  #remove;
  #place;
  #beams;
  #message;

  /** @param {HTMLElement} stage @param {PlanView} view @param {Text} text @param {Handlers} handlers */
  constructor(stage, view, text, { onRecording, onSave }) {
    this.#view = view;
    this.#text = text;
    this.#onRecording = onRecording;
    this.#handles = new Handles(stage, view, text.handle, {
      onChoose: (thing) => this.#choose(thing),
      onNumbers: (thing, numbers, done) => this.#drag(thing, numbers, done),
      onRemove: (thing) => this.#removeThing(thing),
    });
    const button = (/** @type {string} */ label, /** @type {() => void} */ run, help = "") =>
      h("button", { type: "button", class: "button", title: help, onclick: run }, label);
    this.#undo = iconButton("undo", text.undo, () => this.undo());
    this.#redo = iconButton("redo", text.redo, () => this.redo());
    this.#remove = button(text.remove, () => this.#removeThing(this.#chosen), text.remove);
    this.#place = new Fields(text, (k, value) => this.#type(this.#chosen, k, value));
    this.#beams = new Fields(text, (k, value) => this.#type(BEAMS, k, value));
    this.#message = h("p", { class: "hint", role: "status" }, text.hint);
    const [wall, circle] = [
      button(text.addWall, () => this.#addWall()),
      button(text.addCircle, () => this.#addCircle()),
    ];
    const another = button(text.another, () => this.#another(), text.anotherHelp);
    this.card = h(
      "section",
      { class: "draw-card", "aria-label": text.label, hidden: true },
      h("div", { class: "draw-row" }, wall, circle, h("span", { class: "spacer" }), this.#undo, this.#redo),
      this.#place.element,
      h("h3", {}, text.beams),
      this.#beams.element,
      h("div", { class: "draw-row" }, this.#remove, another, button(text.save, onSave, text.saveHelp)),
      this.#message,
    );
  }

  get active() {
    return this.#world !== null;
  }

  /** @param {Thing} thing */
  #choose(thing) {
    this.#chosen = thing;
    this.#show();
  }

  /** Shows the new numbers of the thing that is being dragged. @param {Thing} thing @param {number[]} numbers @param {boolean} done */
  #drag(thing, numbers, done) {
    if (!this.#world) return;
    const next = withNumbers(this.#world, thing, numbers);
    this.#past.begin(idOf(this.#world));
    if (thing.kind === "laser" && !done) {
      // The plan is the frame of the laser, so it would turn and move during the drag. It follows at the end of the drag.
      this.#handles.set(next, this.#chosen);
      return;
    }
    if (thing.kind === "laser") this.#follow(this.#world, next);
    this.#set(next);
    if (done) this.#remember(next);
  }

  /** Keeps the world in its place on the screen when the laser moves in it. @param {World} from @param {World} to */
  #follow(from, to) {
    const [x, y] = inPlan(from, /** @type {Point} */ (to.laser[0].slice(0, 2)));
    this.#view.pan(-x, -y);
  }

  /** @param {World} world */
  #set(world) {
    this.#world = world;
    this.#show();
    this.#onRecording(idOf(world));
  }

  /** @param {World} world */
  #remember(world) {
    this.#past.end(idOf(world));
    this.#show();
  }

  /** @param {World} next a change that is a gesture of its own */
  #commit(next) {
    if (!this.#world) return;
    this.#past.begin(idOf(this.#world));
    this.#set(next);
    this.#remember(next);
  }

  /** A number of a thing was typed. @param {Thing} thing @param {number} k @param {number} value */
  #type(thing, k, value) {
    if (!this.#world) return;
    const next = withNumbers(this.#world, thing, this.#world[thing.kind][thing.index].with(k, value));
    if (thing.kind === "laser") this.#follow(this.#world, next);
    this.#commit(next);
  }

  /** @param {Thing} thing */
  #removeThing(thing) {
    if (!this.#world || (thing.kind !== "wall" && thing.kind !== "circle")) return;
    const index = Math.min(thing.index, this.#world[thing.kind].length - 2);
    this.#chosen = index < 0 ? LASER : { kind: thing.kind, index };
    this.#commit(without(this.#world, thing));
  }

  /** The middle of the visible plan. @param {World} world @returns {Point} */
  #middle(world) {
    const { clientWidth, clientHeight } = this.#view.element;
    const at = this.#view.unproject(clientWidth / 2, clientHeight / 2);
    return at ? inWorld(world, at) : [1, 0];
  }

  #addWall() {
    const world = this.#world;
    if (!world || world.wall.length >= MOST_WALLS) return this.#full();
    const [x, y] = this.#middle(world);
    this.#chosen = { kind: "wall", index: world.wall.length };
    return this.#commit({ ...world, wall: [...world.wall, [x - 1, y + 1, x + 1, y + 1]] });
  }

  #addCircle() {
    const world = this.#world;
    if (!world || world.circle.length >= MOST_CIRCLES) return this.#full();
    const [x, y] = this.#middle(world);
    this.#chosen = { kind: "circle", index: world.circle.length };
    return this.#commit({ ...world, circle: [...world.circle, [x, y + 1, 0.4]] });
  }

  #full() {
    setText(this.#message, this.#text.full(MOST_WALLS, MOST_CIRCLES));
  }

  /** The same world with new noise. */
  #another() {
    if (this.#world) this.#commit({ ...this.#world, seed: this.#world.seed + 1 });
  }

  undo() {
    if (this.#world) this.#travel(this.#world, this.#past.undo(idOf(this.#world)));
  }

  redo() {
    if (this.#world) this.#travel(this.#world, this.#past.redo(idOf(this.#world)));
  }

  /** @param {World} from @param {string | null} id */
  #travel(from, id) {
    const to = id === null ? null : worldOf(id);
    if (!to) return;
    if (to.laser[0].join() !== from.laser[0].join()) this.#follow(from, to);
    this.#keepChoice(to);
    this.#set(to);
  }

  /** Selects the laser if the selected thing is gone. @param {World} world */
  #keepChoice(world) {
    if (!world[this.#chosen.kind][this.#chosen.index]) this.#chosen = LASER;
  }

  #show() {
    const [world, { kind, index }] = [this.#world, this.#chosen];
    this.card.hidden = world === null;
    this.#handles.set(world, this.#chosen);
    if (!world) return;
    this.#undo.disabled = !this.#past.canUndo;
    this.#redo.disabled = !this.#past.canRedo;
    this.#remove.disabled = kind !== "wall" && kind !== "circle";
    this.#place.set(kind, world[kind][index] ?? []);
    this.#beams.set("beams", world.beams[0]);
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ recording, lesson }) {
    // The world of a lesson stays as its texts say.
    const next = lesson === null ? worldOf(recording) : null;
    if (next && this.#world && idOf(this.#world) === idOf(next)) return;
    if (!next) {
      this.#world = null;
      this.#past.forget();
    } else {
      // It came from a link, the menu or the browser's history.
      if (!this.#past.open) this.#world = next;
      this.#keepChoice(next);
    }
    this.#show();
  }
}
