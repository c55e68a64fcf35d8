// @ts-check
// Words of what the texts of lessons let one try.

export const shownText = {
  fits: {
    label: "Points and two lines through them",
    point: (/** @type {number} */ n) => `Point ${n}: drag it, or move it with the arrow keys`,
    across: "distances across the line",
    vertical: "vertical distances",
    turn: "Turn the wall by 30°",
    sums: (/** @type {number} */ across, /** @type {number | null} */ vertical) =>
      `On average (rms) the points lie ${mm(across)} from the first line${
        vertical === null ? "; no line has the smallest vertical distances" : ` and ${mm(vertical)} from the second`
      }.`,
  },
  noise: {
    measuring: "Measuring the noise of this recording…",
    unknown: "The noise of this recording cannot be measured.",
    says: (/** @type {number} */ sigma, /** @type {number} */ epsilon, /** @type {number} */ times) =>
      `Ranges scatter by σ = ${sigma.toFixed(0)} mm. ε = ${epsilon.toFixed(0)} mm is ${times.toFixed(1)} σ.`,
  },
  times: {
    measure: "Measure on this machine",
    stored: "Show the stored times",
    measuring: "Measuring…",
    nothing: "Nothing has been measured yet",
    frames: "frames of the recording",
    says: (
      /** @type {string} */ one,
      /** @type {string} */ other,
      /** @type {number} */ ratio,
      /** @type {string} */ machine,
    ) =>
      `${
        ratio >= 1
          ? `${other} takes ${ratio.toFixed(1)} times as long as ${one}`
          : `${one} takes ${(1 / ratio).toFixed(1)} times as long as ${other}`
      }. Measured on ${machine}.`,
    tick: (/** @type {number} */ us) => (us < 1000 ? `${us} µs` : `${us / 1000} ms`),
    head: ["ms for a frame", "mean", "std", "min", "max"],
  },
  beside: {
    label: "The other method",
    method: "Method",
    methods: /** @type {[string, string][]} */ ([
      ["iterative-end-point-fit", "Iterative end-point fit"],
      ["split-and-merge", "Split-and-Merge"],
    ]),
    waiting: "Loading its decisions…",
    place: (/** @type {number} */ n, /** @type {number} */ all) => `Decision ${n} of ${all}`,
    scene: "The same scan by the other method",
  },
  label: {
    label: "Ten frames to label",
    loading: "Loading ten frames…",
    picture: (/** @type {number} */ frame) => `Frame ${frame} with the lines that were found`,
    lines: "The lines of this frame",
    line: (
      /** @type {number} */ n,
      /** @type {number} */ first,
      /** @type {number} */ last,
      /** @type {boolean} */ wrong,
    ) => `Line ${n}, beams ${first} to ${last}: ${wrong ? "no wall" : "a wall"}`,
    place: (
      /** @type {number} */ n,
      /** @type {number} */ all,
      /** @type {number} */ frame,
      /** @type {boolean} */ done,
    ) => `${n} of ${all} · frame ${frame}${done ? " · labelled" : ""}`,
    back: "Previous frame",
    forth: "Following frame",
    missed: "Missed walls",
    less: "One missed wall less",
    more: "One missed wall more",
    ready: "Frame is labelled",
    begin:
      "Click each line that is no wall, or only a piece of one that another line already stands for. Count walls without a line as missed.",
    says: (/** @type {number} */ frames, /** @type {Counted} */ counted) =>
      `${frames === 1 ? "1 frame" : `${frames} frames`}: ${rates(counted)}`,
    known: (/** @type {Counted} */ counted) => `By the known walls of the same frames: ${rates(counted)}`,
  },
};

/** @typedef {import("../wire.js").Counted} Counted */

/** TR and FR with their numbers. @param {Counted} counted */
function rates({ true: walls, found, matched }) {
  const share = (/** @type {number} */ part, /** @type {number} */ whole) =>
    whole ? `${part} / ${whole} = ${((100 * part) / whole).toFixed(1)} %` : "–";
  return `TR = ${share(matched, walls)}, FR = ${share(found - matched, found)}.`;
}

/** @param {number} metres */
function mm(metres) {
  return `${(1000 * metres).toFixed(0)} mm`;
}
