// @ts-check
// A score of every frame as colours behind the timeline's scrubber.
import { h, setText } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { format, ScoredFrames } from "./scored.js";
import { DARK, fill, LIGHT, pixelOf, SHADES, shadesBetween, share, widened, worstOfPixels } from "./shades.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Score} Score */
/** @typedef {import("../wire.js").Survey} Survey */
/** @typedef {import("./shades.js").Scale} Scale */
/** @typedef {import("./times.js").Gap} Gap */
/** @typedef {typeof import("../text/page.js").pageText.timeline.strip} Text */

// How near the pointer must be to the mark of a gap.
const NEAR_PX = 4;

export class Strip {
  frames = new ScoredFrames();
  #text;
  #onChange;
  #shades = shadesBetween(LIGHT);
  /** The range of each score over everything seen of this recording, so that a colour keeps its value while thresholds change. @type {Map<string, Scale>} */
  #scales = new Map();
  /** The frame that each pixel shows. @type {Int32Array} */
  #shown = new Int32Array(0);
  /** The pixel under the pointer, −1 if it is elsewhere. */
  #hovered = -1;
  #painting = 0;
  #canvas = h("canvas", { class: "strip", height: 1, "aria-hidden": "true" });
  /** Where the stamps have gaps. @type {Gap[]} */
  #gaps = [];
  #count = 0;
  #marks = h("canvas", { class: "strip-gaps", height: 1, "aria-hidden": "true" });
  #note = h("div", { class: "strip-note muted", role: "status", hidden: true });
  #hint = h("div", { class: "strip-hint", hidden: true, "aria-hidden": "true" });
  #ramp = h("canvas", { class: "legend-ramp", width: SHADES, height: 1 });
  #low = h("span", { class: "legend-low" });
  #high = h("span", { class: "legend-high" });
  #select;
  #legend;

