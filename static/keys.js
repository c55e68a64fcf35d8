// @ts-check
// The keyboard: one table serves both the keys and the help that lists them.
import { openDialog } from "./widgets/dialog.js";
import { h } from "./widgets/dom.js";

/** @typedef {{keys: string[], shown: string, does: string, run: (event: KeyboardEvent) => void}} Binding */

/** `Ctrl+Shift+Z`, `ArrowLeft`, `f`. @param {KeyboardEvent} event */
function chord(event) {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const control = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
  // A shifted symbol ("?") is the symbol itself.
  const shift = event.shiftKey && (key.length > 1 || /[a-z]/.test(key)) ? "Shift+" : "";
  return `${control}${event.altKey ? "Alt+" : ""}${shift}${key === " " ? "Space" : key}`;
}

/** @param {Binding[]} bindings @returns {(event: KeyboardEvent) => boolean} runs the binding, true if there is one */
export function keyboard(bindings) {
  const table = new Map(bindings.flatMap((binding) => binding.keys.map((key) => [key, binding])));
  return (event) => {
    // A dialog whose focused button is disabled leaves the focus, and so its keys, to the page.
    if (event.defaultPrevented || typing(event.target) || document.querySelector("dialog[open]")) return false;
    const pressed = chord(event);
    if (operates(event.target, pressed)) return false;
    const binding = table.get(pressed);
    if (!binding) return false;
    event.preventDefault();
    binding.run(event);
    return true;
  };
}

/** Elements in the scene's frame belong to another window, so `instanceof` does not recognise them. @param {EventTarget | null} target */
function typing(target) {
  const element = /** @type {HTMLInputElement | null} */ (target);
  const tag = element?.tagName;
  return (
    tag === "TEXTAREA" ||
    tag === "SELECT" ||
    (tag === "INPUT" && !/^(range|checkbox|button)$/.test(element?.type ?? ""))
  );
}

/** Whether the focused control handles the key itself. @param {EventTarget | null} target @param {string} pressed */
function operates(target, pressed) {
  const element = /** @type {HTMLElement | null} */ (target);
  if (pressed !== "Space" && pressed !== "Enter") return false;
  return Boolean(element?.closest?.("button, summary, a, input[type=checkbox]"));
}

/** A clicked mode or tab gives the keys back to the page, so that Space plays. @param {Document} page */
export function giveKeysBack(page) {
  page.addEventListener("click", ({ target, detail }) => {
    const clicked = /** @type {Element} */ (target).closest?.(".mode, .tab, .stage-tools button, .divider button");
    if (detail > 0 && clicked instanceof HTMLElement) clicked.blur();
  });
}

/** @param {Binding[]} bindings @param {typeof import("./text/page.js").pageText} words */
export function showHelp(bindings, words) {
  if (document.querySelector("dialog[open]")) return;
  const row = (/** @type {string} */ keys, /** @type {string} */ does) =>
    h(
      "tr",
      {},
      h("td", {}, ...keys.split(" ").map((key) => h("kbd", {}, key.replace("␣", "Space")))),
      h("td", {}, does),
    );
  const rows = [
    ...bindings.filter(({ shown }) => shown).map(({ shown, does }) => row(shown, does)),
    row("← → PgUp PgDn Home End", words.help.keys.slider),
  ];
  const mouse = words.help.mouse.map(([what, does]) => h("tr", {}, h("td", {}, what), h("td", {}, does)));
  openDialog(
    words.help.title,
    words.exchange.close,
    h("table", { class: "help" }, h("tbody", {}, ...rows)),
    h("table", { class: "help" }, h("tbody", {}, ...mouse)),
  );
}
