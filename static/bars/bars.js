// @ts-check
// The bars below the stage: the timeline with its plots and the pill of a live laser, and the status.
import { createLive } from "../live/pill.js";
import { createPlots } from "./plots.js";
import { mountStatus } from "./status.js";
import { Timeline } from "./timeline.js";

/**
 * @param {import("../page.js").Page} page
 * @param {(id: string) => HTMLElement} place
 * @param {typeof import("../text/words.js").words} words
 * @param {{onScores: () => void}} handlers onScores: the values of the strip changed
 */
export function mountBars(page, place, words, { onScores }) {
  const { change, goToFrame, follow, settled } = page;
  const live = createLive(words.live, { onFollow: follow });
  const timeline = new Timeline(place("timeline"), words.page.timeline, {
    onFrame: goToFrame,
    onSpeed: (speed) => change({ speed }),
    onScore: (score) => change({ score }),
    onScores,
    onFollow: follow,
    settled,
    pill: live.button,
  });
  const plots = createPlots(place("plots"), words.page.timeline.plots, {
    scored: () => timeline.scored,
    track: () => timeline.track,
    onFrame: goToFrame,
  });
  const status = mountStatus(page, place("status"), words.page.status, live.element);
  return { live, timeline, plots, status };
}