  /**
   * @param {Text} text
   * @param {{onScore: (score: string) => void, onChange: () => void}} handlers onChange: other values, or another score
   */
  constructor(text, { onScore, onChange }) {
    this.#text = text;
    this.#onChange = onChange;
    const select = h("select", { class: "select", "aria-label": text.label, onchange: () => onScore(select.value) });
    const legend = h(
      "button",
      { type: "button", class: "legend muted", onclick: () => this.#refit() },
      this.#low,
      this.#ramp,
      this.#high,
    );
    const worse = () => text.worse[this.frames.chosen?.worse ?? "higher"];
    tooltip(select, () => [this.frames.chosen?.help, worse()].filter(Boolean).join("\n"));
    tooltip(legend, () => [worse(), text.scale, text.refit].filter(Boolean).join("\n"));
    new ResizeObserver(() => this.#paintSoon()).observe(this.#canvas);
    new ResizeObserver(() => this.#paintGaps()).observe(this.#marks);
    this.#select = select;
    this.#legend = legend;
    /** The element for the track, behind the scrubber. */
    this.backdrop = [this.#canvas, this.#marks, this.#note, this.#hint];
    /** The element beside the track. */
    this.chooser = h("span", { class: "strip-chooser" }, select, legend);
  }

  /** @param {HTMLElement} track */
  watch(track) {
    for (const kind of /** @type {const} */ (["pointerdown", "pointermove"]))
      track.addEventListener(kind, (event) => this.#hover(event), true);
    track.addEventListener("pointerleave", () => {
      this.#hovered = -1;
      this.#hint.hidden = true;
    });
  }

  /** @param {Score[]} next */
  setScores(next) {
    this.frames.scores = next;
    this.#select.replaceChildren(
      ...next.map(({ name, label, help }) => h("option", { value: name, title: help }, label)),
    );
    this.#select.value = this.frames.score;
    this.#paintSoon();
  }

  /** @param {string} score @param {boolean} dark */
  show(score, dark) {
    const wanted = shadesBetween(dark ? DARK : LIGHT);
    if (score === this.frames.score && wanted === this.#shades) return;
    this.#shades = wanted;
    requestAnimationFrame(() => this.#paintGaps());
    this.frames.score = this.#select.value = score;
    this.#paintSoon();
  }

  /** @param {Survey} next */
  setSurvey(next) {
    if (!this.frames.take(next)) return;
    this.#showStale();
    this.#paintSoon();
  }

  /** @param {State} next */
  setState(next) {
    if (this.frames.draw(next)) {
      this.#scales.clear();
      this.#paintSoon();
    }
    this.#showStale();
  }

  /** The frame for a click: the one that the pixel shows and the hint names. @param {number} frame as the scrubber tells */
  snap(frame) {
    const { survey } = this.frames;
    const shown = this.#shown;
    if (!survey || survey.message !== null || survey.stride > 1 || !shown.length) return frame;
    const pixel = pixelOf(frame / (survey.frames - 1), shown.length);
    if (Math.abs(this.#hovered - pixel) <= 1) return shown[this.#hovered];
    return survey.frames > shown.length ? shown[pixel] : frame;
  }

  #refit() {
    this.#scales.delete(this.frames.score);
    this.#paintSoon();
  }

  #paintSoon() {
    if (!this.#painting) this.#painting = requestAnimationFrame(() => this.#paint());
  }

  #paint() {
    this.#painting = 0;
    const { values, survey, due, chosen, lacksPinned } = this.frames;
    const text = this.#text;
    const message = survey && !due ? (survey.message ?? (lacksPinned ? text.noA : "")) : text.pending;
    setText(this.#note, message);
    this.#note.hidden = message === "";
    this.#note.title = message;
    this.#legend.classList.toggle("blank", !values.length);
    this.#canvas.hidden = !values.length;
    this.#onChange();
    if (survey && values.length && chosen) this.#paintValues(values, survey, chosen);
  }

  /** @param {Float32Array} known @param {Survey} survey @param {Score} chosen */
  #paintValues(known, survey, { name, label, unit, worse }) {
    const scale = widened(this.#scales.get(name), known);
    this.#scales.set(name, scale);
    const sign = worse === "higher" ? 1 : -1;
    const width = Math.max(1, this.#canvas.clientWidth);
    const shown = worstOfPixels(known, survey, width, sign);
    this.#shown = shown;
    this.#canvas.width = width;
    fill(this.#canvas, this.#shades, (x) => share(known[shown[x] / survey.stride], scale, sign));
    fill(this.#ramp, this.#shades, (x) => (sign > 0 ? x / (SHADES - 1) : 1 - x / (SHADES - 1)));
    const [low, high] = [format(scale.low, unit), format(scale.high, unit)];
    setText(this.#low, low);
    setText(this.#high, high);
    this.#legend.setAttribute("aria-label", this.#text.legend(label, low, high));
  }

  #showStale() {
    this.#canvas.classList.toggle("stale", this.frames.stale);
  }

  /** How long no scan came, if a gap is marked here; the longest of several. @param {number} x @param {number} width [px] */
  #gapAt(x, width) {
    const near = this.#gaps.filter((gap) => Math.abs(this.#shareOf(gap) * width - x) <= NEAR_PX);
    const longest = near.sort((one, other) => other.seconds - one.seconds)[0];
    return longest ? this.#text.gap(longest.seconds, this.frames.number(longest.place)) : "";
  }

  /** A gap lies between two frames. @param {Gap} gap */
  #shareOf({ place }) {
    return (place - 0.5) / (this.#count - 1);
  }

  /** @param {Gap[]} gaps @param {number} frames */
  setGaps(gaps, frames) {
    [this.#gaps, this.#count] = [gaps, frames];
    this.#paintGaps();
  }

  #paintGaps() {
    const marks = this.#marks;
    const [width, context] = [Math.max(1, marks.clientWidth), marks.getContext("2d")];
    marks.width = width;
    if (!context) return;
    context.fillStyle = getComputedStyle(marks).color;
    for (const gap of this.#gaps) context.fillRect(Math.round(this.#shareOf(gap) * width) - 1, 0, 2, marks.height);
  }

  /** @param {PointerEvent} event */
  #hover({ clientX }) {
    const { left, width } = this.#marks.getBoundingClientRect();
    const x = clientX - left;
    const shown = this.#shown;
    const usable = shown.length && this.frames.survey?.message === null;
    this.#hovered = usable ? pixelOf(x / width, shown.length) : -1;
    const frame = this.#hovered < 0 ? -1 : this.frames.number(shown[this.#hovered]);
    const words = frame < 0 ? "" : this.frames.words(frame);
    const said = [words && this.#text.hint(frame, words), this.#gapAt(x, width)].filter(Boolean).join(" · ");
    this.#hint.hidden = said === "";
    if (!said) return;
    setText(this.#hint, said);
    const half = this.#hint.offsetWidth / 2;
    const { offsetLeft, clientWidth } = this.#marks;
    this.#hint.style.left = `${Math.round(clamp(x + offsetLeft, half, offsetLeft + clientWidth - half))}px`;
  }
}
