// @ts-check
// `window.lineseg`: what scripts and tests may read.

/**
 * @param {import("./page.js").Page} page
 * @param {{timeline: import("./bars/timeline.js").Timeline, address: {followLink: string}, rerun: {cursor: number | null}, tuner: {current: object},
 *          stage: {project: (x: number, y: number) => [number, number] | null}}} parts
 */
export function offerToScripts(page, { timeline, address, rerun, tuner, stage }) {
  const offered = {
    /** The last drawn state. */
    get state() {
      return page.drawn;
    },
    /** The strip of the timeline: score, values of every stride-th frame, the thresholds they belong to, complete. */
    get strip() {
      return timeline.scored.current;
    },
    /** A link that shows what this tab shows. */
    get followLink() {
      return address.followLink;
    },
    /** The frame at the time cursor of rerun's viewer; null without the viewer. */
    get rerunFrame() {
      return rerun.cursor;
    },
    /** Curves, map and auto-tuning. */
    get tuner() {
      return tuner.current;
    },
    /** Position of a point of the plan on the stage [px]. @param {number} x @param {number} y */
    project: (x, y) => stage.project(x, y),
    /** Whether the server has answered every change made in this tab: it is drawn, or refused. */
    get settled() {
      return page.answered();
    },
  };
  Object.defineProperty(window, "lineseg", { value: Object.freeze(offered) });
}
