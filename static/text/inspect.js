// @ts-check
// Words of the mode Inspect, and of the comparison of two results.

/** @param {number} n @param {string} one @param {string} many */
const counted = (n, one, many) => `${n.toLocaleString("en")} ${n === 1 ? one : many}`;

export const inspectText = {
  tabs: { frames: "Frames", truth: "Truth" },
  frames: {
    label: "Frames, the most doubtful first",
    score: "Sorted by",
    from: "from",
    to: "to",
    any: "any",
    rangeLabel: (/** @type {string} */ end) => `Only frames with this score ${end}`,
    count: (/** @type {number} */ shown, /** @type {number} */ all) =>
      shown === all
        ? counted(all, "frame", "frames")
        : `${shown.toLocaleString("en")} of ${counted(all, "frame", "frames")}`,
    pending: "The scores of this recording are being computed.",
    none: "No frame has a score in this range, and passes the filter.",
    row: (/** @type {number} */ frame, /** @type {string} */ score, /** @type {string} */ words) =>
      `Frame ${frame}, ${score}. ${words}`,
    notANumber: (/** @type {string} */ typed) => `“${typed}” is not a number.`,
  },
  filter: {
    label: "Only frames with these words in a tag, the note, or what looks wrong",
    placeholder: "Filter by words",
    tag: "Only frames with this tag",
    any: "any tag",
    labelled: (/** @type {number} */ n) => `true lines labelled (${n})`,
    noted: (/** @type {number} */ n) => `with a note (${n})`,
    tagged: (/** @type {string} */ tag, /** @type {number} */ n) => `#${tag} (${n})`,
    searching: (/** @type {number} */ done, /** @type {number} */ all) =>
      `What looks wrong is looked for: ${done.toLocaleString("en")} of ${counted(all, "frame", "frames")}.`,
  },
  weights: {
    title: "Weights",
    help: "The suspicion is the mean of how far each score stands out, from the recording and from the frames around, by these weights.",
    reset: "Usual weights",
  },
  nothingWrong: "nothing stands out",
  truth: {
    label: "Segments against the true lines",
    show: "Show in the scene",
    matched: "matched",
    missed: "missed",
    false: "false",
    frame: "this frame",
    all: "all frames",
    labelled: "labelled frames",
    sampled: (/** @type {number} */ stride) => `every ${stride}th frame`,
    pending: "…",
    unknown:
      "The true lines of this recording are not known. Say in Labels which they are; or an NPZ file may hold the true walls as `wall`, one number for each beam.",
    judgedBy: "Judged by",
    references: { labels: "the labels of people", wall: "the walls in the recording" },
    unlabelled: "Nobody has labelled the lines of this frame.",
    matching: "A segment is a true line if more than half of the beams of both together are shared.",
    explained: {
      labels: "A true line is what somebody has drawn in Labels; only the frames with labelled lines count.",
      wall: "A true line is a visible run of one wall with at least P_min points and L_min long.",
    },
    rows: /** @type {[string, string, string, "count" | "share" | "mm"][]} */ ([
      ["trueLines", "true lines", "Visible runs of a wall that meet P_min and L_min", "count"],
      ["segments", "segments", "Lines that the method found", "count"],
      ["matches", "matched", "Segments that are a true line", "count"],
      ["trueRate", "TR", "True rate: matched / true lines (Eq. 9)", "share"],
      ["falseRate", "FR", "False rate: segments that are no true line / segments (Eq. 10)", "share"],
      ["completeness", "completeness", "Mean intersection over union of the matches", "share"],
      ["splits", "split", "True lines on which two or more segments lie", "count"],
      ["merges", "merged", "Segments that hold two or more true lines", "count"],
      ["endpointMedian", "endpoint error", "Distance of the ends of a match from those of its true line: median", "mm"],
      ["endpointMost", "… 95 %", "Distance that 95 of 100 ends do not exceed", "mm"],
    ]),
    share: (/** @type {number} */ value) => `${(100 * value).toFixed(1)} %`,
    mm: (/** @type {number} */ value) => `${(1000 * value).toFixed(0)} mm`,
  },
  ab: {
    label: "A/B",
    pinHelp: "Keep the present result as A (B). The thresholds then change B, and A stays in the scene as a band.",
    unpin: "Let A go (B)",
    a: "A",
    same: "as the thresholds of B",
    swap: "Swap",
    swapHelp: "B becomes A, and A becomes B",
    adopt: "Back to A",
    adoptHelp: "Take the thresholds of A again, and let A go",
    next: "Next difference",
    nextHelp: "To the next frame in which A and B differ (Shift+B)",
    nowhere: "A and B are the same in every frame.",
    frame: "this frame",
    all: "all frames",
    pending: "…",
    fates: /** @type {Record<string, {label: string, help: string}>} */ ({
      kept: {
        label: "kept",
        help: "Lines of A that are still there: more than half of the beams of both together are shared",
      },
      lost: { label: "lost", help: "Lines of A with nothing in their place in B" },
      gained: { label: "gained", help: "Lines of B where A had none" },
      split: { label: "split", help: "Lines of A on which two or more lines of B lie" },
      merged: { label: "merged", help: "Lines of B that hold two or more lines of A" },
    }),
  },
  keys: { ab: "pin or let go A; next frame in which A and B differ" },
};
