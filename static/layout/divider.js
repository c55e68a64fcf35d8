// @ts-check
// A bar between two parts of the page: dragging it changes a size, its button hides and shows a part.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";

const KEY_STEP_PX = 24;

/**
 * The size grows towards the upper left.
 * @param {{size: string, hide: string, show: string}} text
 * @param {{upright: () => boolean, size: () => number, onSize: (size: number) => void, onUsual: () => void, onToggle: () => void}} handlers
 *   upright: whether it is dragged to the left and right; size: the present one [px]
 */
export function createDivider(text, { upright, size, onSize, onUsual, onToggle }) {
  const button = iconButton("chevron", text.hide, onToggle);
  const grip = h("div", { class: "divider-grip", role: "separator", tabIndex: 0, "aria-label": text.size });
  const element = h("div", { class: "divider" }, grip, button);
  /** Where the pointer was, and the size there. @type {{at: number, size: number} | null} */
  let held = null;
  const place = (/** @type {PointerEvent} */ { clientX, clientY }) => (upright() ? clientX : clientY);

  grip.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    // The scene's frame would take the pointer otherwise.
    grip.setPointerCapture(event.pointerId);
    held = { at: place(event), size: size() };
  });
  grip.addEventListener("pointermove", (event) => held && onSize(held.size + held.at - place(event)));
  for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
    grip.addEventListener(kind, () => (held = null));
  grip.addEventListener("dblclick", onUsual);
  grip.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
    if (by) onSize(size() + by * KEY_STEP_PX);
    else if (event.key === "Home") onUsual();
    else if (event.key === "Enter") onToggle();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });

  return {
    element,
    /** @param {boolean} hidden */
    show(hidden) {
      element.classList.toggle("closed", hidden);
      element.classList.toggle("level", !upright());
      grip.setAttribute("aria-orientation", upright() ? "vertical" : "horizontal");
      grip.setAttribute("aria-valuenow", String(Math.round(hidden ? 0 : size())));
      button.show("chevron", hidden ? text.show : text.hide);
    },
  };
}
