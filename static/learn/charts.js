// @ts-check
// Three charts that move with the step. A dot is a point of the scan; the dashed line is the threshold.
import { h } from "../widgets/dom.js";
import { onTheme } from "../widgets/colours.js";
import { DotChart } from "./dot_chart.js";
import { lengthOf } from "./geometry.js";
import { GrowthChart } from "./growth_chart.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("../wire.js").Params} Params */

const BESIDE = 12;

/**
 * @param {typeof import("../text/learn.js").learnText.charts} text
 * @param {(beam: number | null) => void} onBeam a beam is under the pointer or the keyboard
 * @param {(beam: number) => void} onRun a beam was chosen
 */
export function createCharts(text, onBeam, onRun) {
  const beams = { onBeam, onRun, say: text.sayBeam };
  const distance = new DotChart(text.distance, beams);
  const predicted = new DotChart(text.predicted, beams);
  const growth = new GrowthChart(text.growth);
  const element = h("div", { class: "charts" }, distance.element, predicted.element, growth.element);
  /** @type {{event: Event, trace: Trace, params: Params} | null} */
  let shown = null;

  // Sizes are cached, because reading them after a text change would force another layout.
  let visible = false;

  function draw() {
    if (!visible) return;
    if (!shown) {
      for (const chart of [distance, predicted, growth]) chart.clear(text.nothing);
      return;
    }
    const { event, trace, params } = shown;
    const { line } = event;
    if (line) {
      const beams = around(event, trace);
      const within = new Set(trace.span(event.first, event.last));
      /** @param {(beam: number) => number} of @param {(beam: number) => number} limitAt */
      const dots = (of, limitAt) =>
        beams.map((beam) => ({
          x: beam,
          y: of(beam),
          limit: limitAt(beam),
          inside: within.has(beam),
          now: beam === event.beam,
        }));
      const epsilon = (/** @type {number} */ beam) => {
        const [x, y] = trace.point(beam) ?? [0, 0];
        return Math.hypot(params.epsilon, (params.epsilon_growth ?? 0) * Math.hypot(x, y));
      };
      distance.set(
        dots((beam) => trace.distance(beam, line), epsilon),
        event.beam >= 0 ? text.sayBeam(event.beam, event.value) : "",
      );
      const off = (/** @type {number} */ beam) => {
        const { range, meets } = trace.predicted(beam, line);
        return Math.abs(range - meets);
      };
      predicted.set(
        dots(off, () => params.delta),
        event.beam >= 0 ? text.sayBeam(event.beam, off(event.beam)) : "",
      );
    } else {
      distance.clear(text.noLine);
      predicted.clear(text.noLine);
    }
    const grown = growthOf(event, trace);
    if (grown.length) growth.set(grown, params.min_length, params.min_points, text.sayGrowth(grown[grown.length - 1]));
    else growth.clear(text.noGrowth);
  }
  onTheme(draw);
  const sized = new ResizeObserver(() => {
    visible = element.clientWidth > 0;
    for (const chart of [distance, predicted, growth]) chart.measure();
    draw();
  });
  sized.observe(element);

  return {
    element,
    /** @param {Event | null} event @param {Trace | null} trace @param {Params} params */
    set(event, trace, params) {
      shown = event && trace ? { event, trace, params } : null;
      draw();
    },
  };
}

/** The beams of the decision, and some to either side. @param {Event} event @param {Trace} trace */
function around({ index, first, last, beam }, trace) {
  const n = trace.beams;
  const circle = trace.columns.circle;
  const count = (last >= first ? last - first : last - first + n) + 1;
  const away = beam < 0 || trace.covers(index, beam) ? 0 : Math.min((first - beam + n) % n, (beam - last + n) % n);
  const beside = Math.max(BESIDE, away + 3);
  const beams = [];
  for (let k = -beside; k < Math.min(count + beside, n - beside); k++) {
    const at = first + k;
    const there = circle ? (at + n) % n : at;
    if (there >= 0 && there < n && trace.point(there)) beams.push(there);
  }
  return beams;
}

/** Points and length of the growing line, step by step from its seed. @param {Event} event @param {Trace} trace */
function growthOf({ index, candidate, phase }, trace) {
  if (phase !== "growth" && phase !== "seed") return [];
  const { columns: c } = trace;
  const kinds = ["seed found", "point added"].map((kind) => c.kinds.indexOf(kind));
  const steps = [];
  for (let k = index; k >= 0 && c.candidate[k] === candidate; k--) if (kinds.includes(c.kind[k])) steps.push(k);
  return steps.reverse().map((k) => {
    const line = trace.at(k).line;
    return { points: c.points[k], length: line ? lengthOf(trace, c.first[k], c.last[k], line) : 0 };
  });
}
