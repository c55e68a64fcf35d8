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
  const { low, high, log, passed, failed } = histogram;
  const bins = passed.length;
  const most = Math.max(1, ...passed.map((count, k) => count + failed[k]));
  const edge = (/** @type {number} */ k) => {
    const value = log ? low * (high / low) ** (k / bins) : low + (k / bins) * (high - low);
    return placeOf(range, value) * WIDTH;
  };
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

/** @param {number} left @param {number} right @param {number} bottom @param {number} top */
function bar(left, right, bottom, top) {
  return `M${left.toFixed(1)} ${bottom.toFixed(1)}V${top.toFixed(1)}H${right.toFixed(1)}V${bottom.toFixed(1)}Z`;
}
