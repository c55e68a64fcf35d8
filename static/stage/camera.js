// @ts-check
// The visible part of the plan: a whole recording when it is opened, a decision from near by, or what a link says.
import { createCloseUp } from "./close_up.js";
import { iconButton } from "../widgets/icon.js";

/** @typedef {import("../view/store.js").Look} Look */
/** @typedef {import("../wire.js").Framing} Framing */

// How much smaller all may be drawn so that the whole frame is in view.
const MOST_SMALLER = 1.35;

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
    if (page.drawn) stage.fit(withFrame(page.drawn, stage.size));
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
    setState({ recording, place: scans, framing, layers, world, view }) {
      stage.gridded = layers.grid;
      stage.place(world, view.ride === "on");
      // A drawn world stays where it is while it changes.
      const around = world ? `world ${world.lasers.some(({ why }) => why !== null)}` : "";
      const place = drawing() ? "drawn" : `${scans} ${around}`;
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

/**
 * The box of the recording, made larger for the frame that is drawn where that does not make all much smaller.
 * @param {import("../wire.js").State} state @param {{width: number, height: number}} size of the stage [px]
 * @returns {import("../wire.js").Box}
 */
function withFrame({ bounds, extent, world }, { width, height }) {
  if (world) return bounds;
  const [x1, y1, x2, y2] = bounds;
  const both = /** @type {const} */ ([
    Math.min(x1, extent[0]),
    Math.min(y1, extent[1]),
    Math.max(x2, extent[2]),
    Math.max(y2, extent[3]),
  ]);
  const scale = (/** @type {import("../wire.js").Box} */ [left, low, right, high]) =>
    Math.min((width || 1) / (right - left), (height || 1) / (high - low));
  return scale(bounds) > MOST_SMALLER * scale([...both]) ? bounds : [...both];
}
