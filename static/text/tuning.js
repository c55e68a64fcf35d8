// @ts-check
// Words of sensitivity curves, map and auto-tuning.

export const tuningText = {
  pages: { map: "Map", auto: "Auto" },
  curves: {
    label: "Sensitivity",
    show: "Sensitivity",
    help: "Under each slider: what the whole recording would give with this threshold elsewhere, and the others as they are. Click to go there.",
    sample: (/** @type {number} */ frames, /** @type {number} */ of) =>
      frames < of
        ? `${frames.toLocaleString("en")} of ${of.toLocaleString("en")} frames`
        : `all ${of.toLocaleString("en")} frames`,
    pending: "computing…",
    picture: (/** @type {string} */ symbol) => `Sensitivity to ${symbol}: click to set it`,
    short: /** @type {Record<string, string>} */ ({
      coverage: "coverage",
      segments: "segments",
      true_rate: "TR",
      false_rate: "FR",
      completeness: "compl.",
    }),
  },
  map: {
    x: "Across",
    y: "Up",
    measure: "Measure",
    picture: (/** @type {string} */ measure, /** @type {string} */ x, /** @type {string} */ y) =>
      `Map of ${measure} over ${x} and ${y}: click to set both`,
    hint: "Click to set both thresholds. Lines join equal values; the ring is where you are.",
    working: (/** @type {number} */ frames) => `finer… (now ${frames.toLocaleString("en")} frames)`,
    starting: "computing…",
    stop: "Stop",
    again: "Compute",
    file: "File",
    allFiles: "all files, by frames",
    open: "Open a sweep…",
    openHelp: "A table that `lineseg sweep … -o sweep.csv` or sweep.parquet wrote; it can be dropped on the page, too",
    close: "Back to the recording",
    reading: (/** @type {string} */ name) => `reading ${name}…`,
    broken: "The server gave no answer; open the table again once it is there.",
    sweep: (/** @type {string} */ name, /** @type {number} */ settings, /** @type {number} */ files) =>
      `${name}: ${settings.toLocaleString("en")} settings of ${files} ${files === 1 ? "file" : "files"}`,
    hintOfSweep:
      "Of the other swept thresholds the best is shown; a click takes the whole setting. The ring is where you are.",
    stopped: "stopped",
    nothing: "This measure has no value here. TR, FR and completeness need a recording that knows its walls.",
  },
  auto: {
    objective: "Objective",
    objectives: { truth: "Against the truth", "label-free": "Without truth" },
    thresholds: "Thresholds to tune",
    trials: "Trials",
    start: "Start",
    goOn: "Go on",
    stop: "Stop",
    anew: "Begin anew",
    anewHelp: "Forgets the trials of this recording and objective",
    adopt: "Adopt the best",
    adopted: "Adopted. Ctrl+Z takes it back.",
    history: "Score of each trial on the training half; the line is the best so far, the dashes the paper's defaults",
    importance: "What matters",
    importanceHelp: "Share of each threshold in what makes a trial good (PED-ANOVA)",
    parallel: "Every trial as a line over its thresholds; the stronger the better",
    progress: (/** @type {number} */ n) => `${n.toLocaleString("en")} ${n === 1 ? "trial" : "trials"}`,
    best: (/** @type {string} */ score) => `best ${score} on the training half`,
    intro:
      "Searches for thresholds by trying (Optuna), on one half of the frames, and compares the best with the paper's defaults on the other half. Trials are kept: you can stop, and go on another day.",
  },
  lost: "No connection to the server; the last results stay.",
};
