// @ts-check
import { h } from "./dom.js";

const DELAY_MS = 350;
const GAP = 6;

/** @type {HTMLElement | null} */
let box = null;
/** @type {Element | null} */
let owner = null;
let timer = 0;

/**
 * Shows a tooltip on hover and on keyboard focus.
 * @param {HTMLElement} element
 * @param {string | ((event: Event) => string)} content may depend on where the pointer is
 * @param {"below" | "left"} side
 */
export function tooltip(element, content, side = "below") {
  /** @type {Event} */
  let last = new Event("pointermove");
  const show = () => {
    const words = typeof content === "string" ? content : content(last);
    if (words && element.isConnected) place(element, words, side);
  };
  element.addEventListener("pointerenter", (event) => {
    if (event.pointerType === "touch") return;
    last = event;
    clearTimeout(timer);
    timer = setTimeout(show, DELAY_MS);
  });
  element.addEventListener("pointermove", (event) => {
    last = event;
    if (box && owner === element && typeof content !== "string") box.textContent = content(event);
  });
  element.addEventListener("focusin", (event) => {
    if (!(event.target instanceof Element && event.target.matches(":focus-visible"))) return;
    clearTimeout(timer);
    timer = setTimeout(show, DELAY_MS);
  });
  for (const gone of ["pointerleave", "pointerdown", "focusout"])
    element.addEventListener(gone, () => hideTooltip(element));
}

/** @param {Element} [element] only if the tooltip is this element's */
export function hideTooltip(element) {
  clearTimeout(timer);
  if (element && owner !== element) return;
  owner = null;
  if (box?.matches(":popover-open")) box.hidePopover();
}

/** @param {HTMLElement} element @param {string} words @param {"below" | "left"} side */
function place(element, words, side) {
  if (!box) {
    box = h("div", { class: "tooltip", role: "tooltip", popover: "manual" });
    document.body.append(box);
  }
  owner = element;
  box.textContent = words;
  if (!box.matches(":popover-open")) box.showPopover();
  const at = element.getBoundingClientRect();
  const own = box.getBoundingClientRect();
  let x = at.left + at.width / 2 - own.width / 2;
  let y = at.bottom + GAP;
  if (side === "left" && at.left - own.width - GAP > 0) {
    x = at.left - own.width - GAP;
    y = at.top;
  } else if (y + own.height > innerHeight - GAP) y = at.top - own.height - GAP;
  box.style.left = `${Math.round(Math.min(Math.max(GAP, x), innerWidth - own.width - GAP))}px`;
  box.style.top = `${Math.round(Math.min(Math.max(GAP, y), innerHeight - own.height - GAP))}px`;
}
