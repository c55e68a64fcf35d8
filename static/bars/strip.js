// @ts-check
// A score of every frame as colours behind the timeline's scrubber.
import { h, setText } from "../widgets/dom.js";
import { clamp } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Score} Score */
/** @typedef {import("../wire.js").Survey} Survey */
/** @typedef {{low: number, high: number}} Scale */

// From what is well to what is doubtful; lightness alone tells them apart, so no kind of colour vision is needed.
const LIGHT = [0xeceff2, 0xf7d59b, 0xe8903a, 0xb04410, 0x571908];
const DARK = [0x2c3239, 0x5f3c1d, 0xad5d18, 0xf0a043, 0xfff1c9];
const SHADES = 64;

/**
 * @param {typeof import("../text/en.js").text.timeline.strip} text
 * @param {{onScore: (score: string) => void, onChange: () => void}} handlers onChange: other values, or another score
 */
export function createStrip(text, { onScore, onChange }) {
  /** @type {Score[]} */
  let scores = [];
  let score = "";
  /** @type {Survey | null} */
  let survey = null;
  /** @type {State | null} */
  let state = null;
  let shades = shadesBetween(LIGHT);
  /** Of each score, over all that was seen of this recording: one colour means one value while thresholds change. @type {Map<string, Scale>} */
  const scales = new Map();
  /** The frame that each pixel shows. @type {Int32Array} */
  let shown = new Int32Array(0);
  /** Frames from the most doubtful to the least, once asked for. @type {Uint32Array | null} */
  let ranking = null;
  let rank = -1;
  /** The pixel under the pointer, −1 if it is elsewhere. */
  let hovered = -1;
  let painting = 0;

  const canvas = h("canvas", { class: "strip", height: 1, "aria-hidden": "true" });
  const note = h("div", { class: "strip-note muted", role: "status", hidden: true });
  const hint = h("div", { class: "strip-hint", hidden: true, "aria-hidden": "true" });
  const select = h("select", { class: "select", "aria-label": text.label, onchange: () => onScore(select.value) });
  const ramp = h("canvas", { class: "legend-ramp", width: SHADES, height: 1 });
  const low = h("span", { class: "legend-low" });
  const high = h("span", { class: "legend-high" });
  const legend = h("button", { type: "button", class: "legend muted", onclick: refit }, low, ramp, high);
  tooltip(select, () => [chosen()?.help, worse()].filter(Boolean).join("\n"));
  tooltip(legend, () => [worse(), text.scale, text.refit].filter(Boolean).join("\n"));
  new ResizeObserver(paintSoon).observe(canvas);

  const chosen = () => scores.find(({ name }) => name === score);
  const worse = () => text.worse[chosen()?.worse ?? "higher"];
  const complete = () => survey !== null && survey.message === null && survey.stride === 1;
  /** Whether the chosen score is still to come, because it takes many surveys. */
  const due = () => complete() && !values().length && score !== "difference";

  /** The values that are known of the chosen score; none if there is no survey. */
  function values() {
    const at = scores.findIndex(({ name }) => name === score);
    if (!survey || survey.message !== null || at < 0) return new Float32Array(0);
    return columnOf(survey, at);
  }

  /** The score of a frame, if it is known. @param {number} frame @returns {number | undefined} */
  function scoreOf(frame) {
    return survey && frame % survey.stride === 0 ? values()[frame / survey.stride] : undefined;
  }

  /** What a frame is called: of a live recording the oldest are gone. @param {number} frame */
  const number = (frame) => (survey?.first ?? 0) + frame + 1;

  /** @param {number} frame "coverage 0.83" */
  function words(frame) {
    const value = scoreOf(frame);
    const what = chosen();
    return value === undefined || !what ? "" : `${what.label} ${format(value, what.unit)}`;
  }

  function refit() {
    scales.delete(score);
    paintSoon();
  }

  function paintSoon() {
    if (!painting) painting = requestAnimationFrame(paint);
  }

  function paint() {
    painting = 0;
    const known = values();
    const width = Math.max(1, canvas.clientWidth);
    const what = chosen();
    const noA = !known.length && complete() && !state?.against;
    const message = survey && !due() ? (survey.message ?? (noA ? text.noA : "")) : text.pending;
    setText(note, message);
    note.hidden = message === "";
    note.title = message;
    legend.classList.toggle("blank", !known.length);
    canvas.hidden = !known.length;
    onChange();
    if (!survey || !known.length || !what) return;
    const scale = widened(scales.get(score), known);
    scales.set(score, scale);
    const sign = what.worse === "higher" ? 1 : -1;
    shown = worstOfPixels(known, survey, width, sign);
    canvas.width = width;
    const { stride } = survey;
    fill(canvas, shades, (x) => share(known[shown[x] / stride], scale, sign));
    fill(ramp, shades, (x) => (sign > 0 ? x / (SHADES - 1) : 1 - x / (SHADES - 1)));
    setText(low, format(scale.low, what.unit));
    setText(high, format(scale.high, what.unit));
    legend.setAttribute(
      "aria-label",
      text.legend(what.label, format(scale.low, what.unit), format(scale.high, what.unit)),
    );
  }

  /** Whether the colours belong to other thresholds than the picture above, or to some of the frames only. */
  function showStale() {
    const same =
      !survey || !state || (survey.stride === 1 && samePlace(survey, state) && sameParams(survey.params, state.params));
    canvas.classList.toggle("stale", !same);
  }

  /** @param {PointerEvent} event */
  function hover({ clientX }) {
    const { left, width } = canvas.getBoundingClientRect();
    const x = clientX - left;
    hovered = shown.length && survey?.message === null ? pixelOf(x / width, shown.length) : -1;
    const frame = hovered < 0 ? -1 : shown[hovered];
    const said = frame < 0 ? "" : words(frame);
    hint.hidden = said === "";
    if (!said) return;
    setText(hint, text.hint(number(frame), said));
    const half = hint.offsetWidth / 2;
    hint.style.left = `${Math.round(clamp(x + canvas.offsetLeft, half, canvas.offsetLeft + canvas.clientWidth - half))}px`;
  }

  return {
    /** What goes into the track, behind the scrubber. */
    backdrop: [canvas, note, hint],
    /** What stands beside it. */
    chooser: h("span", { class: "strip-chooser" }, select, legend),
    words,
    number,

    /** @param {HTMLElement} track */
    watch(track) {
      for (const kind of /** @type {const} */ (["pointerdown", "pointermove"]))
        track.addEventListener(kind, hover, true);
      track.addEventListener("pointerleave", () => {
        hovered = -1;
        hint.hidden = true;
      });
    },

    /** @param {Score[]} next */
    setScores(next) {
      scores = next;
      select.replaceChildren(...next.map(({ name, label, help }) => h("option", { value: name, title: help }, label)));
      select.value = score;
      paintSoon();
    },

    /** @param {string} next @param {boolean} dark */
    show(next, dark) {
      const wanted = shadesBetween(dark ? DARK : LIGHT);
      if (next === score && wanted === shades) return;
      [score, shades, ranking, rank] = [next, wanted, null, -1];
      select.value = next;
      paintSoon();
    },

    /** @param {Survey} next */
    setSurvey(next) {
      if (state && !samePlace(next, state)) return;
      [survey, ranking, rank] = [next, null, -1];
      showStale();
      paintSoon();
    },

    /** @param {State} next */
    setState(next) {
      state = next;
      if (survey && !samePlace(survey, next)) {
        survey = null;
        scales.clear();
        paintSoon();
      }
      showStale();
    },

    /** Where the pointer means to go: to the frame that its pixel shows and the hint names. @param {number} frame as the scrubber tells */
    snap(frame) {
      if (!survey || survey.message !== null || survey.stride > 1 || !shown.length) return frame;
      const pixel = pixelOf(frame / (survey.frames - 1), shown.length);
      if (Math.abs(hovered - pixel) <= 1) return shown[hovered];
      return survey.frames > shown.length ? shown[pixel] : frame;
    },

    /** The next (1) or former (−1) in the order of doubt, the worst to begin with; null if it is not known yet. @param {number} frame @param {1 | -1} by */
    doubtful(frame, by) {
      const known = values();
      if (!survey || survey.stride > 1 || !known.length) return null;
      const sign = chosen()?.worse === "lower" ? 1 : -1;
      ranking ??= Uint32Array.from(known.keys()).sort(
        (one, other) => sign * (known[one] - known[other]) || one - other,
      );
      rank = ranking[rank] === frame ? clamp(rank + by, 0, known.length - 1) : 0;
      return ranking[rank];
    },

    /** The next frame, after the last the first, in which A and B differ; null if there is none. @param {number} frame */
    different(frame) {
      const known =
        survey && complete()
          ? columnOf(
              survey,
              scores.findIndex(({ name }) => name === "difference"),
            )
          : [];
      for (let k = 1; k <= known.length; k++) {
        const next = (frame + k) % known.length;
        if (known[next] > 0) return next;
      }
      return null;
    },

    /** All scores of a frame, "coverage 0.83 · segments 7". @param {number} frame */
    summary(frame) {
      if (!survey || !complete()) return "";
      const found = survey;
      const said = scores.map((what, k) => ({ what, value: columnOf(found, k)[frame] }));
      return said
        .filter(({ what, value }) => value !== undefined && what.name !== score)
        .map(({ what, value }) => `${what.label} ${format(value, what.unit)}`)
        .join(" · ");
    },

    /** For scripts and tests. */
    get current() {
      if (!survey) return null;
      const { recording, params, stride, message } = survey;
      return Object.freeze({
        score,
        values: values().slice(),
        recording,
        params,
        stride,
        message,
        complete: complete() && !due(),
      });
    },
  };
}

