// @ts-check
// Words of the mode Learn.

/** @typedef {import("../learn/trace.js").Event} Event */

const m = (/** @type {number} */ value) => (Number.isFinite(value) ? `${value.toFixed(3)}\u00a0m` : "infinitely far");

const AGAIN = "Try again";

export const learnText = {
  modes: { label: "Mode", tune: "Tune", learn: "Learn", inspect: "Inspect" },
  panel: "Learn",
  keys: {
    jumps: "in Learn: next refusal, merge, cut",
    closeUp: "in Learn: show decisions from near by, or the whole plan",
    answer: "in Learn: answer a prediction",
  },
  otherMethod: (/** @type {string} */ label, /** @type {string} */ citation) =>
    `${label} (${citation}) is replayed here decision by decision. Pseudocode, formulas, charts and lessons are those of region growing.`,
  whole: (/** @type {number} */ lines, /** @type {number} */ steps) =>
    `The final result: ${lines} ${lines === 1 ? "line" : "lines"}, from ${steps.toLocaleString("en")} decisions. Press → to step through them.`,
  nothing: "This frame has no decisions: too few beams have a return.",
  waiting: "Loading the decisions of this frame…",
  truncated: (/** @type {number} */ shown, /** @type {number} */ total) =>
    `This frame has ${total.toLocaleString("en")} decisions; you can step through the first ${shown.toLocaleString("en")}.`,
  steps: {
    label: "Steps",
    leave: "Show the whole result (Esc)",
    level: "How far → steps",
    levels: { decision: "by decision", phase: "by phase", line: "by line" },
    speed: "Steps per second",
    jump: "Next",
    jumps: {
      seed: "seed",
      refusal: "refusal",
      line: "line",
      drop: "drop",
      merge: "merge",
      cut: "cut",
    },
    jumpTo: (/** @type {string} */ what, /** @type {number} */ n) => `Next ${what} (${n} in this frame)`,
    closeUp: "Show each decision from near by (Z)",
    loopStart: "Start the loop here",
    loopEnd: "End the loop here",
    loopClear: "Remove the loop",
    beam: "Run to beam",
    noBeam: (/** @type {number} */ most) => `Enter 0 to ${most}.`,
    beamHint:
      "Press Enter to go to the next decision about this beam and to see why it is in a line or not. Clicking its point in the scene does the same.",
  },
  lesson: {
    label: "Lesson",
    overview: "Lessons",
    missing: "The lessons could not be loaded. You can step through any frame without them.",
    again: AGAIN,
    unknown: (/** @type {string} */ id) => `There is no lesson “${id}”. Choose one of these.`,
    overviewHint:
      "Each lesson takes a few minutes and ends with a task. You can also step through any frame of your own.",
    close: "Back to the list of lessons",
    back: "Back",
    next: "Next",
    toTask: "To the task",
    nextLesson: "Next lesson",
    finish: "Finish",
    task: "Your turn",
    hint: "Hint",
    place: (/** @type {number} */ n, /** @type {number} */ all) => `${n} of ${all}`,
    right: "Done.",
    notYet: "Not yet.",
    doneMark: "done",
  },
  glossary: {
    title: "Terms and symbols",
    open: "Terms",
    close: "Close",
    lesson: (/** @type {number} */ number) => `Lesson ${number}`,
  },
  goals: {
    nothingChanged: "All thresholds still have the values that this lesson gave them.",
    wrongThreshold: "You changed a threshold that this task does not ask for. Undo that (Ctrl+Z).",
    onlyOne: "You changed more than one threshold; change only one.",
    lines: (/** @type {number} */ found, /** @type {[number, number]} */ [least, most]) =>
      `There ${found === 1 ? "is 1 line" : `are ${found} lines`}; the task asks for ${least === most ? least : most > 99 ? `at least ${least}` : `${least} to ${most}`}.`,
    together: (/** @type {number} */ one, /** @type {number} */ other) =>
      `Beams ${one} and ${other} are not in one line.`,
    apart: (/** @type {number} */ one, /** @type {number} */ other) =>
      `Beams ${one} and ${other} are not in two lines.`,
    inside: (/** @type {number} */ beam) => `Beam ${beam} is no longer in a line.`,
    outside: (/** @type {number} */ beam) => `Beam ${beam} is in a line.`,
    either: (/** @type {readonly [number, number][]} */ pairs) =>
      `Neither ${pairs.map(([one, other]) => `beams ${one} and ${other}`).join(" nor ")} are in one line.`,
    tooSmall: (/** @type {string} */ symbol) => `${symbol} is too small.`,
    tooLarge: (/** @type {string} */ symbol) => `${symbol} is too large.`,
    useless: (/** @type {string} */ symbol) => `${symbol} alone cannot do it.`,
    noDecision: "Step to a decision first.",
    otherKind: (/** @type {string} */ kind, /** @type {string} */ wanted) =>
      `This decision is “${kind}”; look for “${wanted}”.`,
    otherCheck: (/** @type {string} */ symbol, /** @type {string} */ wanted) =>
      `Here ${symbol} decided, not ${wanted}.`,
    otherWay: (/** @type {number} */ direction) => `Here the line grew ${direction > 0 ? "forward" : "backward"}.`,
    another: (/** @type {string} */ kind) => `This is “${kind}”, but of another line or point.`,
    later: "The right one comes later.",
    earlier: "The right one comes earlier.",
    bothWays: "There are right ones before and after this one.",
    selectOne: "Select a point first.",
    notThis: (/** @type {number} */ beam) => `Beam ${beam} is not the answer.`,
    higher: "The right one has a higher number.",
    lower: "The right one has a lower number.",
    between: "There are right ones with lower and with higher numbers.",
    count: (/** @type {number} */ n, /** @type {string} */ kind) => `“${kind}” occurs ${n} times.`,
  },
  formulas: {
    label: "Formulas",
    terms: "Show in the scene",
    names: /** @type {Record<string, string>} */ ({
      point: "point P",
      window: "its points",
      outermost: "outermost point",
      beam: "beam",
      distance: "distance d",
      predicted: "predicted point P′",
      line: "line",
      length: "length",
      other: "other line",
      band: "ε band",
      normal: "normal (a, b)",
      mean: "mean",
      ends: "endpoint",
    }),
    toLine: "Distance from a point to the line (Eqs. 1, 3)",
    predicted: "Distance to the predicted point (Eqs. 4–6)",
    fit: (/** @type {number} */ n) => `The line through ${n} points with the smallest Σd² (Eq. 2)`,
    solved: "solved by  tan 2φ",
    accepted: "Enough points, and long enough?",
    angle: "Angle between the two lines",
    spread: "RMS distance of all points from one common line",
    times: "γ times that of two lines",
    cut: "Where the overlap is cut",
    endpoint: (/** @type {number} */ beam) => `Endpoint from beam ${beam} (Eqs. 7, 8)`,
    broken: "A gap that is too wide (not in the paper)",
    gap: "gap",
    void: "void",
    dropout: "beams without a return",
    joins: "it joins",
    stops: "growth stops",
    noSeed: "no seed",
    kept: "kept",
    dropped: "dropped",
    enough: "points are enough",
    oneLine: "one line",
    twoLines: "two lines",
  },
  charts: {
    distance: { title: "Distance to the line, by beam", y: "ε" },
    predicted: { title: "|ρ − ρ′|, by beam", y: "δ" },
    growth: { title: "Length and points of the growing line", y: "min" },
    nothing: "Step to a decision to see its numbers.",
    noLine: "No line was fitted: there is too wide a gap.",
    noGrowth: "No line is growing at this step.",
    sayBeam: (/** @type {number} */ beam, /** @type {number} */ value) => `Beam ${beam}: ${m(value)}`,
    sayGrowth: (/** @type {{points: number, length: number}} */ { points, length }) =>
      `${points} points, ${m(length)} long`,
  },
  views: {
    label: "Charts",
    step: "This step",
    all: "All steps",
    trail: "Trail",
    trailHelp: "Draw every fit of the growing line so far",
  },
  ladder: {
    seeds: "Every window tried",
    window: (/** @type {number} */ first, /** @type {number} */ last, /** @type {string} */ fate) =>
      `Beams ${first} to ${last}: ${fate}`,
    missing: "This chart could not be computed.",
    again: AGAIN,
    tones: /** @type {Record<string, string>} */ ({
      "": "seed",
      delta: "refused by δ",
      epsilon: "by ε",
      other: "by a gap or another check",
    }),
    sweep: "over its range, beam by beam",
    sweepHelp:
      "Each column is the result for one value of the threshold: beams from top to bottom, in the colours of their lines. Click a column to set that value.",
    threshold: "Threshold",
    at: (/** @type {string} */ symbol, /** @type {string} */ value, /** @type {number} */ lines) =>
      `${symbol} = ${value}: ${lines} ${lines === 1 ? "line" : "lines"}`,
  },
  predict: {
    toggle: "Predict",
    help: "Predict each decision before you see it (keys 1 and 2)",
    seed: (/** @type {Event} */ e) => `Beams ${e.first} to ${e.last}: will they be a seed?`,
    seedAnswers: ["1 Seed", "2 No seed"],
    point: (/** @type {Event} */ e) =>
      `Beam ${e.beam}: does it join the growing line, or does growth ${e.direction > 0 ? "forward" : "backward"} stop here?`,
    pointAnswers: ["1 In", "2 Out"],
    line: (/** @type {Event} */ e) =>
      `The line of beams ${e.first} to ${e.last}, ${e.points} points: is it kept or dropped?`,
    lineAnswers: ["1 Kept", "2 Dropped"],
    pair: "Two neighbouring lines share points: one wall or two?",
    pairAnswers: ["1 One", "2 Two"],
    score: (/** @type {number} */ right, /** @type {number} */ all) =>
      all ? `${right} of ${all} right` : "Press → for the first question",
    right: "Right.",
    wrong: "No.",
  },
  listing: {
    label: "Pseudocode",
    missing: "The pseudocode could not be loaded.",
    again: AGAIN,
    misprint: "Where this differs from the printed listing",
    extension: "not in the paper",
    values: "Values now",
    tabs: /** @type {Record<string, string>} */ ({
      seed: "1 Seed",
      growth: "2 Growth",
      overlap: "3 Overlap",
      endpoints: "Endpoints",
    }),
    follow: "The tab follows the step.",
  },
};
