// @ts-check
// Mode Tune: the panel of thresholds with its pages, the replay, and the effect of changing a threshold.
import { createAsked } from "../inspect/asked.js";
import { mountPanel } from "./panel.js";
import { mountReplay } from "./replay.js";
import { createTuner } from "./tuner.js";

/**
 * @param {import("../page.js").Page} page
 * @param {{panel: HTMLElement, replay: HTMLElement}} places
 * @param {typeof import("../text/words.js").words} text
 * @param {{pages: {name: string, label: string, content: HTMLElement}[], explanation: ReturnType<typeof import("./explanation.js").createExplanation>,
 *          pointing: import("../widgets/words.js").Pointing, profiles: import("./profiles.js").Profiles}} others
 *   pages: further pages of the panel, for the mode Inspect
 */
export function createTune(page, places, text, { pages, explanation, pointing, profiles }) {
  const tuner = createTuner(text.tuning, {
    session: () => page.session.id,
    onParams: (params) => page.change({ params }),
    onFits: (fits, better) => panel.setFits(fits, better),
    row: (name) => panel.row(name),
  });
  const panel = mountPanel(
    places.panel,
    text.page,
    {
      onParams: (params, gesture) => page.change({ params }, gesture),
      onSelect: (selected) => page.change({ selected }),
      onSegment: ({ first, last }, beside) =>
        page.change(beside && page.view.selected !== null ? { beside: first } : { selected: first, beside: last }),
      onUndo: () => page.store.undo(),
      onRedo: () => page.store.redo(),
      profiles,
    },
    pages,
    tuner,
  );
  const replay = mountReplay(places.replay, text.page, {
    onStep: (step) => page.change({ step }),
    settled: page.settled,
    pointing,
  });
  const whatIf = createAsked({
    path: "/api/what-if",
    parts: /** @type {const} */ (["frame", "beam", "method", "params"]),
    isAsked: ({ selected, beside }) => selected !== null && beside === null,
    session: page.sessionId,
    onAnswer(/** @type {import("../wire.js").WhatIfs | null} */ answer) {
      panel.setMarks(answer?.changes ?? []);
      explanation.setChanges(answer?.changes ?? []);
    },
  });
  const apart = createAsked({
    path: "/api/apart",
    parts: /** @type {const} */ (["frame", "selected", "beside", "method", "params"]),
    isAsked: ({ beside }) => beside !== null,
    session: page.sessionId,
    onAnswer: (/** @type {import("../wire.js").Apart | null} */ answer) => explanation.setApart(answer),
  });

  return {
    parts: [replay, panel, tuner, whatIf, apart],
    replay,
    panel,
    tuner,
    /** Shows the table of a sweep in the map. @param {File} file */
    openSweep(file) {
      page.setMode("tune");
      panel.open("map");
      tuner.openSweep(file);
    },
  };
}
