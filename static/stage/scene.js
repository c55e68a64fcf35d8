// @ts-check
// The stage with its notices, its tools and the card that explains a point.
import { createExplanation } from "../tune/explanation.js";
import { h } from "../widgets/dom.js";
import { createCamera } from "./camera.js";
import { createKey } from "./key.js";
import { createMapLines } from "./map_lines.js";
import { createLasers } from "./lasers.js";
import { createLayers } from "./layers.js";
import { CanvasStage } from "./canvas_stage.js";
import { createFlatPicture } from "./flat_picture.js";
import { createStage } from "./kinds.js";
import { createNames } from "./names.js";
import { createPick } from "./pick.js";
import { createPointing } from "./pointing.js";
import { mountNotices } from "./notices.js";
import { createReadout } from "./readout.js";
import { createRuler } from "./ruler.js";
import { createWorld } from "./world.js";

const MAP_REACH_PX = 8;

/**
 * @param {import("../page.js").Page} page
 * @param {HTMLElement} holder
 * @param {typeof import("../text/page.js").pageText} text
 * @param {{onKey: (event: KeyboardEvent) => boolean, onFrame: (frame: Window) => void, onCancel: () => void, onRetry: () => void,
 *          drawing: () => boolean, names: (recording: string) => boolean, onLook: () => void,
 *          onLight: (threshold: string | null) => void, onThreshold: (name: string) => void}} handlers as of the stage, the notices, the camera, the pointing
 */
export function mountScene(
  page,
  holder,
  text,
  { onKey, onFrame, onCancel, onRetry, drawing, names: isNamed, onLook, onLight, onThreshold },
) {
  const stage = createStage(holder, text.stage, { onKey, onFrame, onPick: createPick(page) });
  const notices = mountNotices(holder, text.stage, { onCancel, onRetry });
  const key = createKey(holder, text.stage.key, stage, () => names.place());
  const names = createNames(holder, stage);
  const camera = createCamera(page, stage, text.stage, {
    drawing,
    names: isNamed,
    onLook,
    onFraming: names.set,
  });
  const layers = createLayers(text, (switched) => page.change({ layers: switched }));
  const mapLines = createMapLines(page.sessionId);
  const readout = createReadout(holder, text.stage.readout);
  const pointing = createPointing(page, holder, stage, {
    onLight,
    onThreshold,
    label: text.stage.beam,
    onPlace: (at, sweep) => {
      const line = at && mapLines.at(at, MAP_REACH_PX / (stage.sight?.pxPerMetre ?? Infinity));
      readout.show(at, sweep, line ? text.stage.world.mapped(line.length, line.sigma, line.seen) : "");
    },
  });
  const ruler = createRuler(holder, stage, text.stage.ruler, {
    sweep: () => pointing.sweep,
    onHover: (at) => pointing.hover(at, false),
    plan: () => page.change({ camera: "plan" }),
  });
  const flat = stage instanceof CanvasStage ? createFlatPicture(page, stage, text.stage) : null;
  if (flat) notices.add(flat.notice);
  notices.add(ruler.card);
  const world = createWorld(page, text.stage.world);
  const lasers = createLasers(text.stage.world.lasers);
  const explanation = createExplanation(text.explanation, stage, pointing, {
    onClose: () => page.change({ selected: null }),
    onChange: (params) => page.change({ params }),
  });
  const tools = h("div", { class: "stage-tools" }, ...camera.buttons, ruler.button, world.button, layers.button);
  notices.add(lasers.element);
  holder.append(tools, key.element, world.list, layers.list, explanation.element);
  stage.keepClearOf([tools]);
  holder.setAttribute("aria-label", text.stage.label);
  return {
    parts: [
      notices,
      mapLines,
      layers,
      camera,
      world,
      key,
      lasers,
      pointing,
      ruler,
      explanation,
      ...(flat ? [flat] : []),
    ],
    stage,
    notices,
    camera,
    layers,
    world,
    explanation,
    pointing,
    ruler,
  };
}
