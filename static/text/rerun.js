// @ts-check
// The words of everything about rerun.

export const rerunText = {
  tab: "Rerun",
  tabHelp: "This recording in rerun's viewer: every frame, decision and score on its timelines",
  viewer: "rerun's viewer",
  export: {
    title: "Recording for rerun",
    all: "All frames (.rrd)",
    steps: "This frame, every decision (.rrd)",
  },
  recording: (/** @type {string} */ label) => `Recording ${label} for rerun`,
  starting: "Starting rerun's viewer…",
  stale: "The thresholds have changed since this was recorded.",
  again: "Record again",
  download: "Download",
  close: "Back to the scene",
  broken: "The server broke off.",
  cancelled: "Recording was cancelled.",
  noDrawing:
    "rerun's viewer needs WebGL 2 or WebGPU, which this browser does not offer. Download the recording and open it with “rerun run.rrd”.",
  crashed: (/** @type {string} */ why) => `rerun's viewer does not run here: ${why} The recording can be downloaded.`,
  follows: "Frames follow the cursor on rerun's timeline “frame”",
};
