// @ts-check
// Words that all modes share: bars, stage, thresholds, replay, help.

/** "2.5 s", "45 s", "12 min", "3.2 h", "15 days" @param {number} seconds */
function secondsOf(seconds) {
  if (seconds < 120) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;
  if (seconds < 7200) return `${Math.round(seconds / 60)} min`;
  if (seconds < 172_800) return `${(seconds / 3600).toFixed(1)} h`;
  return `${Math.round(seconds / 86_400).toLocaleString("en")} days`;
}

/** With a minus that is as wide as a plus. @param {number} value @param {number} digits */
const signed = (value, digits) => value.toFixed(digits).replace("-", "−");

/** @param {number | null} value */
const shareOf = (value) => (value === null ? "–" : `${Math.round(100 * value)} %`);

export const pageText = {
  appName: "lineseg",
  noAnswer: "The server did not answer. Try again.",
  top: {
    recording: "Recording",
    noRecording: "No recording",
    topic: "Laser topic",
    topicScans: (/** @type {string} */ name, /** @type {number} */ scans) => `${name} (${scans} scans)`,
    method: "Method",
    openFile: "Open file…",
    openHint: "or drop one anywhere on the page",
    missing: "file not found",
    export: "Export",
    copyLink: "Copy link",
    linkCopied: "Link copied. It reproduces what you see.",
    linkCopiedUpload: "Link copied. It works as long as this server keeps the uploaded file.",
    themeAuto: "Theme: same as the system",
    themeLight: "Theme: light",
    themeDark: "Theme: dark",
    help: "Keyboard and mouse",
  },
  groups: /** @type {Record<string, string>} */ ({
    Live: "Live",
    Samples: "Samples",
    Lessons: "Lessons (one frame)",
    Recent: "Recent files",
    Uploads: "Uploaded",
    "Command line": "From the command line",
    Drawn: "Draw",
  }),
  exchange: {
    parameters: "Parameters",
    import: "Import parameters…",
    formats: /** @type {Record<string, {label: string, file: string}>} */ ({
      ros2: { label: "ROS 2 YAML", file: "lineseg.yaml" },
      ros1: { label: "ROS 1 launch", file: "lineseg.launch" },
      python: { label: "Python", file: "lineseg_params.py" },
      flags: { label: "Command-line flags", file: "lineseg_flags.txt" },
    }),
    title: (/** @type {string} */ format) => `Parameters as ${format}`,
    copy: "Copy",
    copied: "Copied",
    download: "Download",
    close: "Close",
    importTitle: "Import parameters",
    importHint:
      "Paste ROS 2 YAML, a ROS 1 launch file, JSON, Python or flags, or choose a file. You can also drop a file on the page.",
    importLabel: "Parameters",
    importFile: "Choose file…",
    importApply: "Apply",
    imported: (/** @type {number} */ n) => `${n} ${n === 1 ? "parameter" : "parameters"} imported. Ctrl+Z undoes this.`,
    importedNothing: "Nothing changed: these are the current values.",
  },
  stage: {
    label: "Laser scan from above",
    scene: "Scene: scan, seeds and segments",
    beam: (/** @type {number} */ beam) => `beam ${beam}`,
    fit: "Fit the recording in view",
    free: "Rotate the scene freely in 3D",
    plan: "Back to the plan view",
    across: (/** @type {number} */ factor) => `drawn ×${factor} across the line`,
    noWebGL:
      "This browser has no WebGL: the plan is drawn in 2D, and there is no free 3D view. Turning on graphics acceleration in the browser's settings may bring it back.",
    readout: (
      /** @type {[number, number]} */ [x, y],
      /** @type {number} */ range,
      /** @type {number} */ bearing,
      /** @type {number | null} */ beam,
    ) =>
      `x ${signed(x, 2)} m   y ${signed(y, 2)} m   range ${range.toFixed(2)} m   bearing ${signed(bearing, 1)}°${beam === null ? "" : `   beam ${beam}`}`,
    ruler: {
      label: "Measure distances and angles (U)",
      close: "Put the ruler away",
      first: "Click a point or a line. Shift: the point, not the line.",
      second: "Click a second point or line.",
      length: (/** @type {number} */ metres) => `${metres.toFixed(3)} m`,
      said: (/** @type {import("../stage/measure.js").Measured} */ { from, to, distance, angle, cross }) => {
        const metres = `${distance.toFixed(3)} m`;
        const degrees = angle === null ? "" : `${((180 * angle) / Math.PI).toFixed(2)}°`;
        if (cross)
          return `The lines meet at ${degrees}, at x ${signed(cross[0], 3)} m, y ${signed(cross[1], 3)} m. Between their nearest ends: ${metres}.`;
        if (degrees) return `The lines are ${metres} apart, at an angle of ${degrees}.`;
        return `${metres}: ${signed(to[0] - from[0], 3)} m in x, ${signed(to[1] - from[1], 3)} m in y.`;
      },
    },
    key: {
      label: "Marks",
      marks: /** @type {Record<string, string>} */ ({
        window: "points of the window; red: refused",
        seeds: "seed of a line",
        candidate: "point under test, P",
        outermost: "outermost point",
        predicted: "predicted point P′",
        growing: "line; red: refused or stopped",
        first: "first line",
        other: "second line",
        bent: "line fitted with P",
        band: "band of ±ε",
        ray: "laser beam",
        perpendicular: "perpendicular to the line",
        dropped: "dropped line",
        endpoints: "end of a line",
      }),
    },
    layers: "Layers",
    world: {
      open: "Laser’s frame or world",
      label: "Frame of the scene",
      spaces: {
        laser: { label: "Frame of the laser", help: "The laser stays where it is, and its surroundings move" },
        world: { label: "World", help: "Each scan where the robot was, by the poses of the recording (G)" },
      },
      scans: "Other scans",
      past: /** @type {Record<string, string>} */ ({
        all: "all",
        100: "the last 100",
        10: "the last 10",
        none: "none",
      }),
      ride: { label: "Move with the robot", help: "The picture moves along, instead of standing still" },
      poses: (/** @type {string} */ said) => `Poses: ${said}.`,
      lost: "This frame has no pose, so it is not shown.",
      map: (/** @type {string} */ said, /** @type {number} */ percent) =>
        `Line map: ${said || `merging the lines of all frames… ${percent} %`}`,
      /** Two or more lasers, and no poses that say where they are. */
      apart: (/** @type {number} */ lasers) =>
        `The recording has scans of ${lasers} lasers. Without poses it is not known how they are mounted, so they are not drawn together.`,
      lasers: {
        label: "Lasers",
        reading: "is being read…",
        absent: (/** @type {string} */ why) => `not shown: ${why}`,
      },
      mapped: (/** @type {number} */ length, /** @type {number} */ sigma, /** @type {number} */ seen) =>
        `map line ${length.toFixed(2)} m ±${(1000 * sigma).toFixed(0)} mm, from ${seen === 1 ? "1 line" : `${seen.toLocaleString("en")} lines`}`,
    },
    empty: "Drop a recording here",
    emptyHint:
      "Any file with scans of a 2D laser: a bag, a log, arrays, a table. Or choose a sample from the menu above.",
    starting: "Starting…",
    loading: (/** @type {string} */ label) => `Opening ${label}`,
    readingOn: (/** @type {string} */ label) => `Reading the rest of ${label}`,
    uploading: (/** @type {string} */ label) => `Uploading ${label}`,
    scans: (/** @type {number} */ done, /** @type {number} */ total) =>
      total ? `${Math.floor((100 * done) / total)} %` : done ? `${done.toLocaleString("en")}` : "",
    cancel: "Cancel",
    stop: "Stop",
    dismiss: "Dismiss",
    kept: "The previous recording stays open.",
    linkKept: (/** @type {string} */ name) =>
      `Open ${name || "the file"} or drop it here. The frame, the thresholds and all other settings of the link are then applied to it.`,
    lost: "No connection to the server. Trying again…",
    retry: "Try now",
    drop: "Drop to open",
    dropHint: "A recording, or a parameter file",
    tooLarge: (/** @type {string} */ name, /** @type {string} */ size, /** @type {string} */ limit) =>
      `${name} is ${size}; uploads may be up to ${limit}. Open it from the command line instead: lineseg ${name}`,
    uploadFailed: (/** @type {string} */ name) => `${name} could not be uploaded: the connection was lost. Try again.`,
    othersInMenu: (/** @type {number} */ n) =>
      `${n === 1 ? "The other recording is" : `The other ${n} recordings are`} in the menu of recordings.`,
    nothingDropped: "What you dropped contains no recording and no parameter file.",
  },
  layout: {
    panel: { size: "Width of the panel", hide: "Hide the panel (P)", show: "Show the panel (P)" },
    timeline: {
      size: "Height of the plots above the timeline",
      hide: "Hide the timeline (T)",
      show: "Show the timeline (T)",
    },
  },
  follow: {
    following: "You are following the presenter.",
    away: "You are following the presenter, who is away at the moment.",
    left: "You no longer follow the presenter. You can now change this view.",
    gone: "The presenter has left. You can now change this view.",
    stop: "Stop following",
    again: "Follow again",
    title: "For a class",
    copy: "Copy a link that follows this tab",
    copied: "Link copied. Whoever opens it sees what you see and cannot change anything here.",
    name: "Your name for the teacher",
    list: {
      open: "Who is where",
      title: "Class",
      close: "Close",
      head: ["Name", "Lesson", "Page", "Done", ""],
      nobody: "Nobody has opened the link of this tab yet.",
      hint: "Names are chosen by those who follow. They stay in this program, and only until a tab is closed.",
      nameless: "no name",
      follows: "follows",
      alone: "on their own",
      elsewhere: (/** @type {string} */ recording, /** @type {number} */ frame) => `${recording}, frame ${frame}`,
      page: (/** @type {number} */ page, /** @type {number} */ pages) => (pages ? `${page} of ${pages}` : ""),
    },
  },
  layers: /** @type {Record<string, {label: string, help: string}>} */ ({
    points: { label: "Points", help: "Every beam with a return, in the colour of its segment" },
    invalid: { label: "Beams without return", help: "Directions in which the laser got no valid range" },
    segments: { label: "Segments", help: "The extracted lines" },
    endpoints: { label: "Endpoints", help: "Ends of each segment: its outermost points projected on its line" },
    seeds: { label: "Seeds", help: "The points from which each line grew" },
    normals: { label: "Normals", help: "Unit normal of each line" },
    dropped: { label: "Dropped lines", help: "Candidates that were too short or had too few points" },
    truth: { label: "Truth", help: "True walls, if the recording contains them" },
    ghosts: {
      label: "Missed lines",
      help: "In Inspect: lines that this frame probably misses, found by extractions at the ε that fits the laser",
    },
    numbers: { label: "Beam numbers", help: "The number of each beam at its point, as many as there is room for (I)" },
    verdicts: {
      label: "Right and wrong",
      help: "If the truth is known: matched segments solid, false ones broad and dotted, missed true lines dashed; thin and grey: neither right nor false",
    },
    replay: { label: "Replay geometry", help: "The window, line, ε band and candidate of the current decision" },
    trajectory: { label: "Trajectory", help: "The way of the laser through the world" },
    past: { label: "Other scans", help: "What the laser saw in other frames" },
    all_lines: { label: "Lines of all frames", help: "The lines of every frame, where they are in the world" },
    line_map: {
      label: "Line map",
      help: "The lines of all frames, merged where they agree within the noise of beams and poses; point at one for its length and standard deviation",
    },
    other_lasers: {
      label: "Other lasers",
      help: "What the other lasers of the robot saw at the time of this frame, where the poses of the recording put them",
    },
    laser: { label: "Laser", help: "Position and direction of the laser" },
    grid: { label: "Grid", help: "Squares of equal size; the scale bar shows how large they are" },
  }),
  tune: {
    tabs: { thresholds: "Thresholds", lines: "Lines" },
    label: "Thresholds",
    preset: "Preset",
    presetChoose: "Laser preset",
    presetPaper: "Paper (Table 2)",
    presetHelp:
      "Sets ε and its growth κ from the range precision in the laser’s data sheet. The other thresholds stay unchanged, because they depend on the scene and not on the laser.",
    presetHint: (/** @type {string} */ range, /** @type {string} */ values) => `${range} → ${values}`,
    undo: "Undo (Ctrl+Z)",
    redo: "Redo (Ctrl+Shift+Z)",
    resetAll: "Reset all",
    resetAllHelp: "Set all thresholds to their defaults",
    reset: (/** @type {string} */ value) => `Reset to ${value}`,
    extensions: "Extensions",
    extensionMark: "not in the paper",
    passed: "passed",
    failed: "refused at this value",
    histogram: (/** @type {string} */ symbol, /** @type {number} */ passed, /** @type {number} */ failed) =>
      `${symbol}: ${passed} passed, ${failed} refused`,
    histogramEmpty: "nothing tested",
    bin: (/** @type {string} */ range, /** @type {number} */ passed, /** @type {number} */ failed) =>
      `At the pointer, ${range}: ${passed} passed, ${failed} refused`,
    heights: "heights: square root of the number",
    usually: (/** @type {boolean} */ on) => (on ? "On by default." : "Off by default."),
    notANumber: (/** @type {string} */ typed) => `“${typed}” is not a number. Enter one such as 0.05.`,
    notWhole: "Enter a whole number.",
    allowed: (/** @type {string} */ range, /** @type {string} */ why) => `Allowed: ${range}${why ? `; ${why}` : ""}.`,
    range: (/** @type {string} */ least, /** @type {string | null} */ most, /** @type {string} */ unit) =>
      (most === null ? `${least} or more` : `${least} to ${most}`) + (unit ? ` ${unit}` : ""),
  },
  lines: {
    segments: "Segments",
    dropped: "Dropped",
    columns: {
      beams: ["beams", "First and last beam"],
      points: ["points", "Number of points"],
      length: ["m", "Length, in metres"],
      rms: ["rms", "Root mean square distance of the points from the line, in millimetres"],
      at: ["x, y", "Middle, in metres from the laser: x ahead, y to the left"],
      angle: ["angle", "Direction of the line, from the x axis"],
      by: ["by", "The threshold that refused it"],
    },
    hint: "Click a line: why is it one? Shift+click a second one: why are they two?",
    none: "No lines in this frame. Try a smaller P_min or L_min, or a larger ε; the histograms show what was refused.",
    noneDropped: "No line was dropped.",
    ask: "Why is this one line?",
    askDropped: "Why was it dropped?",
    mm: (/** @type {number} */ metres) => (1000 * metres).toFixed(1),
    m: (/** @type {number} */ metres) => metres.toFixed(2),
    at: (/** @type {number} */ x, /** @type {number} */ y) => `${x.toFixed(1)}, ${y.toFixed(1)}`.replaceAll("-", "−"),
    angle: (/** @type {number} */ degrees) => `${degrees.toFixed(0)}°`.replace("-", "−"),
  },
  explanation: {
    label: "Why",
    beam: (/** @type {number} */ beam) => `Beam ${beam}`,
    pair: (/** @type {number} */ one, /** @type {number} */ other) => `Beams ${one}, ${other}`,
    pending: "Trying what would change it…",
    join: "They are one line with",
    part: "It is two or more lines with",
    nothing: {
      join: "No threshold within its slider joins them.",
      part: "Changing one threshold alone does not part it.",
    },
    close: "Close (Esc)",
    changes: "The answer changes with",
    noChange: "Changing one threshold alone does not change this answer.",
    measured: "measured",
    limit: "limit",
  },
  replay: {
    label: "Replay",
    enter: "Replay this frame",
    leave: "Leave the replay (Esc)",
    decisions: (/** @type {number} */ n) => `${n.toLocaleString("en")} decisions`,
    none: "This frame has no decisions to replay.",
    next: (/** @type {string} */ what) => `Next ${what}`,
    nextLine: "Next line",
    nextDrop: "Next drop",
    speed: "Decisions per second",
  },
  timeline: {
    label: "Timeline",
    play: "Play (Space)",
    pause: "Pause (Space)",
    speed: "Speed",
    times: (/** @type {number} */ n) => `×${n === 0.5 ? "½" : n}`,
    realTime:
      "×1 is real time, as the stamps say. Frames that cannot be drawn in time are left out. Slower, faster: , .",
    steady: (/** @type {number} */ n) =>
      `×1 is ${n} frames per second, because the real times are not known. Slower, faster: , .`,
    skipped: (/** @type {number} */ seconds) => `Skipped ${secondsOf(seconds)} without scans`,
    frame: "Frame",
    of: (/** @type {number} */ first, /** @type {number} */ last) =>
      `of ${first.toLocaleString("en")}–${last.toLocaleString("en")}`,
    scrubber: "Frame",
    when: {
      since: "Time since the first scan of the file.",
      date: "Below: date and time of this scan, by its stamp.",
      steady: (/** @type {number} */ n) => `${n} frames/s`,
      unknown: (/** @type {string} */ why) => `No times are shown: ${why}.`,
    },
    range: (/** @type {number} */ least, /** @type {number} */ most) =>
      `Enter ${least.toLocaleString("en")} to ${most.toLocaleString("en")}.`,
    plots: { label: "The scores of all frames" },
    strip: {
      label: "Score of the frames",
      pending: "computing scores…",
      noA: "Pin a result as A first (key B).",
      legend: (/** @type {string} */ label, /** @type {string} */ low, /** @type {string} */ high) =>
        `Colours of ${label}: ${low} to ${high}. Fit them to the current values`,
      worse: {
        higher: "Higher values are more doubtful and have a stronger colour.",
        lower: "Lower values are more doubtful and have a stronger colour.",
      },
      scale: "The scale of the colours stays the same while you change thresholds.",
      refit: "Click to fit it to the current values.",
      hint: (/** @type {number} */ frame, /** @type {string} */ words) =>
        `Frame ${frame.toLocaleString("en")}: ${words}`,
      gap: (/** @type {number} */ seconds, /** @type {number} */ frame) =>
        `${secondsOf(seconds)} without scans before frame ${frame.toLocaleString("en")}`,
    },
  },
  status: {
    label: "Status",
    segments: (/** @type {number} */ n) => (n === 1 ? "segment" : "segments"),
    coverage: "of valid beams covered",
    coverageHelp: (/** @type {number} */ covered, /** @type {number} */ valid, /** @type {number} */ beams) =>
      `${covered} of ${valid} valid beams lie on a segment; ${beams - valid} of ${beams} beams have no return`,
    extraction: "extraction",
    roundTrip: "round trip",
    extractionHelp: "Time of the extraction of this frame",
    roundTripHelp: "Time from your input to the drawn picture",
    beams: (/** @type {number} */ n) => `${n} beams`,
    truth: {
      help: "This frame compared with its true lines: TR, share of true lines that were found; FR, share of segments that are false; completeness, mean overlap of the matches. Click to see matched (solid), false (dotted) and missed (dashed) lines in the scene.",
      figures: (
        /** @type {import("../wire.js").Agreement} */ { trueRate, falseRate, completeness },
        /** @type {boolean} */ byViews,
      ) =>
        `TR ${shareOf(trueRate)} · FR ${shareOf(falseRate)} · completeness ${shareOf(completeness)}${byViews ? " · by many views" : ""}`,
    },
    connection: { connecting: "connecting", open: "connected", lost: "not connected" },
    announce: (/** @type {number} */ n, /** @type {number} */ frame) =>
      `${n} ${n === 1 ? "segment" : "segments"} in frame ${frame}`,
  },
  help: {
    title: "Keyboard and mouse",
    mouse: [
      ["Drag", "move the plan"],
      ["Wheel", "zoom in or out at the pointer"],
      ["Click a point", "why it is, or is not, in a line"],
      ["Shift+click another", "why both are in one line, or in two"],
      ["Drop a file", "open a recording or import parameters"],
    ],
    keys: {
      play: "play or pause",
      pace: "play slower, faster",
      step: "one frame back, forward; in a replay: one decision",
      ends: "first, last frame or decision",
      replay: "start or leave the replay of this frame",
      jumps: "in a replay: next seed, next line, next drop",
      doubtful: "next, previous of the most doubtful frames",
      fit: "fit the recording in view",
      view: "plan or free 3D view",
      world: "frame of the laser or world",
      layers: "layers",
      ruler: "measure distances and angles",
      hide: "hide or show the panel, the timeline",
      numbers: "beam numbers in the scene",
      open: "open a file",
      undo: "undo a change",
      redo: "redo",
      slider: "on a slider: one step; ten steps; to an end",
      escape: "close, deselect, leave the replay",
      help: "this help",
    },
  },
};
