// @ts-check
import { createMenu } from "../widgets/menu.js";
import { format } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";
import { PRESETS } from "./presets.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */

/**
 * The menu of the paper's thresholds and of lasers whose ε and κ are known.
 * @param {typeof import("../text/page.js").pageText.tune} text
 * @param {{knobs: () => Knob[], onParams: (params: Params) => void}} handlers
 */
export function createPresetMenu(text, { knobs, onParams }) {
  const menu = createMenu({ label: text.presetChoose, name: text.preset, groups });
  tooltip(menu.button, text.presetHelp, "left");

  function groups() {
    const told = (/** @type {Params} */ params) =>
      knobs().flatMap((knob) => (params[knob.name] ? [`${knob.symbol}\u00a0${format(knob, params[knob.name])}`] : []));
    const lasers = PRESETS.map(({ laser, range, params }) => ({
      label: laser,
      note: text.presetHint(range, told(params).join(", ")),
      run: () => onParams(params),
    }));
    const paper = { label: text.presetPaper, note: "", run: () => onParams(defaultsOf(knobs())) };
    return [
      { title: "", items: [paper] },
      { title: text.presetHelp, items: lasers },
    ];
  }

  return {
    element: menu.element,
    /** Names the preset that the thresholds are. @param {Params} params */
    show(params) {
      const is = (/** @type {Params} */ preset) =>
        Object.entries(defaultsOf(knobs())).every(([name, usual]) => params[name] === (preset[name] ?? usual));
      const laser = PRESETS.find((preset) => is(preset.params))?.laser;
      menu.setLabel(laser ?? (is({}) ? text.presetPaper : text.presetChoose));
    },
  };
}

/** @param {Knob[]} knobs @returns {Params} */
export function defaultsOf(knobs) {
  return Object.fromEntries(knobs.map((knob) => [knob.name, knob.default]));
}