/** The values of the score at a place in the list, of every stride-th frame; none if it was not told. @param {Survey} survey @param {number} at */
function columnOf({ frames, stride, values }, at) {
  const known = Math.ceil(frames / stride);
  const column = values.subarray(at * known, (at + 1) * known);
  return Number.isNaN(column[0]) ? column.subarray(0, 0) : column;
}

/**
 * The frame that each pixel shows: the most doubtful of those under it.
 * @param {Float32Array} known every stride-th frame
 * @param {{frames: number, stride: number}} survey
 * @param {number} width
 * @param {1 | -1} sign of what is worse
 */
function worstOfPixels(known, { frames, stride }, width, sign) {
  const shown = new Int32Array(width);
  if (known.length <= width) {
    const perPixel = (frames - 1) / width / stride;
    for (let x = 0; x < width; x++) shown[x] = stride * Math.min(known.length - 1, Math.round((x + 0.5) * perPixel));
    return shown;
  }
  shown.fill(-1);
  for (let k = 0; k < known.length; k++) {
    const x = pixelOf((k * stride) / (frames - 1), width);
    if (shown[x] < 0 || sign * (known[k] - known[shown[x] / stride]) > 0) shown[x] = k * stride;
  }
  return shown;
}

/** @param {number} place 0 to 1 @param {number} width */
function pixelOf(place, width) {
  return clamp(Math.floor(place * width), 0, width - 1);
}

