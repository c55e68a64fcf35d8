// @ts-check
import { h } from "../widgets/dom.js";
import { createHistogram } from "../widgets/histogram.js";
import { createNumberField } from "../widgets/number.js";
import { clamp, format, placeOf, reaching, snap, valueAt, withUnit } from "../widgets/scale.js";
import { createSlider } from "../widgets/slider.js";
import { hideTooltip, tooltip } from "../widgets/tooltip.js";
import { allowedRange, refused } from "./allowed.js";
import { symbol } from "./symbol.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Histogram} Histogram */
/** @typedef {typeof import("../text/page.js").pageText.tune} Text */

const WITH_HISTOGRAM = new Set(["epsilon", "delta", "min_points", "min_length"]);
const PAGE = 10;

/** @param {Knob} knob */
export function hasHistogram(knob) {
  return WITH_HISTOGRAM.has(knob.name);
}

/** One threshold: symbol, typed value, slider and, if measured values are compared with it, their histogram. */
export class Threshold {
  /** Its slider reaches every value that was set on this recording. */ #knob;
  #declared;
  #text;
  #onChange;
  #value;
  /** The value at which the answer for the selected beam changes. */ #marked;
  #field;
  #slider;
  #reset;
  #mark;
  /** The value that fits the laser. @type {number | undefined} */ #fits;
  #tick;
  #histogram;

