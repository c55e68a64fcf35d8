// @ts-check
// Light, dark, or the same as the system. The choice is kept in this browser; the View has the resulting theme.

const KEY = "lineseg.theme";

/** @typedef {"auto" | "light" | "dark"} Theme */

/** @param {(dark: boolean) => void} onDark told when the system's choice or the person's is another */
export function createTheme(onDark) {
  const systemDark = matchMedia("(prefers-color-scheme: dark)");
  systemDark.addEventListener("change", () => set(saved()));

  /** @returns {Theme} */
  function saved() {
    const kept = localStorage.getItem(KEY);
    return kept === "light" || kept === "dark" ? kept : "auto";
  }

  /** @param {Theme} theme */
  function set(theme) {
    if (theme === "auto") localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, theme);
    onDark(show());
  }

  /** @returns {boolean} dark */
  function show() {
    const theme = saved();
    document.documentElement.dataset.theme = theme;
    return theme === "dark" || (theme === "auto" && systemDark.matches);
  }

  return { saved, set, show };
}
