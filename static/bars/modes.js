// @ts-check
// The switch between the modes, and which parts of the page each mode shows.
import { h } from "../widgets/dom.js";

export const MODES = /** @type {const} */ (["tune", "learn", "inspect"]);
/** @typedef {(typeof MODES)[number]} Mode */

/**
 * @param {{label: string} & Record<Mode, string>} text
 * @param {HTMLElement} main told the mode
 * @param {Record<"learn" | "usual", HTMLElement[]>} shown in the mode Learn, in the others
 * @param {{onMode: (mode: Mode) => void, onEntered: () => void}} handlers
 */
export function createModes(text, main, shown, { onMode, onEntered }) {
  const buttons = MODES.map((mode) =>
    h(
      "button",
      { type: "button", class: "mode", "data-mode": mode, "aria-pressed": "false", onclick: () => onMode(mode) },
      text[mode],
    ),
  );
  let [chosen, covered] = [/** @type {string} */ (""), false];
  function show() {
    for (const button of buttons)
      button.setAttribute("aria-pressed", String(!covered && button.dataset.mode === chosen));
  }

  return {
    /** Something lies over the scene of the mode, so that the mode is not selected. @param {boolean} is */
    cover(is) {
      covered = is;
      show();
    },
    element: h("div", { class: "modes", role: "group", "aria-label": text.label }, ...buttons),
    /** @param {Readonly<import("../wire.js").View>} view */
    setView({ mode }) {
      chosen = mode;
      show();
      const entered = main.dataset.mode !== mode;
      main.dataset.mode = mode;
      if (entered) onEntered();
      for (const place of shown.learn) place.hidden = mode !== "learn";
      for (const place of shown.usual) place.hidden = mode === "learn";
    },
  };
}
