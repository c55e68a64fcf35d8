// @ts-check
import { iconButton } from "../widgets/icon.js";

const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** @typedef {import("../theme.js").Theme} Theme */

/**
 * The button that switches to the next theme.
 * @param {typeof import("../text/page.js").pageText.top} text
 * @param {Theme} theme
 * @param {(theme: Theme) => void} onTheme
 */
export function createThemeButton(text, theme, onTheme) {
  /** @type {Record<Theme, [import("../widgets/icon.js").IconName, string]>} */
  const shown = { auto: ["auto", text.themeAuto], light: ["sun", text.themeLight], dark: ["moon", text.themeDark] };
  const button = iconButton("auto", text.themeAuto, () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
    button.show(...shown[theme]);
    onTheme(theme);
  });
  button.show(...shown[theme]);
  return button;
}
