// @ts-check
import { h } from "../widgets/dom.js";
import { createNumberField } from "../widgets/number.js";
import { tooltip } from "../widgets/tooltip.js";

/**
 * The field for a beam; each press of Enter goes to the next decision about it.
 * @param {typeof import("../text/learn.js").learnText.steps} text
 * @param {{beams: () => number, onBeam: (beam: number) => void}} handlers
 */
export function createBeamField(text, { beams, onBeam }) {
  const field = createNumberField({
    label: text.beam,
    className: "frame-number beam-number",
    repeats: true,
    accept(typed) {
      const wanted = Number(typed);
      const most = beams() - 1;
      if (!Number.isInteger(wanted) || wanted < 0 || wanted > most) return text.noBeam(most);
      field.set(String(wanted));
      onBeam(wanted);
      return null;
    },
  });
  tooltip(field.element, text.beamHint);
  return h("span", { class: "counter" }, h("span", { class: "of" }, text.beam), field.element, field.error);
}
