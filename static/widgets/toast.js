// @ts-check
import { h } from "./dom.js";

const SHOWN_MS = 4000;
/** @type {HTMLElement | null} */
let box = null;
let timer = 0;

/** Shows a message for a moment. @param {string} words */
export function toast(words) {
  if (!box) {
    box = h("div", { class: "toast", role: "status", popover: "manual" });
    document.body.append(box);
  }
  box.textContent = words;
  if (box.matches(":popover-open")) box.hidePopover();
  box.showPopover();
  clearTimeout(timer);
  timer = setTimeout(() => box?.hidePopover(), SHOWN_MS);
}
