// @ts-check
// True lines over the plan. They can be selected, dragged by their ends, and drawn from point to point.
import { svg } from "../widgets/dom.js";
import { createGrip, GRIPS } from "./grip.js";
import { placesOf, runBetween, seenOf } from "./lines.js";
import { putLine, Sketch } from "./sketch.js";

/** @typedef {import("./lines.js").Line} Line */
/** @typedef {import("./lines.js").Point} Point */
/** @typedef {import("./lines.js").Sweep} Sweep */
/** @typedef {import("./grip.js").Grip} Grip */
/** proposed: the lines come from the current result. @typedef {{lines: Line[], chosen: number, cut: number, proposed: boolean, sweep: Sweep | null, drawing: boolean}} Shown */
/** @typedef {{project: (x: number, y: number) => Point | null, onMove: (listener: () => void) => void, pass: (event: WheelEvent) => void}} PlanView */
/**
 * @typedef {object} Handlers
 * @property {(line: number, beam: number | null) => void} onChoose a line, and its beam under the pointer
 * @property {(grip: Grip, beam: number, done: boolean) => void} onGrip a grip of the selected line moved to a beam; done: the gesture ends there
 * @property {(run: number[]) => void} onDrawn
 */

export class Overlay {
  #view;
  #text;
  #onChoose;
  /** @type {Shown | null} */ #shown = null;
  #shapes = svg("g");
  /** @type {Map<Grip, SVGElement>} */ #grips;
  #element = svg("svg", { class: "label-overlay", role: "group", hidden: "" });

  /**
   * @param {HTMLElement} stage
   * @param {PlanView} view
   * @param {typeof import("../text/label.js").labelText.handle} text
   * @param {Handlers} handlers
   */
  constructor(stage, view, text, { onChoose, onGrip, onDrawn }) {
    this.#view = view;
    this.#text = text;
    this.#onChoose = onChoose;
    this.#grips = new Map(
      GRIPS.map((name) => [
        name,
        createGrip(name, {
          places: () => this.#placesFor(name),
          now: () => (this.#shown ? beamOf(this.#shown, name) : -1),
          nearest: (event, places) => this.#nearest(event, places),
          onGrip: (beam, done) => onGrip(name, beam, done),
        }),
      ]),
    );
    const sketch = new Sketch(this.#element, {
      drawing: () => this.#shown?.drawing ?? false,
      nearest: (event, reach) => this.#nearest(event, [...(this.#shown?.sweep?.points.keys() ?? [])], reach),
      place: (beam) => this.#place(beam),
      onDrawn: (from, to) => this.#shown?.sweep && onDrawn(runBetween(from, to, this.#shown.sweep)),
    });
    this.#element.append(this.#shapes, sketch.element, ...this.#grips.values());
    this.#element.addEventListener("wheel", (event) => view.pass(event), { passive: true });
    stage.append(this.#element);
    view.onMove(() => this.#draw());
  }

  /** Position of the point of a beam on the stage. @param {number} beam */
  #place(beam) {
    const point = this.#shown?.sweep?.points[beam];
    return point ? this.#view.project(...point) : null;
  }

  /** The one of these beams whose point is nearest to the pointer. @param {PointerEvent} event @param {number[]} beams @param {number} reach [px] */
  #nearest({ clientX, clientY }, beams, reach = Infinity) {
    const box = this.#element.getBoundingClientRect();
    let [best, least] = [/** @type {number | null} */ (null), reach];
    for (const beam of beams) {
      const at = this.#place(beam);
      const away = at ? Math.hypot(at[0] + box.left - clientX, at[1] + box.top - clientY) : Infinity;
      if (away < least) [best, least] = [beam, away];
    }
    return best;
  }

  /** Beams to which a grip of the selected line can move. @param {Grip} name */
  #placesFor(name) {
    if (!this.#shown?.sweep) return [];
    const { lines, chosen, sweep } = this.#shown;
    return name === "cut" ? seenOf(lines[chosen], sweep).slice(0, -1) : placesOf(lines, chosen, name, sweep);
  }

  #draw() {
    const shown = this.#shown;
    this.#element.toggleAttribute("hidden", shown === null);
    if (!shown) return;
    this.#element.classList.toggle("drawing", shown.drawing);
    while (this.#shapes.children.length > shown.lines.length) this.#shapes.lastElementChild?.remove();
    while (this.#shapes.children.length < shown.lines.length) this.#shapes.append(this.#emptyShape());
    for (const [k, shape] of [...this.#shapes.children].entries()) this.#drawLine(shape, shown, k);
    for (const [name, grip] of this.#grips) this.#drawGrip(grip, shown, name);
  }

  #emptyShape() {
    const shape = svg("g", { class: "label-shape" });
    shape.append(svg("line", { class: "label-hit" }), svg("line", { class: "label-line" }));
    shape.addEventListener("pointerdown", (event) => {
      if (this.#shown?.drawing) return;
      event.preventDefault();
      const k = [...this.#shapes.children].indexOf(shape);
      const seen = this.#shown?.sweep ? seenOf(this.#shown.lines[k], this.#shown.sweep) : [];
      this.#onChoose(k, this.#nearest(event, seen));
    });
    return shape;
  }

  /** @param {Element} shape @param {Shown} shown @param {number} k */
  #drawLine(shape, { lines, chosen, proposed }, k) {
    const { start, end, first, last } = lines[k];
    const one = start ? this.#view.project(...start) : this.#place(first);
    const other = end ? this.#view.project(...end) : this.#place(last);
    shape.toggleAttribute("hidden", !one || !other);
    if (!one || !other) return;
    for (const each of shape.children) putLine(each, one, other);
    shape.classList.toggle("chosen", k === chosen);
    shape.classList.toggle("proposed", proposed);
    shape.setAttribute("aria-label", this.#text.line(k + 1));
  }

  /** @param {SVGElement} grip @param {Shown} shown @param {Grip} name */
  #drawGrip(grip, shown, name) {
    const there = shown.lines[shown.chosen] && shown.sweep && !shown.drawing;
    const at = there ? this.#place(beamOf(shown, name)) : null;
    grip.toggleAttribute("hidden", !at);
    if (!at) return;
    grip.setAttribute("transform", `translate(${at[0]} ${at[1]})`);
    grip.setAttribute("aria-label", this.#text[name](beamOf(shown, name)));
  }

  /** @param {Shown | null} shown null: nothing to edit */
  set(shown) {
    this.#shown = shown;
    this.#draw();
  }
}

/** The beam of a grip of the selected line. @param {Shown} shown @param {Grip} name */
function beamOf({ lines, chosen, cut }, name) {
  return name === "cut" ? cut : lines[chosen][name];
}
