// @ts-check
// Mode Tune: the panel of thresholds with its pages, the replay, and the effect of changing a threshold.
import { createWhatIf } from "../inspect/what_if.js";
import { mountPanel } from "./panel.js";
import { mountReplay } from "./replay.js";
import { createTuner } from "./tuner.js";

/**
 * @param {import("../page.js").Page} page
 * @param {{panel: HTMLElement, replay: HTMLElement}} places
 * @param {typeof import("../text/words.js").words} text
 * @param {{pages: {name: string, label: string, content: HTMLElement}[], explanation: ReturnType<typeof import("./explanation.js").createExplanation>,
 *          pointing: import("../widgets/words.js").Pointing}} others
 *   pages: further pages of the panel, for the mode Inspect
 */
export function createTune(page, places, text, { pages, explanation, pointing }) {
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
      onUndo: () => page.store.undo(),
      onRedo: () => page.store.redo(),
    },
    pages,
    tuner,
  );
  const replay = mountReplay(places.replay, text.page, {
    onStep: (step) => page.change({ step }),
    settled: page.settled,
    pointing,
  });
  const whatIf = createWhatIf({
    session: page.sessionId,
    onChanges(changes) {
      panel.setMarks(changes);
      explanation.setChanges(changes);
    },
  });

  return {
    parts: [replay, panel, tuner, whatIf],
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
