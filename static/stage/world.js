// @ts-check
// Chooses whether the scene shows the frame of the laser or the world, and what of the world.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { popUnder } from "../widgets/menu.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {typeof import("../text/page.js").pageText.stage.world} Text */

/**
 * @param {import("../page.js").Page} page
 * @param {Text} text
 */
export function createWorld(page, text) {
  const button = iconButton("world", text.open, () => {});
  const spaces = /** @type {const} */ (["laser", "world"]).map((space) => {
    const run = () => page.change({ space });
    const input = h("input", { type: "radio", name: "space", value: space, onchange: run });
    const row = h("label", { class: "layer" }, input, text.spaces[space].label);
    tooltip(row, text.spaces[space].help, "left");
    return { input, row };
  });
  const past = h(
    "select",
    { class: "select", onchange: () => page.change({ past: /** @type {any} */ (past.value) }) },
    ...Object.entries(text.past).map(([value, label]) => h("option", { value }, label)),
  );
  const ride = h("input", {
    type: "checkbox",
    onchange: () => page.change({ ride: ride.checked ? "on" : "off" }),
  });
  const rideRow = h("label", { class: "layer" }, ride, text.ride.label);
  tooltip(rideRow, text.ride.help, "left");
  const pastRow = h("label", { class: "layer" }, text.scans, past);
  const said = h("p", { class: "world-said muted", role: "status" });
  const list = h(
    "div",
    { class: "menu layers world", popover: "auto", role: "group", "aria-label": text.label },
    ...spaces.map(({ row }) => row),
    pastRow,
    rideRow,
    said,
  );
  list.addEventListener("keydown", (event) => event.key !== "Escape" && event.stopPropagation());
  popUnder(button, list, true, () => {});
  button.hidden = true;
  return {
    button,
    list,
    toggle: () => !button.hidden && page.change({ space: page.view.space === "world" ? "laser" : "world" }),
    /** @param {import("../wire.js").State} state */
    setState({ mayHavePoses, frames, topics, poses, world, mode, view, layers }) {
      button.hidden = !mayHavePoses || frames < 2 || mode === "learn";
      const asked = view.space === "world";
      for (const input of [past, ride]) input.disabled = !world;
      const lost = world && !world.pose ? text.lost : "";
      const apart = !world && topics.length > 1 ? text.apart(topics.length) : "";
      const map = world && layers.line_map ? text.map(world.map, world.mapPercent) : "";
      setText(said, asked ? [text.poses(poses), lost, apart, map].filter(Boolean).join(" ") : "");
      said.hidden = !asked;
      said.classList.toggle("warning", asked && !world?.pose);
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView({ space, past: wanted, ride: riding }) {
      for (const { input } of spaces) input.checked = input.value === space;
      past.value = wanted;
      ride.checked = riding === "on";
      button.setAttribute("aria-pressed", String(space === "world"));
    },
  };
}
