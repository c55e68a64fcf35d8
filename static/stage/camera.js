// @ts-check
// The visible part of the plan: a whole recording when it is opened, a decision from near by, or what a link says.
import { createCloseUp } from "./close_up.js";
import { iconButton } from "../widgets/icon.js";

/** @typedef {import("../view/store.js").Look} Look */
/** @typedef {import("../wire.js").Framing} Framing */
/** @typedef {import("../wire.js").Box} Box */

// How much smaller all may be drawn so that the whole frame is in view.
const MOST_SMALLER = 1.35;

/**
 * @param {import("../page.js").Page} page
 * @param {import("./kinds.js").AnyStage} stage
 * @param {typeof import("../text/page.js").pageText.stage} text
 * @param {{drawing: () => boolean, names: (recording: string) => boolean, onLook: () => void, onFraming: (framing: Framing | null, lines: [[number, number], [number, number]][]) => void}} handlers
 *   drawing: the recording is a world that is being drawn; names: the recording is the one in the link; onLook: the visible part changed; onFraming: as of the close-up
 */
export function createCamera(page, stage, text, { drawing, names, onLook, onFraming }) {
  /** The part of the plan that a link shows, until the plan is loaded. @type {Look | null} */
  let wanted = null;
  let fitted = "";
  /** The box in view after a fit, larger for each frame since that reached beyond it. @type {Box | null} */
  let box = null;
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
    if (page.drawn) stage.fit((box = withFrame(page.drawn, page.drawn.extent, stage.size)));
  }

  /** A frame that reaches beyond what is in view is shown whole, unless a person has moved the camera. @param {import("../wire.js").State} state */
  function grow(state) {
    if (!box || state.world || state.framing || stage.look) return;
    const larger = withFrame(state, united(box, state.extent), stage.size);
    if (String(united(box, larger)) !== String(box)) stage.fit((box = larger));
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
    setState(state) {
      const { recording, place: scans, framing, segments, layers, world, view } = state;
      stage.gridded = layers.grid;
      stage.place(world, view.ride === "on");
      // A drawn world stays where it is while it changes.
      const around = world ? `world ${world.lasers.some(({ why }) => why !== null)}` : "";
      const place = drawing() ? "drawn" : `${scans} ${around}`;
      if (place !== fitted) {
        fitted = place;
        closeUp.forget();
        fit();
      } else grow(state);
      closeUp.set({ framing, segments });
      if (!wanted || !names(recording)) return;
      stage.lookAt(wanted);
      wanted = null;
    },
    /** @param {import("../wire.js").Welcome} welcome */
    setWelcome: ({ viser }) => stage.open(viser),
  };
}

/**
 * The box of the recording, made larger for that of frames where that does not make all much smaller.
 * @param {import("../wire.js").State} state @param {Box} extent @param {{width: number, height: number}} size of the stage [px]
 * @returns {Box}
 */
function withFrame({ bounds, world }, extent, { width, height }) {
  if (world) return bounds;
  const both = united(bounds, extent);
  const scale = (/** @type {Box} */ [left, low, right, high]) =>
    Math.min((width || 1) / (right - left), (height || 1) / (high - low));
  return scale(bounds) > MOST_SMALLER * scale(both) ? bounds : both;
}

/** @param {Box} one @param {Box} other @returns {Box} */
function united(one, other) {
  return [
    Math.min(one[0], other[0]),
    Math.min(one[1], other[1]),
    Math.max(one[2], other[2]),
    Math.max(one[3], other[3]),
  ];
}
