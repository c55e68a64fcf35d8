// @ts-check
import { svg } from "./dom.js";
import { placeOf } from "./scale.js";

/** @typedef {import("../wire.js").Histogram} Histogram */
/** @typedef {{low: number, high: number, log: boolean}} Range */

const WIDTH = 1000;
const HEIGHT = 100;

/**
 * Bars of what passed and what failed, on the scale of the slider above them, with the cut drawn.
 * @param {Range} range
 */
export function createHistogram(range) {
  /** @type {Histogram | undefined} */ let shown;
  const passed = svg("path", { class: "passed" });
  const failed = svg("path", { class: "failed" });
  const cut = svg("line", { class: "cut", y1: 0, y2: HEIGHT, "vector-effect": "non-scaling-stroke" });
  const element = svg("svg", {
    class: "histogram",
    role: "img",
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    preserveAspectRatio: "none",
  });
  element.append(passed, failed, cut);

  function paint() {
    const [low, high] = shown ? stacked(range, shown) : ["", ""];
    passed.setAttribute("d", low);
    failed.setAttribute("d", high);
  }

  return {
    element,
    /** @param {Range} next of the slider */
    setRange(next) {
      range = next;
      paint();
    },
    /** @param {Histogram | undefined} histogram @param {string} label */
    set(histogram, label) {
      shown = histogram;
      paint();
      element.setAttribute("aria-label", label);
    },
    /** What is counted at a place, from 0 to 1. @param {number} place @returns {{from: number, to: number, passed: number, failed: number} | null} */
    at(place) {
      const known = shown;
      if (!known) return null;
      const k = known.passed.findIndex((_, k) => place < placeOf(range, edgeOf(k + 1, known)));
      const bin = k < 0 ? known.passed.length - 1 : k;
      const [from, to] = [edgeOf(bin, known), edgeOf(bin + 1, known)];
      return { from, to, passed: known.passed[bin], failed: known.failed[bin] };
    },
    /** @param {number} value */
    cutAt(value) {
      const x = String(placeOf(range, value) * WIDTH);
      cut.setAttribute("x1", x);
      cut.setAttribute("x2", x);
    },
  };
}

/**
 * Paths of the passed bars and of the failed ones on top. Heights go with the square root, so that single
 * refused points stay visible beside hundreds of passed ones.
 * @param {Range} range
 * @param {Histogram} histogram
 */
function stacked(range, histogram) {
  const { passed, failed } = histogram;
  const bins = passed.length;
  const most = Math.max(1, ...passed.map((count, k) => count + failed[k]));
  const edge = (/** @type {number} */ k) => placeOf(range, edgeOf(k, histogram)) * WIDTH;
  let lower = "";
  let upper = "";
  for (let k = 0; k < bins; k++) {
    const total = passed[k] + failed[k];
    if (total === 0) continue;
    const height = Math.max(4, Math.sqrt(total / most) * HEIGHT);
    const share = (passed[k] / total) * height;
    const [left, right] = [edge(k), edge(k + 1) - 3];
    if (passed[k]) lower += bar(left, right, HEIGHT, HEIGHT - share);
    if (failed[k]) upper += bar(left, right, HEIGHT - share, HEIGHT - height);
  }
  return [lower, upper];
}

/** The value at the lower edge of a bin. @param {number} k @param {Histogram} histogram */
function edgeOf(k, { low, high, log, passed: { length } }) {
  return log ? low * (high / low) ** (k / length) : low + (k / length) * (high - low);
}

/** @param {number} left @param {number} right @param {number} bottom @param {number} top */
function bar(left, right, bottom, top) {
  return `M${left.toFixed(1)} ${bottom.toFixed(1)}V${top.toFixed(1)}H${right.toFixed(1)}V${bottom.toFixed(1)}Z`;
}
