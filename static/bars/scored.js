// @ts-check
// The scores of the frames: the newest survey, and what follows from it.
import { isIn } from "../view/key.js";
import { clamp } from "../widgets/scale.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Score} Score */
/** @typedef {import("../wire.js").Survey} Survey */

export class ScoredFrames {
  /** @type {Score[]} */
  scores = [];
  /** @type {Survey | null} */
  survey = null;
  /** @type {State | null} */
  #state = null;
  #score = "";
  /** Frames from the most to the least doubtful, once requested. @type {Uint32Array | null} */
  #ranking = null;
  #rank = -1;

  /** The name of the selected score. */
  get score() {
    return this.#score;
  }
  set score(name) {
    this.#score = name;
    this.#forgetRanking();
  }

  get chosen() {
    return this.scores.find(({ name }) => name === this.#score);
  }

  get complete() {
    return this.survey !== null && this.survey.message === null && this.survey.stride === 1;
  }

  /** Whether the selected score is not available yet because it takes many surveys. */
  get due() {
    return this.complete && !this.values.length && this.#score !== "difference";
  }

  /** Whether the selected score needs a pinned result and there is none. */
  get lacksPinned() {
    return !this.values.length && this.complete && !this.#state?.against;
  }

  /** The known values of the selected score; none if there is no survey. */
  get values() {
    return this.column(this.#score);
  }

  /** The known values of a score; none if they were not sent. @param {string} name */
  column(name) {
    const at = this.scores.findIndex((score) => score.name === name);
    return this.survey && this.survey.message === null && at >= 0 ? columnOf(this.survey, at) : new Float32Array(0);
  }

  /** "frame 12: 0.83 m"; of frames that were passed over, nothing. @param {Score} score @param {number} frame */
  valueWords(score, frame) {
    const place = this.#place(frame) / (this.survey?.stride ?? 1);
    const value = this.column(score.name)[place];
    return value === undefined ? "" : `frame ${frame}: ${format(value, score.unit)}`;
  }

  /** Whether the values belong to other thresholds than the drawn ones, or only to some frames. */
  get stale() {
    const [survey, state] = [this.survey, this.#state];
    if (!survey || !state) return false;
    return survey.stride !== 1 || !samePlace(survey, state) || !isIn(survey.params, state.params);
  }

  /** The number in its file or source of the frame at a place in the survey, from 0. @param {number} place */
  number = (place) => (this.survey?.first ?? 0) + (this.survey?.every ?? 1) * place;

  /** @param {number} frame its number */
  #place = (frame) => (frame - (this.survey?.first ?? 0)) / (this.survey?.every ?? 1);

  /** @param {number} frame "coverage 0.83" */
  words = (frame) => {
    const place = this.#place(frame);
    const value = this.survey && place % this.survey.stride === 0 ? this.values[place / this.survey.stride] : undefined;
    return value === undefined || !this.chosen ? "" : `${this.chosen.label} ${format(value, this.chosen.unit)}`;
  };

  /** All scores of a frame, "coverage 0.83 · segments 7". @param {number} frame */
  summary = (frame) => {
    const survey = this.survey;
    if (!survey || !this.complete) return "";
    const said = this.scores.map((what, k) => ({ what, value: columnOf(survey, k)[this.#place(frame)] }));
    return said
      .filter(({ what, value }) => value !== undefined && what.name !== this.#score)
      .map(({ what, value }) => `${what.label} ${format(value, what.unit)}`)
      .join(" · ");
  };

  /** @param {Survey} next @returns {boolean} false if it is of another recording than what is drawn */
  take(next) {
    if (this.#state && !samePlace(next, this.#state)) return false;
    this.survey = next;
    this.#forgetRanking();
    return true;
  }

  /** @param {State} next @returns {boolean} whether the survey was of another recording, and is gone */
  draw(next) {
    this.#state = next;
    if (!this.survey || samePlace(this.survey, next)) return false;
    this.survey = null;
    return true;
  }

  /** The next (1) or previous (−1) frame in the order of doubt, worst first; null if it is not known yet. @param {number} frame @param {1 | -1} by */
  doubtful(frame, by) {
    const known = this.values;
    if (!this.survey || this.survey.stride > 1 || !known.length) return null;
    const sign = this.chosen?.worse === "lower" ? 1 : -1;
    this.#ranking ??= Uint32Array.from(known.keys()).sort(
      (one, other) => sign * (known[one] - known[other]) || one - other,
    );
    this.#rank = this.#ranking[this.#rank] === this.#place(frame) ? clamp(this.#rank + by, 0, known.length - 1) : 0;
    return this.number(this.#ranking[this.#rank]);
  }

  /** The next frame where A and B differ, starting again from the first after the last; null if there is none. @param {number} frame */
  different(frame) {
    const at = this.scores.findIndex(({ name }) => name === "difference");
    const known = this.survey && this.complete ? columnOf(this.survey, at) : [];
    for (let k = 1; k <= known.length; k++) {
      const next = (this.#place(frame) + k) % known.length;
      if (known[next] > 0) return this.number(next);
    }
    return null;
  }

  /** For the list of frames, scripts and tests. */
  get current() {
    if (!this.survey) return null;
    const { recording, params, stride, message } = this.survey;
    const complete = this.complete && !this.due;
    return Object.freeze({
      score: this.#score,
      values: this.values.slice(),
      recording,
      params,
      stride,
      message,
      complete,
    });
  }

  #forgetRanking() {
    [this.#ranking, this.#rank] = [null, -1];
  }
}

/** The values of the k-th score for every stride-th frame; none if they were not sent. @param {Survey} survey @param {number} at */
function columnOf({ frames, stride, values }, at) {
  const known = Math.ceil(frames / stride);
  const column = values.subarray(at * known, (at + 1) * known);
  return Number.isNaN(column[0]) ? column.subarray(0, 0) : column;
}

/** @param {Survey} survey @param {State} state */
function samePlace(survey, state) {
  return survey.place === state.place;
}

/** @param {number} value @param {string} unit */
export function format(value, unit) {
  const digits = Number.isInteger(value) ? 0 : Math.abs(value) >= 10 ? 1 : unit && Math.abs(value) < 0.1 ? 3 : 2;
  return unit ? `${value.toFixed(digits)} ${unit}` : value.toFixed(digits);
}
