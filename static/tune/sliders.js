// @ts-check
import { h } from "../widgets/dom.js";
import { createHistogram } from "../widgets/histogram.js";
import { createNumberField } from "../widgets/number.js";
import { clamp, format, placeOf, snap, valueAt, withUnit } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { hideTooltip, tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Histogram} Histogram */
/** @typedef {typeof import("../text/page.js").pageText.tune} Text */

const WITH_HISTOGRAM = new Set(["epsilon", "delta", "min_points", "min_length"]);
const PAGE = 10;

/** @param {Knob} knob */
export function hasHistogram(knob) {
  return WITH_HISTOGRAM.has(knob.name);
}

/**
 * One threshold: symbol, typed value, slider and, where it cuts something that is measured, its histogram.
 * @param {Knob} knob
 * @param {Text} text
 * @param {(name: string, value: number) => void} onChange
 */
export function createThreshold(knob, text, onChange) {
  let value = knob.default;

  const field = createNumberField({
    label: `${knob.symbol}, ${knob.label}${knob.unit ? ` [${knob.unit}]` : ""}`,
    accept(typed) {
      const refusal = refused(knob, typed, text);
      if (!refusal) change(Number(typed));
      return refusal;
    },
  });
  const slider = createSlider({
    label: `${knob.symbol}, ${knob.label}`,
    onPlace: (place) => change(valueAt(knob, place)),
    onSteps: (steps) => change(stepped(steps)),
  });
  const reset = h("button", {
    type: "button",
    class: "reset-dot",
    "aria-label": `${knob.symbol}: ${text.reset(withUnit(knob, knob.default))}`,
    onclick: () => (hideTooltip(reset), change(knob.default)),
  });
  tooltip(reset, text.reset(withUnit(knob, knob.default)));
  const mark = h("button", {
    type: "button",
    class: "what-if-mark",
    hidden: true,
    onclick: () => (hideTooltip(mark), change(marked)),
  });
  tooltip(mark, () => mark.getAttribute("aria-label") ?? "");
  let marked = value;
  const histogram = hasHistogram(knob) ? createHistogram(knob) : null;
  const name = h(
    "span",
    { class: "threshold-name" },
    symbol(knob.symbol),
    h("span", { class: "threshold-label" }, knob.label),
  );
  const row = h(
    "div",
    { class: "threshold", "data-knob": knob.name },
    h("div", { class: "threshold-head" }, name, reset, field.element, h("span", { class: "unit" }, knob.unit)),
    h("div", { class: "slider-holder" }, slider.element, mark),
    field.error,
  );
  if (histogram) row.append(h("div", { class: "histogram-holder" }, histogram.element));
  const help = [knob.help, `${text.allowed(allowedRange(knob, text), "")}`].join("\n");
  tooltip(name, help, "left");
  slider.element.title = "";
  slider.element.setAttribute("aria-description", knob.help);
  if (histogram) {
    const holder = /** @type {HTMLElement} */ (histogram.element.parentElement);
    tooltip(holder, () => `${text.counts[knob.name]}\n${histogram.element.getAttribute("aria-label")}`, "left");
  }

  /** @param {number} next */
  function change(next) {
    field.clear();
    if (next === value) return;
    set(next);
    onChange(knob.name, next);
  }

  /** @param {number} steps */
  function stepped(steps) {
    if (!Number.isFinite(steps)) return steps < 0 ? knob.low : knob.high;
    const wanted = value + (Math.abs(steps) === 1 ? steps : Math.sign(steps) * PAGE) * knob.step;
    const next = snap(knob, clamp(wanted, knob.low, knob.high));
    // A typed value beyond the slider's ends must not jump back over the key's direction.
    return Math.sign(next - value) === Math.sign(steps) ? next : value;
  }

  /** @param {number} next */
  function set(next) {
    value = next;
    field.set(format(knob, next));
    slider.set(placeOf(knob, next), withUnit(knob, next));
    histogram?.cutAt(next);
    reset.classList.toggle("shown", next !== knob.default);
    reset.tabIndex = next === knob.default ? -1 : 0;
  }
  set(value);

  return {
    element: row,
    set,
    /** @param {string} message */
    refuse: (message) => field.refuse(message),
    /** The value at which the answer for the selected beam changes. @param {{value: number | null, text: string} | undefined} change */
    setMark(change) {
      mark.hidden = change === undefined || change.value === null;
      if (change === undefined || change.value === null) return;
      marked = change.value;
      mark.style.setProperty("--place", String(placeOf(knob, marked)));
      mark.setAttribute("aria-label", change.text);
    },
    /** @param {Histogram | undefined} shown */
    setHistogram(shown) {
      if (!histogram) return;
      /** @type {HTMLElement} */ (histogram.element.parentElement).hidden = !shown;
      const passed = sum(shown?.passed);
      const failed = sum(shown?.failed);
      histogram.set(shown, passed + failed ? text.histogram(knob.symbol, passed, failed) : text.histogramEmpty);
    },
  };
}

/** Why a typed value cannot be, or null. @param {Knob} knob @param {string} typed @param {Text} text */
function refused(knob, typed, text) {
  const value = typed === "" ? NaN : Number(typed);
  const range = allowedRange(knob, text);
  if (Number.isNaN(value)) return `${text.notANumber(typed)} ${text.allowed(range, "")}`;
  if (knob.kind === "int" && !Number.isInteger(value)) return `${text.notWhole} ${text.allowed(range, "")}`;
  if (value < knob.least || value > (knob.most ?? Infinity)) return text.allowed(range, knob.why);
  return null;
}

/** @param {Knob} knob @param {Text} text */
function allowedRange(knob, text) {
  const least = String(knob.least);
  return text.range(least, knob.most === null ? null : String(Number(knob.most.toPrecision(4))), knob.unit);
}

/** The paper's symbol with its index set lower: S_num. @param {string} name */
export function symbol(name) {
  const [base, index] = name.split("_");
  return h("span", { class: "symbol" }, h("i", {}, base), index ? h("sub", {}, index) : null);
}

/** @param {number[] | undefined} counts */
function sum(counts) {
  return (counts ?? []).reduce((total, count) => total + count, 0);
}
