// @ts-check
// The editor of a world: its card, its undo, and the recording that its text is the id of.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createNumberField } from "../widgets/number.js";
import { createHandles } from "./handles.js";
import { idOf, inPlan, inWorld, MOST_CIRCLES, MOST_WALLS, withNumbers, without, worldOf } from "./world.js";

/** @typedef {import("./world.js").World} World */
/** @typedef {import("./world.js").Thing} Thing */
/** @typedef {import("./world.js").Kind} Kind */

const LONGEST_PAST = 200;

/**
 * @param {HTMLElement} stage
 * @param {import("../stage/stage.js").Stage} view
 * @param {typeof import("../text/draw.js").drawText} text
 * @param {{onRecording: (id: string) => void, onSave: () => void}} handlers
 */
export function createDraw(stage, view, text, { onRecording, onSave }) {
  /** @type {World | null} */
  let world = null;
  /** What the present gesture began with. @type {string | null} */
  let before = null;
  /** @type {Thing} */
  let chosen = { kind: "laser", index: 0 };
  /** @type {string[]} */
  let past = [];
  /** @type {string[]} */
  let future = [];

  const handles = createHandles(stage, view, text.handle, { onChoose: choose, onNumbers: changed, onRemove: remove });
  const undoButton = iconButton("undo", text.undo, () => undo());
  const redoButton = iconButton("redo", text.redo, () => redo());
  const removeButton = h(
    "button",
    { type: "button", class: "button", title: text.remove, onclick: () => remove(chosen) },
    text.remove,
  );
  const button = (/** @type {string} */ label, /** @type {() => void} */ run, help = "") =>
    h("button", { type: "button", class: "button", title: help, onclick: run }, label);
  const place = h("div", { class: "draw-fields" });
  const beams = h("div", { class: "draw-fields" });
  const message = h("p", { class: "hint", role: "status" }, text.hint);
  const card = h(
    "section",
    { class: "draw-card", "aria-label": text.label, hidden: true },
    h(
      "div",
      { class: "draw-row" },
      button(text.addWall, addWall),
      button(text.addCircle, addCircle),
      h("span", { class: "spacer" }),
      undoButton,
      redoButton,
    ),
    place,
    h("h3", {}, text.beams),
    beams,
    h(
      "div",
      { class: "draw-row" },
      removeButton,
      button(text.another, () => world && commit({ ...world, seed: world.seed + 1 }), text.anotherHelp),
      button(text.save, onSave, text.saveHelp),
    ),
    message,
  );

  /** @param {Thing} thing */
  function choose(thing) {
    chosen = thing;
    show();
  }

  /** @param {Thing} thing @param {number[]} numbers @param {boolean} done */
  function changed(thing, numbers, done) {
    if (!world) return;
    const next = withNumbers(world, thing, numbers);
    before ??= idOf(world);
    if (thing.kind === "laser" && !done) {
      // The plan is the laser's: it would turn and move under the hand. It follows when the hand lets go.
      handles.set(next, chosen);
      return;
    }
    if (thing.kind === "laser") follow(world, next);
    set(next);
    if (done) remember();
  }

  /** Keeps the world in its place on the screen when the laser moves in it. @param {World} from @param {World} to */
  function follow(from, to) {
    const [x, y] = inPlan(from, /** @type {[number, number]} */ (to.laser[0].slice(0, 2)));
    view.pan(-x, -y);
  }

  /** @param {World} next */
  function set(next) {
    world = next;
    show();
    onRecording(idOf(next));
  }

  function remember() {
    if (before !== null && world && before !== idOf(world)) {
      past = [...past.slice(-LONGEST_PAST), before];
      future = [];
    }
    before = null;
    show();
  }

  /** @param {World} next a change that is a gesture of its own */
  function commit(next) {
    if (!world) return;
    before = idOf(world);
    set(next);
    remember();
  }

  /** @param {Thing} thing */
  function remove(thing) {
    if (!world || (thing.kind !== "wall" && thing.kind !== "circle")) return;
    const index = Math.min(thing.index, world[thing.kind].length - 2);
    chosen = index < 0 ? { kind: "laser", index: 0 } : { kind: thing.kind, index };
    commit(without(world, thing));
  }

  /** The middle of what is on the screen. @returns {[number, number]} */
  function middle() {
    const at = view.unproject(view.frame.clientWidth / 2, view.frame.clientHeight / 2);
    return world && at ? inWorld(world, at) : [1, 0];
  }

  function addWall() {
    if (!world || world.wall.length >= MOST_WALLS) return setText(message, text.full(MOST_WALLS, MOST_CIRCLES));
    const [x, y] = middle();
    chosen = { kind: "wall", index: world.wall.length };
    commit({ ...world, wall: [...world.wall, [x - 1, y + 1, x + 1, y + 1]] });
  }

  function addCircle() {
    if (!world || world.circle.length >= MOST_CIRCLES) return setText(message, text.full(MOST_WALLS, MOST_CIRCLES));
    const [x, y] = middle();
    chosen = { kind: "circle", index: world.circle.length };
    commit({ ...world, circle: [...world.circle, [x, y + 1, 0.4]] });
  }

  /** @param {string[]} from @param {string[]} to */
  function travel(from, to) {
    const id = from.pop();
    const next = id === undefined ? null : worldOf(id);
    if (!next || !world) return;
    to.push(idOf(world));
    if (next.laser[0].join() !== world.laser[0].join()) follow(world, next);
    if (!next[chosen.kind][chosen.index]) chosen = { kind: "laser", index: 0 };
    set(next);
  }
  const undo = () => travel(past, future);
  const redo = () => travel(future, past);

  /** @param {HTMLElement} holder @param {Thing} thing */
  function showFields(holder, thing) {
    const names = text.fields[thing.kind];
    const numbers = world?.[thing.kind][thing.index] ?? [];
    if (holder.dataset.kind !== thing.kind) {
      holder.dataset.kind = thing.kind;
      holder.replaceChildren(...names.map(([name, unit], k) => fieldElement(holder, name, unit, k)));
    }
    [...holder.children].forEach((each, k) => {
      const input = /** @type {HTMLInputElement} */ (each.querySelector("input"));
      if (document.activeElement !== input)
        /** @type {any} */ (each).field.set(String(Number((numbers[k] ?? 0).toFixed(3))));
    });
  }

  /** @param {HTMLElement} holder @param {string} name @param {string} unit @param {number} k */
  function fieldElement(holder, name, unit, k) {
    const field = createNumberField({
      label: `${name} [${unit}]`,
      accept(typed) {
        const value = Number(typed);
        if (typed === "" || !Number.isFinite(value)) return text.notANumber(typed);
        const thing = holder === beams ? /** @type {Thing} */ ({ kind: "beams", index: 0 }) : chosen;
        if (!world) return null;
        const numbers = world[thing.kind][thing.index].with(k, value);
        field.set(typed);
        if (thing.kind === "laser") follow(world, withNumbers(world, thing, numbers));
        commit(withNumbers(world, thing, numbers));
        return null;
      },
    });
    const element = h(
      "label",
      { class: "draw-field" },
      h("span", { class: "muted" }, name),
      field.element,
      h("span", { class: "muted" }, unit),
      field.error,
    );
    return Object.assign(element, { field });
  }

  function show() {
    card.hidden = world === null;
    handles.set(world, chosen);
    if (!world) return;
    undoButton.disabled = !past.length;
    redoButton.disabled = !future.length;
    removeButton.disabled = chosen.kind !== "wall" && chosen.kind !== "circle";
    showFields(place, chosen);
    showFields(beams, { kind: "beams", index: 0 });
  }

  return {
    card,
    get active() {
      return world !== null;
    },
    undo,
    redo,
    /** @param {Readonly<import("../wire.js").View>} view */
    setView({ recording }) {
      const next = recording === null ? null : worldOf(recording);
      if (!next) {
        if (world) [world, past, future, before] = [null, [], [], null];
        return show();
      }
      if (world && idOf(world) === idOf(next)) return undefined;
      // It came from elsewhere: a link, the menu, the way back.
      if (before === null) world = next;
      if (!next[chosen.kind]?.[chosen.index]) chosen = { kind: "laser", index: 0 };
      return show();
    },
  };
}
