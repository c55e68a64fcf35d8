// @ts-check
import { h } from "./dom.js";
import { iconButton } from "./icon.js";

/**
 * A modal dialog with a title; it is removed when it closes.
 * @param {string} title
 * @param {string} closeLabel
 * @param {...(Node | string)} content
 */
export function openDialog(title, closeLabel, ...content) {
  const close = iconButton("close", closeLabel, () => dialog.close());
  const dialog = h(
    "dialog",
    { class: "dialog", "aria-label": title },
    h("header", { class: "dialog-header" }, h("h2", {}, title), close),
    ...content,
  );
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}
