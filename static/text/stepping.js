// @ts-check
// The words of stepping through the decisions of a frame, the same in Tune and in Learn.

export const steppingText = {
  first: "First decision (Home)",
  back: "Step back (←)",
  play: "Play (Space)",
  pause: "Pause (Space)",
  forward: "Step forward (→)",
  last: "Last decision (End)",
  scrubber: "Decision",
  number: "Number of the decision",
  of: (/** @type {number} */ n) => `of ${n.toLocaleString("en")}`,
  range: (/** @type {number} */ most) => `Enter 1 to ${most.toLocaleString("en")}.`,
  perSecond: (/** @type {number} */ n) => `${n}/s`,
  phases: /** @type {Record<string, string>} */ ({
    seed: "Seed",
    growth: "Growth",
    overlap: "Overlap",
    endpoints: "Endpoints",
    whole: "Result",
  }),
};
