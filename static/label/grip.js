// @ts-check
// A grip of the selected line, for pointer and keyboard.
import { svg } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";

export const GRIPS = /** @type {const} */ (["first", "cut", "last"]);
/** cut: where a chosen line would be split. @typedef {typeof GRIPS[number]} Grip */
/**
 * @typedef {object} Handlers
 * @property {() => number[]} places beams to which it can move
 * @property {() => number} now its current beam
 * @property {(event: PointerEvent, places: number[]) => number | null} nearest the one of the beams that is nearest to the pointer
 * @property {(beam: number, done: boolean) => void} onGrip
 */

const FAR = 10;

/** @param {Grip} name @param {Handlers} handlers */
export function createGrip(name, { places, now, nearest, onGrip }) {
  const grip = svg("g", { class: `label-grip ${name}`, tabindex: 0, role: "button", hidden: "" });
  grip.append(name === "cut" ? svg("path", { d: "M0-7 7 0 0 7-7 0z" }) : svg("circle", { r: 7 }));
  let dragging = false;

  /** @param {PointerEvent} event @param {boolean} done */
  function drag(event, done) {
    if (!dragging) return;
    if (done) dragging = false;
    const beam = nearest(event, places());
    if (beam !== null) onGrip(beam, done);
  }

  grip.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    event.stopPropagation();
    grip.setPointerCapture(event.pointerId);
    grip.focus();
    dragging = true;
  });
  grip.addEventListener("pointermove", (event) => drag(event, false));
  for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
    grip.addEventListener(kind, (event) => drag(event, true));
  grip.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const beams = places();
    const beam = beams[clamp(beams.indexOf(now()) + step * (event.shiftKey ? FAR : 1), 0, beams.length - 1)];
    if (beam !== undefined) onGrip(beam, true);
  });
  return grip;
}
