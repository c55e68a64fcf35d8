// @ts-check
// The page's colours in the form that a canvas needs: custom properties with light-dark() are resolved by the browser.

/** @type {Map<string, string>} */
const known = new Map();
/** @type {Set<() => void>} */
const listeners = new Set();
const probe = document.createElement("span");
probe.hidden = true;

/** @param {string} name of a custom property, e.g. "--accent" */
export function colour(name) {
  const found = known.get(name);
  if (found) return found;
  if (!probe.isConnected) document.body.append(probe);
  probe.style.color = `var(${name})`;
  const resolved = getComputedStyle(probe).color;
  known.set(name, resolved);
  return resolved;
}

/** Calls `listener` whenever the theme changes. @param {() => void} listener */
export function onTheme(listener) {
  listeners.add(listener);
}

function changed() {
  known.clear();
  for (const listener of listeners) listener();
}
new MutationObserver(changed).observe(document.documentElement, { attributeFilter: ["data-theme"] });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
