// @ts-check
// Words of sensitivity curves, map and auto-tuning.

export const tuningText = {
  pages: { map: "Map", auto: "Auto" },
  profiles: {
    title: "Profiles",
    hint: "A profile keeps the method, its thresholds, how files are read, the layers and the sizes of the panels. It is chosen for any recording in the menu of presets, and travels to other people as a file.",
    name: "Name",
    placeholder: "our RPLIDAR",
    keep: "Keep what is on the screen",
    use: "Use",
    save: "Save file",
    remove: "Delete",
    open: "Open a file…",
    close: "Close",
    manage: "Keep or open a profile…",
    used: (/** @type {string} */ name) => `Profile ${name}. Ctrl+Z brings the former thresholds and layers back.`,
    unknown: (/** @type {string} */ method) => `This profile is for the method ${method}, which is not known here.`,
    full: (/** @type {string} */ name) =>
      `This browser has no room for the profile ${name}, so it is not kept. Remove others, or clear what the browser keeps for this page.`,
    notOne: (/** @type {string} */ file) => `${file} is not a profile of lineseg. Choose a .lineseg-profile.json file.`,
  },
  fit: {
    label: "What fits this laser",
    measuring: "Measuring how much the points scatter…",
    use: "Use it",
    used: (/** @type {string} */ values) => `Set ${values}. Ctrl+Z brings the former values back.`,
    usesHelp: (/** @type {string} */ values) => `Sets ${values}`,
    suits: (/** @type {string} */ scatter, /** @type {string} */ values) =>
      `Points scatter by ${scatter} here, and ${values} suits that.`,
    mm: (/** @type {number} */ metres) => `${(1000 * metres).toFixed(metres < 0.001 ? 1 : 0)} mm`,
    m: (/** @type {number} */ metres) => `${metres < 10 ? metres.toFixed(1) : metres.toFixed(0)} m`,
    noise: (/** @type {string} */ near, /** @type {string} */ far, /** @type {string} */ reach) =>
      `Standard deviation of a range: ${near} at 1 m, ${far} at ${reach}.`,
    bend: (/** @type {string} */ value) => `Pale: with the walls’ own deviation from their lines, ${value}.`,
    limit: (/** @type {string} */ symbol, /** @type {string} */ value) => `Dashed: ${symbol}, now ${value}.`,
    proposed: (/** @type {string} */ value) => `Solid: what fits, ${value}.`,
  },
  curves: {
    label: "Sensitivity",
    show: "Sensitivity",
    help: "Shows under each slider how the result over the whole recording changes with this one threshold. Coverage, TR, FR and completeness go from 0 at the bottom to 1 at the top, segments to their largest number. Click the curve to set the threshold.",
    sample: (/** @type {number} */ frames, /** @type {number} */ of) =>
      frames < of
        ? `${frames.toLocaleString("en")} of ${of.toLocaleString("en")} frames`
        : of === 1
          ? "this frame"
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
    hint: "Click to set both thresholds. Lines join equal values; the ring marks the current thresholds.",
    working: (/** @type {number} */ frames) => `refining… (${frames.toLocaleString("en")} frames so far)`,
    starting: "computing…",
    stop: "Stop",
    again: "Compute",
    file: "File",
    allFiles: "all files, by frames",
    open: "Open a sweep…",
    openHelp:
      "Open a table that `lineseg sweep … -o sweep.csv` (or sweep.parquet) wrote. You can also drop it on the page.",
    close: "Back to the recording",
    reading: (/** @type {string} */ name) => `reading ${name}…`,
    broken: "The server did not answer. Open the table again when it is back.",
    sweep: (/** @type {string} */ name, /** @type {number} */ settings, /** @type {number} */ files) =>
      `${name}: ${settings.toLocaleString("en")} settings of ${files} ${files === 1 ? "file" : "files"}`,
    hintOfSweep:
      "Each point shows the best result over the other swept thresholds. Click to set them all; the ring marks the current thresholds.",
    stopped: "stopped",
    nothing: "This measure has no value here. TR, FR and completeness need a recording with known walls.",
  },
  auto: {
    objective: "Objective",
    objectives: { truth: "Against the truth", "label-free": "Without truth" },
    thresholds: "Thresholds to tune",
    trials: "Trials",
    start: "Start",
    goOn: "Go on",
    stop: "Stop",
    anew: "Start over",
    anewHelp: "Delete the trials of this recording and objective",
    adopt: "Adopt the best",
    adopted: "Adopted. Ctrl+Z undoes this.",
    history:
      "Score of each trial on the training half. The solid line is the best so far, the dashed line the paper's defaults.",
    importance: "What matters",
    importanceHelp: "Importance: how much each threshold affects whether a trial is good (PED-ANOVA)",
    parallel: "Each line is one trial, drawn across its thresholds. Stronger lines are better trials.",
    progress: (/** @type {number} */ n) => `${n.toLocaleString("en")} ${n === 1 ? "trial" : "trials"}`,
    best: (/** @type {string} */ score) => `best ${score} on the training half`,
    intro:
      "Tries out thresholds (with Optuna) on one half of the frames and compares the best with the present thresholds and the paper's defaults on the other half. Trials are kept, so you can stop and continue another day.",
  },
  lost: "No connection to the server. You still see the last results.",
};
