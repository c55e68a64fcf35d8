// @ts-check
// The kind of stage that this browser can show.
import { CanvasStage } from "./canvas_stage.js";
import { Stage } from "./stage.js";

/** Both answer the same questions about the plan; only the first has a free view. @typedef {Stage | CanvasStage} AnyStage */

/** @param {HTMLElement} holder @param {typeof import("../text/page.js").pageText.stage} text @param {ConstructorParameters<typeof Stage>[2]} handlers */
export function createStage(holder, text, handlers) {
  return hasWebGL() ? new Stage(holder, text, handlers) : new CanvasStage(holder, text, handlers);
}

/** viser needs it. */
function hasWebGL() {
  return document.createElement("canvas").getContext("webgl2") !== null;
}
