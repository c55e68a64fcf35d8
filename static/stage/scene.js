// @ts-check
// The stage with its notices, its tools and the card that explains a point.
import { createExplanation } from "../tune/explanation.js";
import { h } from "../widgets/dom.js";
import { createCamera } from "./camera.js";
import { createKey } from "./key.js";
import { createLayers } from "./layers.js";
import { createNames } from "./names.js";
import { createPointing } from "./pointing.js";
import { mountNotices } from "./notices.js";
import { Stage } from "./stage.js";

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
  const stage = new Stage(holder, text.stage, { onKey, onFrame });
  const notices = mountNotices(holder, text.stage, { onCancel, onRetry });
  const names = createNames(holder, stage);
  const key = createKey(holder, text.stage.key);
  const camera = createCamera(page, stage, text.stage, {
    drawing,
    names: isNamed,
    onLook,
    onFraming: (framing) => names.set(framing?.names ?? [], framing?.measures ?? [], framing?.normal),
  });
  const layers = createLayers(text, (switched) => page.change({ layers: switched }));
  const pointing = createPointing(page, holder, stage, { onLight, onThreshold, label: text.stage.beam });
  const explanation = createExplanation(text.explanation, stage, pointing, {
    onClose: () => page.change({ selected: null }),
    onChange: (params) => page.change({ params }),
  });
  const tools = h("div", { class: "stage-tools" }, ...camera.buttons, layers.button);
  notices.add(key.element);
  holder.append(tools, layers.list, explanation.element);
  holder.setAttribute("aria-label", text.stage.label);
  return {
    parts: [notices, layers, camera, key, pointing, explanation],
    stage,
    notices,
    camera,
    layers,
    explanation,
    pointing,
  };
}
