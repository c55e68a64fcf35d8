// @ts-check
// The frames of the recording, most doubtful first.
import { h, setText } from "../widgets/dom.js";
import { createNumberField } from "../widgets/number.js";
import { clamp } from "../widgets/scale.js";
import { FrameList } from "./frame_list.js";

/** @typedef {import("../wire.js").Score} Score */
/** @typedef {{score: string, recording: string, values: Float32Array, complete: boolean, message: string | null}} Scored */
/** @typedef {typeof import("../text/inspect.js").inspectText.frames} Text */
/**
 * @typedef {object} Handlers
 * @property {(frame: number) => void} onFrame
 * @property {(score: string) => void} onScore
 * @property {(place: number) => number} number the number of the frame at a place
 * @property {(frame: number) => string} value its score, in words
 * @property {(frame: number) => string} words what looks wrong in it
 * @property {HTMLElement} said all that looks wrong in the frame on the screen
 * @property {(frame: number) => boolean} passes whether it is listed
 * @property {() => void} onRows other frames became visible
 * @property {HTMLElement} extra below the score
 * @property {HTMLElement} filter below the range
 */

/** @param {Text} text @param {Handlers} handlers */
export function createFrames(text, handlers) {
  return new Frames(text, handlers);
}

class Frames {
  #text;
  #passes;
  #number;
  #onFrame;
  /** @type {Scored | null} */ #scored = null;
  /** @type {Score[]} */ #scores = [];
  #recording = "";
  #frame = 0;
  /** The last frame that was opened from the list. */ #led = -1;
  /** Whether the first frame of the list is to be opened once it is known. */ #leads = false;
  /** The score and the recording of the range. */ #ranged = "";
  /** Range of the listed scores. */ #low = -Infinity;
  #high = Infinity;
  #fields;
  #select;
  #help = h("p", { class: "hint" });
  #extra;
  #count = h("span", { class: "muted frames-count", role: "status" });
  #note = h("p", { class: "hint" });
  #list;

  /** @param {Text} text @param {Handlers} handlers */
  constructor(text, { onFrame, onScore, number, value, words, said, passes, onRows, extra, filter }) {
    this.#text = text;
    this.#passes = passes;
    this.#number = number;
    this.#onFrame = onFrame;
    this.#extra = extra;
    const select = h("select", { class: "select", "aria-label": text.score, onchange: () => onScore(select.value) });
    this.#select = select;
    const from = this.#limit(text.from, (typed) => {
      this.#low = typed ?? -Infinity;
    });
    const to = this.#limit(text.to, (typed) => {
      this.#high = typed ?? Infinity;
    });
    this.#list = new FrameList(text, { value, words, said, onRows, onTake: (frame) => this.#go(frame) });
    this.#fields = [from, to];
    const [fromLabel, toLabel] = [h("label", {}, text.from), h("label", {}, text.to)];
    this.element = h(
      "div",
      { class: "frames" },
      h("div", { class: "frames-head" }, h("label", {}, text.score), select),
      this.#help,
      extra,
      h("div", { class: "frames-head" }, fromLabel, from.element, toLabel, to.element, this.#count),
      from.error,
      to.error,
      filter,
      this.#note,
      this.#list.element,
    );
  }

  /** @param {string} end @param {(typed: number | null) => void} set */
  #limit(end, set) {
    const field = createNumberField({
      label: this.#text.rangeLabel(end),
      className: "frames-limit",
      accept: (typed) => {
        const wanted = typed.trim() === "" ? null : Number(typed);
        if (Number.isNaN(wanted)) return this.#text.notANumber(typed);
        set(wanted);
        field.set(typed.trim());
        this.sort();
        return null;
      },
    });
    field.element.placeholder = this.#text.any;
    return field;
  }

  #clearRange() {
    [this.#low, this.#high] = [-Infinity, Infinity];
    for (const field of this.#fields) {
      field.clear();
      field.set("");
    }
  }

  /** Updates which frames are listed. */
  sort() {
    const what = this.#scores.find(({ name }) => name === this.#scored?.score);
    const known = this.#scored?.complete ? this.#scored.values : new Float32Array(0);
    const sign = what?.worse === "lower" ? 1 : -1;
    const order = [...known.keys()]
      .filter((k) => !(known[k] < this.#low || known[k] > this.#high) && this.#passes(this.#number(k)))
      .sort((one, other) => sign * (known[one] - known[other]) || one - other)
      .map(this.#number);
    setText(this.#help, what?.help ?? "");
    setText(this.#count, known.length ? this.#text.count(order.length, known.length) : "");
    setText(this.#note, known.length ? this.#text.none : (this.#scored?.message ?? this.#text.pending));
    this.#note.hidden = order.length > 0;
    this.#list.setOrder(order);
  }

  /** @param {number} frame */
  #go(frame) {
    this.#led = frame;
    this.#list.reveal(frame);
    this.#onFrame(frame);
  }

  /** The words about frames may have changed. */
  paint() {
    this.#list.paint();
  }

  /** The frames that are in view. */
  get inView() {
    return this.#list.inView;
  }

  /** The next or previous frame of the list, starting with its first. @param {1 | -1} by */
  next(by) {
    const { order } = this.#list;
    const at = this.#led === this.#frame ? order.indexOf(this.#frame) : -1;
    if (order.length) this.#go(order[at < 0 ? 0 : clamp(at + by, 0, order.length - 1)]);
  }

  /** Opens the first frame of the list once it is known, unless a person chose a frame. */
  lead() {
    this.#leads = this.#frame === this.#number(0);
  }

  /** @param {Score[]} scores */
  setScores(scores) {
    this.#scores = scores;
    this.#select.replaceChildren(...scores.map(({ name, label }) => h("option", { value: name }, label)));
  }

  /** @param {Scored | null} scored the scores of every frame, null while there are none */
  setScored(scored) {
    const is = scored && `${scored.score} ${scored.recording}`;
    // The range is of one score of one recording.
    if (is && this.#ranged && is !== this.#ranged) this.#clearRange();
    this.#scored = scored;
    if (is) this.#ranged = is;
    if (scored) this.#select.value = scored.score;
    this.#extra.hidden = scored?.score !== "suspicion";
    this.sort();
    if (this.#leads && scored?.complete && scored.score === "suspicion" && scored.recording === this.#recording) {
      this.#leads = false;
      this.next(1);
    }
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ recording, frame, selected, step }) {
    this.#recording = recording;
    if (recording.startsWith("live:") || selected !== null || step !== null) this.#leads = false;
    if (frame === this.#frame) return;
    this.#frame = frame;
    this.#leads = false;
    this.#list.setFrame(frame);
  }
}
