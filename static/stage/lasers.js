// @ts-check
// Which colour of the scene is which laser of the robot, while several are shown.
import { h } from "../widgets/dom.js";

/** @typedef {typeof import("../text/page.js").pageText.stage.world.lasers} Text */

/** @param {Text} text */
export function createLasers(text) {
  const list = h("ul");
  const element = h(
    "details",
    { class: "scene-key lasers-key", open: true, hidden: true },
    h("summary", {}, text.label),
    list,
  );
  let told = "";
  return {
    element,
    /** @param {import("../wire.js").State} state */
    setState({ world, topic }) {
      const lasers = world?.lasers ?? [];
      const telling = JSON.stringify([topic, lasers]);
      if (telling === told) return;
      told = telling;
      element.hidden = !lasers.length;
      const rows = lasers.map(({ topic, colour, why }) =>
        row(topic, colour, why === null ? text.reading : why && text.absent(why)),
      );
      list.replaceChildren(row(topic), ...rows);
    },
  };
}

/** Without a colour, of the laser whose segments are shown. @param {string} topic @param {string} [colour] @param {string} [said] */
function row(topic, colour, said) {
  const mark = h("i", { class: colour ? "mark mark-laser" : "mark mark-segments", "aria-hidden": "true" });
  if (colour) mark.style.setProperty("--mark", colour);
  return h("li", {}, mark, h("span", {}, topic, said ? h("span", { class: "muted" }, ` ${said}`) : null));
}
