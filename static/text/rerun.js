// @ts-check
// The words of everything about rerun.

export const rerunText = {
  tab: "Rerun",
  tabHelp: "Show this recording in rerun's viewer, with every frame, decision and score on its timelines",
  viewer: "rerun's viewer",
  export: {
    title: "Recording for rerun",
    all: "All frames (.rrd)",
    steps: "This frame, every decision (.rrd)",
  },
  recording: (/** @type {string} */ label) => `Recording ${label} for rerun`,
  starting: "Starting rerun's viewer…",
  stale: "The thresholds have changed since this recording was made.",
  again: "Record again",
  download: "Download",
  close: "Back to the scene",
  broken: "The server stopped sending. Record again.",
  cancelled: "Recording was cancelled.",
  noDrawing:
    "rerun's viewer needs WebGL 2 or WebGPU, which this browser does not have. Download the recording and open it with “rerun run.rrd”.",
  crashed: (/** @type {string} */ why) =>
    `rerun's viewer does not run here: ${why} Download the recording and open it with “rerun run.rrd”.`,
  follows: "lineseg shows the frame at the cursor of rerun's timeline “frame”",
};