/** @param {Scale | undefined} scale @param {Float32Array} known @returns {Scale} */
function widened(scale, known) {
  let { low, high } = scale ?? { low: Infinity, high: -Infinity };
  for (const value of known) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return { low, high };
}

/** How doubtful a value is, from 0 to 1. @param {number} value @param {Scale} scale @param {1 | -1} sign */
function share(value, { low, high }, sign) {
  if (high <= low) return 0;
  return (sign > 0 ? value - low : high - value) / (high - low);
}

/** @param {HTMLCanvasElement} canvas one pixel high @param {Uint32Array} shades @param {(x: number) => number} place 0 to 1 */
function fill(canvas, shades, place) {
  const pen = canvas.getContext("2d");
  if (!pen) return;
  const image = pen.createImageData(canvas.width, 1);
  const pixels = new Uint32Array(image.data.buffer);
  for (let x = 0; x < canvas.width; x++) pixels[x] = shades[Math.round(place(x) * (SHADES - 1))];
  pen.putImageData(image, 0, 0);
}

/** @type {Map<number[], Uint32Array>} */
const made = new Map();

/** Colours as pixels (ABGR), evenly between the given ones. @param {number[]} stops */
function shadesBetween(stops) {
  const kept = made.get(stops);
  if (kept) return kept;
  const shades = new Uint32Array(SHADES);
  for (let k = 0; k < SHADES; k++) {
    const at = (k / (SHADES - 1)) * (stops.length - 1);
    const from = Math.min(Math.floor(at), stops.length - 2);
    const mixed = [16, 8, 0].map((shift) => {
      const [one, other] = [(stops[from] >> shift) & 255, (stops[from + 1] >> shift) & 255];
      return Math.round(one + (at - from) * (other - one));
    });
    shades[k] = (255 << 24) | (mixed[2] << 16) | (mixed[1] << 8) | mixed[0];
  }
  made.set(stops, shades);
  return shades;
}

/** @param {Survey} survey @param {State} state */
function samePlace(survey, state) {
  return survey.recording === state.recording && survey.topic === (state.topic ?? "");
}

/** @param {import("../wire.js").Params} one @param {import("../wire.js").Params} other */
function sameParams(one, other) {
  return Object.entries(one).every(([name, value]) => other[name] === value);
}

/** @param {number} value @param {string} unit */
function format(value, unit) {
  const digits = Number.isInteger(value) ? 0 : Math.abs(value) >= 10 ? 1 : unit && Math.abs(value) < 0.1 ? 3 : 2;
  return unit ? `${value.toFixed(digits)} ${unit}` : value.toFixed(digits);
}
