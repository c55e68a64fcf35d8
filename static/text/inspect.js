// @ts-check
// Words of the mode Inspect, and of the comparison of two results.

/** @param {number} n @param {string} one @param {string} many */
const counted = (n, one, many) => `${n.toLocaleString("en")} ${n === 1 ? one : many}`;

export const inspectText = {
  tabs: { frames: "Frames", truth: "Truth" },
  frames: {
    label: "Frames, most doubtful first",
    score: "Sorted by",
    from: "from",
    to: "to",
    any: "any",
    rangeLabel: (/** @type {string} */ end) => `Show only frames with this score ${end}`,
    count: (/** @type {number} */ shown, /** @type {number} */ all) =>
      shown === all
        ? counted(all, "frame", "frames")
        : `${shown.toLocaleString("en")} of ${counted(all, "frame", "frames")}`,
    pending: "Computing the scores of this recording…",
    none: "No frame matches. Widen the range of the score or clear the filter.",
    row: (/** @type {number} */ frame, /** @type {string} */ score, /** @type {string} */ words) =>
      `Frame ${frame}, ${score}. ${words}`,
    notANumber: (/** @type {string} */ typed) => `“${typed}” is not a number.`,
  },
  filter: {
    label: "Show only frames with these words in a tag, in the note or in what looks wrong",
    placeholder: "Filter by words",
    tag: "Show only frames with this tag",
    any: "any tag",
    labelled: (/** @type {number} */ n) => `true lines labelled (${n})`,
    noted: (/** @type {number} */ n) => `with a note (${n})`,
    tagged: (/** @type {string} */ tag, /** @type {number} */ n) => `#${tag} (${n})`,
    searching: (/** @type {number} */ done, /** @type {number} */ all) =>
      `Looking for what is wrong: ${done.toLocaleString("en")} of ${counted(all, "frame", "frames")}.`,
  },
  weights: {
    title: "Weights",
    help: "The suspicion of a frame is a sum. Disputed lines count by their number, other scores by how far they stand out from the recording and from nearby frames. A greater weight makes a score count more; 0 leaves it out.",
    reset: "Default weights",
  },
  said: {
    label: "What looks wrong in this frame",
    draw: "Draw it in the scene",
    nothing: "nothing stands out",
    pending: "Looking for what is wrong…",
  },
  truth: {
    label: "Segments compared with the true lines",
    show: "Show in the scene",
    matched: "matched",
    missed: "missed",
    false: "false",
    neither: "just short or unknown",
    frame: "this frame",
    all: "all frames",
    labelled: "labelled frames",
    sampled: (/** @type {number} */ stride) => `every ${stride}th frame`,
    pending: "…",
    unknown:
      "The true lines of this recording are not known. Mark them in Labels (E), or open an NPZ file whose array `wall` gives the number of the true wall for each beam.",
    judgedBy: "Compared with",
    reference: (/** @type {"labels" | "wall"} */ name, /** @type {boolean} */ byViews) =>
      name === "labels" ? "labelled lines" : byViews ? "walls by many views" : "walls of the recording",
    unlabelled: "The lines of this frame are not labelled. Mark them in Labels (E).",
    matching:
      "A segment matches a true line if both have more than half of their beams in common (intersection over union).",
    explain: (/** @type {"labels" | "wall"} */ name, /** @type {boolean} */ byViews) => {
      if (name === "labels") return "The true lines are those marked in Labels. Only frames with labelled lines count.";
      const line =
        "A true line is a visible stretch of one wall that has at least P_min points and is at least L_min long.";
      return byViews ? `${line} Beams that too few views support are unknown and do not count.` : line;
    },
    fromPoses: {
      make: "Truth from poses",
      makeHelp:
        "Places all scans in the world by their poses and takes the walls seen from several places as the truth",
      forget: "Remove this truth",
      possible: "Or take the walls that many scans agree on, if the recording has poses:",
      without:
        "A truth from poses needs several frames with poses. If the file has no poses, add a trajectory with --poses FILE or Read as…",
    },
    rows: /** @type {[string, string, string, "count" | "share" | "mm"][]} */ ([
      ["trueLines", "true lines", "Visible stretches of a wall that meet P_min and L_min", "count"],
      ["segments", "segments", "Lines found by the method", "count"],
      ["matches", "matched", "Segments that match a true line", "count"],
      ["trueRate", "TR", "True rate: matched / true lines (Eq. 9)", "share"],
      ["falseRate", "FR", "False rate: segments that match no true line / segments (Eq. 10)", "share"],
      ["neutral", "just short", "Segments on a wall that misses P_min or L_min by at most 30 %", "count"],
      [
        "neutralFalseRate",
        "FR without these",
        "False rate if segments on walls that are just short count neither as right nor as false",
        "share",
      ],
      ["completeness", "completeness", "Mean intersection over union of the matches", "share"],
      ["splits", "split", "True lines covered by two or more segments", "count"],
      ["merges", "merged", "Segments that cover two or more true lines", "count"],
      [
        "endpointMedian",
        "endpoint error",
        "Median distance from an end of a matched segment to the end of its true line",
        "mm",
      ],
      ["endpointMost", "… 95 %", "95 % of the ends are at most this far from the true end", "mm"],
    ]),
    share: (/** @type {number} */ value) => `${(100 * value).toFixed(1)} %`,
    mm: (/** @type {number} */ value) => `${(1000 * value).toFixed(0)} mm`,
  },
  ab: {
    label: "A/B",
    pinHelp: "Keep the current result as A (key B). The thresholds then change B, and A stays in the scene as a band.",
    unpin: "Unpin A (key B)",
    a: "A",
    same: "same thresholds as B",
    keys: { same: "a line of A that B has, too", changed: "a line of A that B has not" },
    swap: "Swap",
    swapHelp: "Exchange A and B",
    adopt: "Back to A",
    adoptHelp: "Go back to the thresholds of A and unpin it",
    next: "Next difference",
    nextHelp: "Go to the next frame where A and B differ (Shift+B)",
    nowhere: "A and B are the same in every frame.",
    frame: "this frame",
    all: "all frames",
    pending: "…",
    fates: /** @type {Record<string, {label: string, help: string}>} */ ({
      kept: {
        label: "kept",
        help: "Lines of A that B has, too: both have more than half of their beams in common",
      },
      lost: { label: "lost", help: "Lines of A where B has none" },
      gained: { label: "gained", help: "Lines of B where A has none" },
      split: { label: "split", help: "Lines of A covered by two or more lines of B" },
      merged: { label: "merged", help: "Lines of B that cover two or more lines of A" },
    }),
  },
  keys: { ab: "pin or unpin A; next frame where A and B differ" },
};
