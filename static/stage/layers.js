// @ts-check
// Switches for the layers; they also serve as the legend.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { popUnder } from "../widgets/menu.js";
import { tooltip } from "../widgets/tooltip.js";

/**
 * @param {typeof import("../text/page.js").pageText} words
 * @param {(layers: Record<string, boolean>) => void} onLayers
 */
export function createLayers(words, onLayers) {
  /** @type {Map<string, HTMLInputElement>} */
  const boxes = new Map();
  const names = Object.keys(words.layers);
  const rows = Object.entries(words.layers).map(([name, { label, help }]) => {
    const box = h("input", { type: "checkbox", onchange: () => onLayers({ [name]: box.checked }) });
    boxes.set(name, box);
    const row = h(
      "label",
      { class: "layer" },
      box,
      h("span", { class: `swatch swatch-${name}`, "aria-hidden": "true" }),
      label,
    );
    tooltip(row, help, "left");
    return row;
  });
  const button = iconButton("layers", words.stage.layers, () => {});
  const list = h(
    "div",
    { class: "menu layers", popover: "auto", role: "group", "aria-label": words.stage.layers },
    ...rows,
  );
  list.addEventListener("keydown", (event) => event.key !== "Escape" && event.stopPropagation());
  popUnder(button, list, true, () => {});
  return {
    button,
    list,
    /** @param {string} name of a layer */
    toggle: (name) => boxes.get(name)?.click(),
    /** Offers the true walls only if they are known, and the world only in it. @param {import("../wire.js").State} state */
    setState({ truth, world, topics }) {
      rows[names.indexOf("truth")].hidden = !truth;
      for (const name of ["trajectory", "past", "all_lines", "line_map"]) rows[names.indexOf(name)].hidden = !world;
      rows[names.indexOf("other_lasers")].hidden = !world || topics.length < 2;
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView({ layers }) {
      for (const [name, box] of boxes) box.checked = layers[name] ?? false;
    },
  };
}
