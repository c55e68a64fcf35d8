// @ts-check
// Light, dark, or the same as the system. The choice is kept in this browser; the View has the resulting theme.

import { keep, recall } from "./kept.js";

const KEY = "lineseg.theme";

/** @typedef {"auto" | "light" | "dark"} Theme */

/** @param {(dark: boolean) => void} onDark told when the system's choice or the person's is another */
export function createTheme(onDark) {
  const systemDark = matchMedia("(prefers-color-scheme: dark)");
  const kept = recall(KEY);
  /** @type {Theme} */
  let theme = kept === "light" || kept === "dark" ? kept : "auto";
  systemDark.addEventListener("change", () => onDark(show()));

  /** @param {Theme} chosen */
  function set(chosen) {
    theme = chosen;
    keep(KEY, theme === "auto" ? null : theme);
    onDark(show());
  }

  /** @returns {boolean} dark */
  function show() {
    document.documentElement.dataset.theme = theme;
    return theme === "dark" || (theme === "auto" && systemDark.matches);
  }

  return { saved: () => theme, set, show };
}
