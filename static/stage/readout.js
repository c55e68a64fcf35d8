// @ts-check
// What the pointer points at: x, y, range, bearing and beam.
import { h, setText } from "../widgets/dom.js";

/** @typedef {[number, number]} Point */

/** @param {HTMLElement} holder the stage @param {typeof import("../text/page.js").pageText.stage.readout} text */
export function createReadout(holder, text) {
  const element = h("div", { class: "readout", "aria-hidden": "true", hidden: true });
  holder.append(element);
  return {
    /** @param {Point | null} at of the plan [m] @param {import("../wire.js").Sweep | null} sweep @param {string} [more] */
    show(at, sweep, more = "") {
      element.hidden = at === null;
      if (!at) return;
      const bearing = Math.atan2(at[1], at[0]);
      const words = text(at, Math.hypot(...at), (180 * bearing) / Math.PI, sweep && beamTowards(sweep, bearing));
      setText(element, [words, more].filter(Boolean).join("   "));
    },
  };
}

/** The beam of this bearing; null outside of the field of view. @param {import("../wire.js").Sweep} sweep @param {number} bearing [rad] */
export function beamTowards({ bearings }, bearing) {
  const step = Math.abs((bearings.at(-1) ?? 0) - bearings[0]) / Math.max(1, bearings.length - 1);
  let [best, least] = [/** @type {number | null} */ (null), 1.5 * step];
  for (const [beam, other] of bearings.entries()) {
    const apart = Math.abs(Math.atan2(Math.sin(other - bearing), Math.cos(other - bearing)));
    if (apart < least) [best, least] = [beam, apart];
  }
  return best;
}