  /**
   * @param {Knob} knob
   * @param {Text} text
   * @param {(name: string, value: number) => void} onChange
   */
  constructor(knob, text, onChange) {
    this.#knob = this.#declared = knob;
    this.#text = text;
    this.#onChange = onChange;
    this.#value = this.#marked = knob.default;
    this.#field = createNumberField({
      label: `${knob.symbol}, ${knob.label}${knob.unit ? ` [${knob.unit}]` : ""}`,
      accept: (typed) => {
        const refusal = refused(knob, typed, text);
        if (!refusal) this.#change(Number(typed));
        return refusal;
      },
    });
    this.#slider = createSlider({
      label: `${knob.symbol}, ${knob.label}`,
      onPlace: (place) => this.#change(valueAt(this.#knob, place)),
      onSteps: (steps) => this.#change(this.#stepped(steps)),
    });
    this.#slider.element.title = "";
    this.#slider.element.setAttribute("aria-description", knob.help);
    this.#reset = button("reset-dot", () => this.#change(knob.default));
    this.#reset.setAttribute("aria-label", `${knob.symbol}: ${text.reset(withUnit(knob, knob.default))}`);
    tooltip(this.#reset, text.reset(withUnit(knob, knob.default)));
    this.#mark = button("what-if-mark", () => this.#change(this.#marked));
    this.#mark.hidden = true;
    tooltip(this.#mark, () => this.#mark.getAttribute("aria-label") ?? "");
    this.#tick = h("span", { class: "fit-mark", hidden: true });
    this.#histogram = hasHistogram(knob) ? createHistogram(knob) : null;
    this.element = this.#createRow();
    this.#nameEnds();
    this.set(this.#value);
  }

  #createRow() {
    const knob = this.#knob;
    const name = h(
      "span",
      { class: "threshold-name" },
      symbol(knob.symbol),
      h("span", { class: "threshold-label" }, knob.label),
    );
    tooltip(name, [knob.help, this.#text.allowed(allowedRange(knob, this.#text), "")].join("\n"), "left");
    const unit = h("span", { class: "unit" }, knob.unit);
    return h(
      "div",
      { class: "threshold", "data-knob": knob.name },
      h("div", { class: "threshold-head" }, name, this.#reset, this.#field.element, unit),
      h("div", { class: "slider-holder" }, this.#slider.element, this.#tick, this.#mark),
      this.#field.error,
      this.#holdHistogram(),
    );
  }

  #holdHistogram() {
    const picture = this.#histogram?.element;
    if (!picture) return null;
    const holder = h("div", { class: "histogram-holder" }, picture);
    const counted = () => `${this.#knob.counted}\n${picture.getAttribute("aria-label")}`;
    tooltip(holder, (event) => [counted(), this.#countedAt(event, picture)].filter(Boolean).join("\n"), "left");
    return holder;
  }

  /** What is counted under the pointer. @param {Event} event @param {Element} picture */
  #countedAt(event, picture) {
    const { left, width } = picture.getBoundingClientRect();
    const bin = event instanceof PointerEvent ? this.#histogram?.at((event.clientX - left) / width) : null;
    if (!bin) return "";
    const [from, to] = [bin.from, bin.to].map((edge) => Number(edge.toPrecision(2)));
    return this.#text.bin(`${from} – ${to} ${this.#knob.unit}`.trim(), bin.passed, bin.failed);
  }

  /** @param {number} next */
  #change(next) {
    this.#field.clear();
    if (next === this.#value) return;
    this.set(next);
    this.#onChange(this.#knob.name, next);
  }

  /** @param {number} steps */
  #stepped(steps) {
    const { low, high, step } = this.#knob;
    if (!Number.isFinite(steps)) return steps < 0 ? low : high;
    const wanted = this.#value + (Math.abs(steps) === 1 ? steps : Math.sign(steps) * PAGE) * step;
    const next = snap(this.#knob, clamp(wanted, low, high));
    // From a typed value beyond the ends of the slider, a key must not move in the opposite direction.
    return Math.sign(next - this.#value) === Math.sign(steps) ? next : this.#value;
  }

  /** The threshold with the range of its slider. */
  get knob() {
    return this.#knob;
  }

  /** @param {Knob} knob the same threshold with another range */
  #span(knob) {
    if (knob === this.#knob) return;
    this.#knob = knob;
    this.#histogram?.setRange(knob);
    this.#nameEnds();
    this.#mark.style.setProperty("--place", String(placeOf(knob, this.#marked)));
    this.#tick.style.setProperty("--place", String(placeOf(knob, this.#fits ?? 0)));
  }

  /** The values at both ends of the slider, and of the charts below it. */
  #nameEnds() {
    const { dataset } = this.element;
    [dataset.low, dataset.high] = [format(this.#knob, this.#knob.low), withUnit(this.#knob, this.#knob.high)];
  }

  /** Lets the slider span no more than it must: another recording was opened. */
  shrink() {
    this.#span(reaching(this.#declared, this.#value, this.#fits ?? this.#value));
    this.set(this.#value);
  }

  /** @param {number} next */
  set(next) {
    this.#span(reaching(this.#knob, next));
    const knob = this.#knob;
    this.#value = next;
    this.#field.set(format(knob, next));
    this.#slider.set(placeOf(knob, next), withUnit(knob, next));
    this.#histogram?.cutAt(next);
    this.#reset.classList.toggle("shown", next !== knob.default);
    this.#reset.tabIndex = next === knob.default ? -1 : 0;
    this.#tick.hidden = this.#fits === undefined || this.#fits === next;
  }

  /** @param {string} message */
  refuse(message) {
    this.#field.refuse(message);
  }

  /** The value at which the answer for the selected beam changes. @param {{value: number | null, text: string} | undefined} change */
  setMark(change) {
    this.#mark.hidden = change === undefined || change.value === null;
    if (change === undefined || change.value === null) return;
    this.#marked = change.value;
    this.#mark.style.setProperty("--place", String(placeOf(this.#knob, this.#marked)));
    this.#mark.setAttribute("aria-label", change.text);
  }

  /** Shows a tick at the value that fits the laser, a faint one if the present values are as good. @param {number | undefined} value @param {boolean} better */
  setFit(value, better) {
    this.#tick.classList.toggle("offered", better);
    if (value === this.#fits) return;
    this.#fits = value;
    this.#span(reaching(this.#knob, value ?? this.#value));
    this.#tick.style.setProperty("--place", String(placeOf(this.#knob, value ?? 0)));
    this.set(this.#value);
  }

  /** @param {Histogram | undefined} shown */
  setHistogram(shown) {
    if (!this.#histogram) return;
    const { histogram, histogramEmpty } = this.#text;
    /** @type {HTMLElement} */ (this.#histogram.element.parentElement).hidden = !shown;
    const [passed, failed] = [sum(shown?.passed), sum(shown?.failed)];
    this.#histogram.set(shown, passed + failed ? histogram(this.#knob.symbol, passed, failed) : histogramEmpty);
  }
}

/** @param {string} className @param {() => void} run */
function button(className, run) {
  const onclick = () => {
    hideTooltip(made);
    run();
  };
  const made = h("button", { type: "button", class: className, onclick });
  return made;
}

/** @param {number[] | undefined} counts */
function sum(counts) {
  return (counts ?? []).reduce((total, count) => total + count, 0);
}
