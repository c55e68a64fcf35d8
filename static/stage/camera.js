// @ts-check
// The visible part of the plan: a whole recording when it is opened, a decision from near by, or what a link says.
import { createCloseUp } from "./close_up.js";
import { iconButton } from "../widgets/icon.js";

/** @typedef {import("../view/store.js").Look} Look */
/** @typedef {import("../wire.js").Framing} Framing */

/**
 * @param {import("../page.js").Page} page
 * @param {import("./kinds.js").AnyStage} stage
 * @param {typeof import("../text/page.js").pageText.stage} text
 * @param {{drawing: () => boolean, names: (recording: string) => boolean, onLook: () => void, onFraming: (framing: Framing | null) => void}} handlers
 *   drawing: the recording is a world that is being drawn; names: the recording is the one in the link; onLook: the visible part changed; onFraming: as of the close-up
 */
export function createCamera(page, stage, text, { drawing, names, onLook, onFraming }) {
  /** The part of the plan that a link shows, until the plan is loaded. @type {Look | null} */
  let wanted = null;
  let fitted = "";
  const closeUp = createCloseUp(page, stage, { whole: fit, onFraming });
  const fitButton = iconButton("fit", text.fit, fit);
  const freeButton = iconButton("cube", text.free, toggle);
  freeButton.hidden = !stage.hasFree;
  stage.onMove(() => {
    if (wanted) return;
    page.store.look = stage.look;
    onLook();
  });

  function fit() {
    const box = page.drawn?.bounds ?? page.drawn?.extent;
    if (box) stage.fit(box);
  }

  function toggle() {
    page.change({ camera: page.view.camera === "plan" ? "free" : "plan" });
  }

  return {
    buttons: [fitButton, freeButton],
    fit,
    toggle,
    closeUp,
    /** Sets the part to show once the plan is loaded. @param {Look | null} look */
    want(look) {
      wanted = look;
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView({ camera }) {
      stage.setMode(camera);
      freeButton.setAttribute("aria-pressed", String(camera === "free"));
      freeButton.setAttribute("aria-label", camera === "free" ? text.plan : text.free);
    },
    /** @param {import("../wire.js").State} state */
    setState({ recording, place: scans, framing, square, world, view }) {
      stage.square = square;
      stage.place(world, view.ride === "on");
      // A drawn world stays where it is while it changes.
      const place = drawing() ? "drawn" : `${scans} ${world ? "world" : ""}`;
      if (place !== fitted) {
        fitted = place;
        closeUp.forget();
        fit();
      }
      closeUp.set(framing);
      if (!wanted || !names(recording)) return;
      stage.lookAt(wanted);
      wanted = null;
    },
    /** @param {import("../wire.js").Welcome} welcome */
    setWelcome: ({ viser }) => stage.open(viser),
  };
}
