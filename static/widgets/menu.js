// @ts-check
import { h } from "./dom.js";
import { icon } from "./icon.js";
import { hideTooltip } from "./tooltip.js";

/** @typedef {{label: string, note?: string, current?: boolean, disabled?: boolean, run: () => void}} Item */
/** @typedef {{title: string, items: Item[]}} Group */

/**
 * A button that opens a list of commands in groups.
 * @param {object} options
 * @param {string} options.label what the button says, if nothing is chosen in it
 * @param {string} [options.name] accessible name
 * @param {string} [options.className]
 * @param {boolean} [options.atEnd] whether the list ends, not begins, where the button does
 * @param {boolean} [options.leaves] whether a choice gives the keys back to the page, so that Space plays
 * @param {() => Group[]} options.groups asked each time it opens
 */
export function createMenu({ label, name, className = "", atEnd = false, leaves = false, groups }) {
  const words = h("span", { class: "menu-label" }, label);
  const button = h(
    "button",
    { type: "button", class: `menu-button ${className}`, "aria-haspopup": "menu", "aria-expanded": "false" },
    words,
    icon("chevron"),
  );
  const list = h("div", { class: "menu", role: "menu", popover: "auto", "aria-label": name ?? label });
  if (name) button.setAttribute("aria-label", `${name}: ${label}`);
  popUnder(button, list, atEnd, () => {
    list.replaceChildren(...groups().map(groupElement));
    const start = list.querySelector('[aria-checked="true"]') ?? list.querySelector("button");
    if (start instanceof HTMLElement) requestAnimationFrame(() => start.focus());
  });

  /** @param {Group} group */
  function groupElement({ title, items }) {
    const entries = items.map((item) =>
      h(
        "button",
        {
          type: "button",
          class: "menu-item",
          role: item.current === undefined ? "menuitem" : "menuitemradio",
          "aria-checked": item.current,
          tabIndex: -1,
          disabled: item.disabled ?? false,
          onclick: () => {
            list.hidePopover();
            if (leaves) button.blur();
            else button.focus();
            item.run();
          },
        },
        h("span", {}, item.label),
        item.note ? h("span", { class: "menu-note" }, item.note) : null,
      ),
    );
    const heading = title ? h("div", { class: "menu-title", "aria-hidden": "true" }, title) : null;
    return h("div", { role: "group", "aria-label": title, class: "menu-group" }, heading, ...entries);
  }

  list.addEventListener("keydown", (event) => {
    const items = /** @type {HTMLElement[]} */ ([...list.querySelectorAll("button:not(:disabled)")]);
    const at = items.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
    event.stopPropagation();
    if (event.key === "Tab" || event.key === "Escape") list.hidePopover();
    if (event.key === "Escape") button.focus();
    if (to === undefined) {
      if (event.key.length === 1) items.find((item, k) => k > at && starts(item, event.key))?.focus();
      return;
    }
    event.preventDefault();
    items[(to + items.length) % items.length].focus();
  });

  return {
    element: h("div", { class: "menu-holder" }, button, list),
    button,
    /** @param {string} shown */
    setLabel(shown) {
      if (words.textContent === shown) return;
      words.textContent = shown;
      words.title = shown;
      if (name) button.setAttribute("aria-label", `${name}: ${shown}`);
    },
  };
}

/** @param {HTMLElement} item @param {string} letter */
function starts(item, letter) {
  return (item.textContent ?? "").toLowerCase().startsWith(letter.toLowerCase());
}

/**
 * Opens `box` (a popover) under `button`.
 * @param {HTMLButtonElement} button
 * @param {HTMLElement} box
 * @param {boolean} atEnd
 * @param {() => void} onOpen
 */
export function popUnder(button, box, atEnd, onOpen) {
  button.popoverTargetElement = box;
  box.addEventListener("beforetoggle", (event) => {
    const opening = /** @type {ToggleEvent} */ (event).newState === "open";
    button.setAttribute("aria-expanded", String(opening));
    if (!opening) return;
    hideTooltip();
    onOpen();
  });
  box.addEventListener("toggle", (event) => {
    if (/** @type {ToggleEvent} */ (event).newState === "open") placeUnder(button, box, atEnd);
  });
}

/** @param {HTMLElement} button @param {HTMLElement} box @param {boolean} atEnd */
function placeUnder(button, box, atEnd) {
  const at = button.getBoundingClientRect();
  const own = box.getBoundingClientRect();
  const left = atEnd ? at.right - own.width : at.left;
  box.style.left = `${Math.max(8, Math.min(left, innerWidth - own.width - 8))}px`;
  box.style.top = `${at.bottom + 4}px`;
  box.style.maxHeight = `${innerHeight - at.bottom - 16}px`;
}

/** Closes the open menu; clicks in the scene's frame do not reach this document. */
export function closePopovers() {
  for (const open of document.querySelectorAll(":popover-open")) {
    if (open instanceof HTMLElement && open.getAttribute("popover") === "auto") open.hidePopover();
  }
}
