// @ts-check
// The switch between the modes of the page.
import { h } from "../widgets/dom.js";

export const MODES = /** @type {const} */ (["tune", "learn", "inspect"]);
/** @typedef {(typeof MODES)[number]} Mode */

/**
 * @param {{label: string} & Record<Mode, string>} text
 * @param {(mode: Mode) => void} onMode
 */
export function createModes(text, onMode) {
  const buttons = MODES.map((mode) =>
    h(
      "button",
      { type: "button", class: "mode", "data-mode": mode, "aria-pressed": "false", onclick: () => onMode(mode) },
      text[mode],
    ),
  );
  return {
    element: h("div", { class: "modes", role: "group", "aria-label": text.label }, ...buttons),
    /** @param {string} mode */
    set(mode) {
      for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    },
  };
}
