// @ts-check
// A curve of the results over the range of one threshold.
import { h, svg } from "../widgets/dom.js";
import { placeOf, snap, valueAt, withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Curve} Curve */

const WIDTH = 1000;
const HEIGHT = 100;
export const LINES = ["coverage", "segments", "true_rate", "false_rate", "completeness"];

/**
 * @param {Knob} knob
 * @param {typeof import("../text/tuning.js").tuningText.curves} text
 * @param {(value: number) => void} onSet
 */
export function createCurve(knob, text, onSet) {
  const picture = svg("svg", {
    class: "curve-picture",
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    preserveAspectRatio: "none",
    "aria-hidden": "true",
  });
  const paths = new Map(
    LINES.map((line) => [
      line,
      svg("path", { class: "curve-line", "data-line": line, "vector-effect": "non-scaling-stroke" }),
    ]),
  );
  const mark = svg("line", { class: "curve-mark", y1: 0, y2: HEIGHT, "vector-effect": "non-scaling-stroke" });
  picture.append(...paths.values(), mark);
  const element = h("div", { class: "curve", role: "img", "aria-label": text.picture(knob.symbol) });
  element.append(picture);
  /** @type {Curve | null} */
  let curve = null;
  const placeAt = (/** @type {MouseEvent} */ event) => {
    const { left, width } = picture.getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - left) / width));
  };
  element.addEventListener("click", (event) => onSet(valueAt(knob, placeAt(event))));
  const said = (/** @type {Event} */ event) =>
    curve && event instanceof PointerEvent ? words(knob, curve, placeAt(event), text) : "";
  tooltip(element, said, "left");
  const paint = (/** @type {Curve} */ { values, ...lines }) => {
    const most = Math.max(1e-9, ...lines.segments.map((value) => value ?? 0));
    for (const [line, path] of paths)
      path.setAttribute("d", lines[line] ? pathOf(knob, values, lines[line], line === "segments" ? most : 1) : "");
  };
  return {
    element,
    /** @param {Curve} next */
    set(next) {
      curve = next;
      paint(next);
    },
    /** @param {Set<string>} hidden */
    showOnly(hidden) {
      for (const [line, path] of paths) path.style.display = hidden.has(line) ? "none" : "";
    },
    /** @param {number} value @param {Knob} range of the slider */
    mark(value, range) {
      if (range !== knob) {
        knob = range;
        if (curve) paint(curve);
      }
      const x = String(placeOf(knob, value) * WIDTH);
      mark.setAttribute("x1", x);
      mark.setAttribute("x2", x);
    },
  };
}

/** @param {Knob} knob @param {number[]} values @param {(number | null)[]} heights @param {number} most */
function pathOf(knob, values, heights, most) {
  let path = "";
  let pen = "M";
  heights.forEach((height, k) => {
    if (height === null) {
      pen = "M";
      return;
    }
    path += `${pen}${(placeOf(knob, values[k]) * WIDTH).toFixed(1)} ${((1 - (0.94 * height) / most) * HEIGHT - 3).toFixed(1)}`;
    pen = "L";
  });
  return path;
}

/** @param {Knob} knob @param {Curve} curve @param {number} place @param {typeof import("../text/tuning.js").tuningText.curves} text */
function words(knob, curve, place, text) {
  const distances = curve.values.map((value) => Math.abs(placeOf(knob, value) - place));
  const k = distances.indexOf(Math.min(...distances));
  const parts = LINES.filter((line) => curve[line] && curve[line][k] !== null).map(
    (line) => `${text.short[line]} ${Number(curve[line][k]).toFixed(2)}`,
  );
  return `${knob.symbol} ${withUnit(knob, snap(knob, curve.values[k]))}: ${parts.join(", ")}`;
}
