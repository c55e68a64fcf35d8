// @ts-check
// The trials of auto-tuning as pictures: their scores in order, their thresholds side by side, and which thresholds matter.
import { h, svg } from "../widgets/dom.js";
import { placeOf } from "../widgets/scale.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** scored: its score is known. @typedef {import("../wire.js").Trial & {score: number}} Scored */

const WIDTH = 300;
const HEIGHT = 90;
const STAY = { "vector-effect": "non-scaling-stroke" };

export class TrialPictures {
  #history;
  #parallel;
  #axes = h("div", { class: "auto-axes muted" });

  /** @param {typeof import("../text/tuning.js").tuningText.auto} text @param {HTMLElement} bars below the pictures */
  constructor(text, bars) {
    this.#history = picture("auto-history", text.history);
    this.#parallel = picture("auto-parallel", text.parallel);
    this.element = h(
      "div",
      { class: "auto-pictures", hidden: true },
      this.#history,
      this.#parallel,
      this.#axes,
      h("h3", {}, text.importance),
      bars,
    );
  }

  /** @param {Scored[]} trials @param {Knob[]} axes the thresholds that were tuned */
  paint(trials, axes) {
    paintHistory(
      this.#history,
      trials.map(({ score }) => score),
    );
    paintParallel(this.#parallel, trials, axes);
    this.#axes.replaceChildren(...axes.map(({ symbol }) => h("span", {}, symbol)));
  }
}

/** @param {HTMLElement} element @param {Record<string, number>} importance @param {Knob[]} knobs */
export function paintBars(element, importance, knobs) {
  element.replaceChildren(
    ...Object.entries(importance).map(([name, share]) => {
      const bar = h("span", { class: "auto-bar" });
      bar.style.width = `${Math.round(100 * share)}%`;
      const symbol = knobs.find((knob) => knob.name === name)?.symbol ?? name;
      return h(
        "div",
        { class: "auto-row" },
        h("span", {}, symbol),
        h("span", { class: "auto-track" }, bar),
        h("span", { class: "muted" }, `${Math.round(100 * share)} %`),
      );
    }),
  );
}

/** @param {string} className @param {string} label */
function picture(className, label) {
  const element = svg("svg", {
    class: className,
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    preserveAspectRatio: "none",
    role: "img",
    "aria-label": label,
  });
  const title = svg("title");
  title.textContent = label;
  element.append(title);
  return element;
}

/** @param {Element} element @param {Element[]} marks */
function show(element, marks) {
  element.replaceChildren(/** @type {Element} */ (element.firstElementChild), ...marks);
}

/** @param {Element} element @param {number[]} scores */
function paintHistory(element, scores) {
  const [low, high] = [Math.min(...scores), Math.max(...scores)];
  const x = (/** @type {number} */ k) => 4 + (k / Math.max(1, scores.length - 1)) * (WIDTH - 8);
  const y = (/** @type {number} */ score) => 6 + (1 - (high > low ? (score - low) / (high - low) : 1)) * (HEIGHT - 12);
  let top = -Infinity;
  let steps = "";
  let dots = "";
  for (const [k, score] of scores.entries()) {
    top = Math.max(top, score);
    steps += `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(top).toFixed(1)}`;
    dots += `M${x(k).toFixed(1)} ${y(score).toFixed(1)}h0`;
  }
  show(element, [
    svg("path", { class: "dots", d: dots, ...STAY }),
    svg("path", { class: "default", d: `M0 ${y(scores[0])}H${WIDTH}`, ...STAY }),
    svg("path", { class: "best", d: steps, ...STAY }),
  ]);
}

/** Better trials have stronger lines and are drawn later. @param {Element} element @param {Scored[]} trials @param {Knob[]} axes */
function paintParallel(element, trials, axes) {
  const sorted = [...trials].sort((one, other) => one.score - other.score);
  const x = (/** @type {number} */ k) => ((k + 0.5) / axes.length) * WIDTH;
  const y = (/** @type {Knob} */ knob, /** @type {Scored} */ trial) =>
    4 + (1 - placeOf(knob, trial.params[knob.name])) * (HEIGHT - 8);
  show(element, [
    ...axes.map((_, k) => svg("path", { class: "axis", d: `M${x(k)} 0V${HEIGHT}`, ...STAY })),
    ...sorted.map((trial, rank) =>
      svg("path", {
        class: rank === sorted.length - 1 ? "trial best" : "trial",
        d: axes.map((knob, k) => `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(knob, trial).toFixed(1)}`).join(""),
        opacity: (0.06 + 0.5 * (rank / sorted.length) ** 3).toFixed(2),
        ...STAY,
      }),
    ),
  ]);
}
