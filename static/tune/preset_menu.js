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
 * @param {{knobs: () => Knob[], onParams: (params: Params) => void, profiles: import("./profiles.js").Profiles}} handlers
 */
export function createPresetMenu(text, { knobs, onParams, profiles }) {
  const menu = createMenu({ label: text.presetChoose, name: text.preset, groups });
  tooltip(menu.button, text.presetHelp, "left");

  // Two of them may have the same values.
  let chosen = "";
  /** @param {string} name @param {Params} params */
  function choose(name, params) {
    chosen = name;
    onParams(params);
  }

  function groups() {
    const told = (/** @type {Params} */ params) =>
      knobs().flatMap((knob) => (params[knob.name] ? [`${knob.symbol}\u00a0${format(knob, params[knob.name])}`] : []));
    const lasers = PRESETS.map(({ laser, range, params }) => ({
      label: laser,
      note: text.presetHint(range, told(params).join(", ")),
      run: () => choose(laser, params),
    }));
    const paper = { label: text.presetPaper, note: "", run: () => choose(text.presetPaper, defaultsOf(knobs())) };
    const { title, items } = profiles.group();
    const own = { title, items: items.map((item) => ({ ...item, run: () => ((chosen = item.label), item.run()) })) };
    // Presets set ε for a laser; the thresholds of other methods mean something else.
    if (!forLasers(knobs())) return [own];
    return [{ title: "", items: [paper] }, { title: text.presetHelp, items: lasers }, own];
  }

  return {
    element: menu.element,
    /** Names the preset or profile that the thresholds are. @param {Params} params */
    show(params) {
      const is = (/** @type {Params} */ preset) =>
        Object.entries(defaultsOf(knobs())).every(([name, usual]) => params[name] === (preset[name] ?? usual));
      const names = PRESETS.filter((preset) => is(preset.params)).map(({ laser }) => laser);
      if (is({})) names.unshift(text.presetPaper);
      const fitting = [...(forLasers(knobs()) ? names : []), ...profiles.named(params)];
      menu.setLabel(fitting.includes(chosen) ? chosen : (fitting[0] ?? text.presetChoose));
    },
  };
}

/** @param {Knob[]} knobs */
function forLasers(knobs) {
  return ["epsilon", "delta"].every((name) => knobs.some((knob) => knob.name === name));
}

/** @param {Knob[]} knobs @returns {Params} */
export function defaultsOf(knobs) {
  return Object.fromEntries(knobs.map((knob) => [knob.name, knob.default]));
}
