// @ts-check
import { h } from "./dom.js";

const STEPS = 10_000;
let gestures = 0;

/** A number that is new for each press of a button or key, so that one drag is one undo step. */
export function gestureCount() {
  return gestures;
}
addEventListener("pointerdown", () => gestures++, true);
let held = false;

/** Whether a button of the pointer is held down, as while a slider is being dragged. */
export function pointerHeld() {
  return held;
}
addEventListener("pointerdown", () => (held = true), true);
for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => (held = false), true);
addEventListener("keydown", (event) => !event.repeat && gestures++, true);

/**
 * A native range input over places 0 to 1; the caller decides what a place means.
 * @param {object} options
 * @param {string} options.label
 * @param {(place: number) => void} options.onPlace while it is dragged
 * @param {(steps: number) => void} options.onSteps arrow keys: ±1, page keys: ±10, Home and End: ∓Infinity
 * @param {boolean} [options.fill] whether the part left of the thumb is coloured
 */
export function createSlider({ label, onPlace, onSteps, fill = true }) {
  const input = h("input", {
    type: "range",
    class: fill ? "range range-filled" : "range",
    min: "0",
    max: String(STEPS),
    step: "1",
    "aria-label": label,
  });
  input.addEventListener("input", () => {
    paint(input.valueAsNumber / STEPS);
    onPlace(input.valueAsNumber / STEPS);
  });
  /** @type {Record<string, number>} */
  const keys = {
    ArrowRight: 1,
    ArrowUp: 1,
    ArrowLeft: -1,
    ArrowDown: -1,
    PageUp: 10,
    PageDown: -10,
    Home: -Infinity,
    End: Infinity,
  };
  input.addEventListener("keydown", (event) => {
    const steps = keys[event.key];
    if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    onSteps(event.shiftKey && Math.abs(steps) === 1 ? 10 * steps : steps);
  });

  /** @param {number} place */
  const paint = (place) => input.style.setProperty("--place", String(place));

  return {
    element: input,
    /** @param {number} place @param {string} spoken */
    set(place, spoken) {
      const value = String(Math.round(place * STEPS));
      if (input.value !== value) input.value = value;
      paint(place);
      if (input.getAttribute("aria-valuetext") !== spoken) input.setAttribute("aria-valuetext", spoken);
    },
  };
}
