// @ts-check
// The panels beside and below the stage, and the modes that show them.
import { createLayout } from "./layout/layout.js";
import { mountLearn } from "./learn/learn.js";
import { createModes } from "./bars/modes.js";
import { RerunTab } from "./rerun/tab.js";
import { createProfiles } from "./tune/profiles.js";
import { createTune } from "./tune/tune.js";

/**
 * @param {import("./page.js").Page} page
 * @param {(id: string) => HTMLElement} place
 * @param {typeof import("./text/words.js").words} words
 * @param {{scene: ReturnType<typeof import("./stage/scene.js").mountScene>,
 *          inspect: ReturnType<typeof import("./inspect/inspect.js").createInspect>,
 *          labelling: {name: string, label: string, content: HTMLElement}}} parts
 */
export function mountPanels(page, place, words, { scene, inspect, labelling }) {
  const layout = createLayout(
    {
      main: place("main"),
      panels: [place("panel"), place("learn")],
      plots: place("plots"),
      timeline: place("timeline"),
    },
    words.page.layout,
  );
  const tune = createTune(page, { panel: place("panel"), replay: place("replay") }, words, {
    pages: [inspect.pages.frames, labelling, inspect.pages.truth],
    explanation: scene.explanation,
    pointing: scene.pointing,
    profiles: createProfiles(page, layout, words.tuning.profiles),
  });
  const learn = mountLearn(
    { stage: place("stage"), view: scene.stage, dock: place("stepper"), panel: place("learn") },
    { tune: words.page.tune, learn: words.learn, shown: words.shown },
    {
      onChange: page.change,
      onDraw: page.drawWorld,
      closeUp: scene.camera.closeUp,
      settled: page.settled,
      session: page.sessionId,
    },
  );
  const pages = { learn: [place("learn"), place("stepper")], usual: [place("panel"), place("replay")] };
  const modes = createModes(words.learn.modes, place("main"), pages, {
    onMode(mode) {
      rerun.close();
      if (mode === "inspect" && page.view.mode !== mode) inspect.frames.lead();
      page.setMode(mode);
    },
    onEntered: inspect.showScored,
  });
  const rerun = new RerunTab(place("stage"), words.rerun, {
    session: page.sessionId,
    dark: () => page.view.dark,
    onFrame: page.goToFrame,
    onOpen(open) {
      modes.cover(open);
      if (open && !page.learning && page.view.step !== null) page.change({ step: null });
    },
    cancelLabel: words.page.stage.cancel,
  });
  modes.element.append(rerun.button);
  return { layout, tune, learn, modes, rerun };
}
