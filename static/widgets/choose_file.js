// @ts-check
// The dialog of the browser in which files are chosen.
import { h } from "./dom.js";

/**
 * @param {(files: File[]) => void} onFiles
 */
export function chooseFile(onFiles) {
  const input = h("input", { type: "file", multiple: true });
  input.addEventListener("change", () => onFiles([...(input.files ?? [])]));
  input.click();
}
