// @ts-check
// A new line under the pointer, from one point of the scan to another.
import { svg } from "../widgets/dom.js";

/** @typedef {import("./lines.js").Point} Point */
/**
 * @typedef {object} Handlers
 * @property {() => boolean} drawing whether a new line can start
 * @property {(event: PointerEvent, reach?: number) => number | null} nearest the beam whose point is nearest to the pointer
 * @property {(beam: number) => Point | null} place position of the point of a beam on the stage
 * @property {(from: number, to: number) => void} onDrawn
 */

// A new line can start this far from a point [px].
const REACH = 30;

export class Sketch {
  /** Its first beam. @type {number | null} */ #from = null;
  #handlers;

  /** @param {SVGElement} surface on which it is drawn @param {Handlers} handlers */
  constructor(surface, handlers) {
    this.#handlers = handlers;
    this.element = svg("line", { class: "label-line chosen", hidden: "" });
    surface.addEventListener("pointerdown", (event) => this.#begin(surface, event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#finish(event));
    surface.addEventListener("pointercancel", () => this.#stop());
  }

  /** @param {SVGElement} surface @param {PointerEvent} event */
  #begin(surface, event) {
    if (!this.#handlers.drawing()) return;
    event.preventDefault();
    this.#from = this.#handlers.nearest(event, REACH);
    if (this.#from !== null) surface.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (this.#from === null) return;
    const { nearest, place } = this.#handlers;
    const [one, other] = [place(this.#from), place(nearest(event) ?? this.#from)];
    this.element.toggleAttribute("hidden", !one || !other);
    if (one && other) putLine(this.element, one, other);
  }

  /** @param {PointerEvent} event */
  #finish(event) {
    const [from, to] = [this.#from, this.#from === null ? null : this.#handlers.nearest(event)];
    this.#stop();
    if (from !== null && to !== null && to !== from) this.#handlers.onDrawn(from, to);
  }

  #stop() {
    this.#from = null;
    this.element.toggleAttribute("hidden", true);
  }
}

/** @param {Element} line @param {Point} one @param {Point} other */
export function putLine(line, [x1, y1], [x2, y2]) {
  for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) line.setAttribute(name, String(value));
}
