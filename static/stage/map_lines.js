// @ts-check
// The lines of the map on the screen, and the one at the pointer.
import { fetchText } from "../fetch.js";
import { fromPart } from "./measure.js";
import { placed } from "./placed.js";

/** @typedef {import("../wire.js").MapLines} Lines */
/** @typedef {[number, number]} Point */

/** @param {() => string} session */
export function createMapLines(session) {
  /** What the lines belong to, "" for none. */
  let about = "";
  /** @type {Lines | null} */ let lines = null;
  /** @type {import("../wire.js").World | null} */ let world = null;

  async function ask() {
    const mine = about;
    const { words, trouble } = await fetchText(`/api/line-map?${new URLSearchParams({ session: session() })}`);
    if (!trouble && mine === about) lines = JSON.parse(words);
  }

  return {
    /** @param {import("../wire.js").State} state */
    setState(state) {
      world = state.world;
      const shown = state.layers.line_map && world?.map ? `${state.place} ${world.map}` : "";
      if (shown === about) return;
      about = shown;
      lines = null;
      if (shown) ask();
    },
    /** Length, sigma and number of lines of the nearest map line within reach. @param {Point} at as the laser sees it @param {number} reach [m] */
    at(at, reach) {
      const there = lines && placed(world, at);
      return lines && there ? nearest(lines, there, reach) : null;
    },
  };
}

/** @param {Lines} lines @param {Point} at @param {number} reach */
function nearest({ ends, sigma, seen }, at, reach) {
  let [best, least] = [-1, reach];
  for (const [k, [x1, y1, x2, y2]] of ends.entries()) {
    const away = fromPart(at, [
      [x1, y1],
      [x2, y2],
    ]);
    if (away < least) [best, least] = [k, away];
  }
  if (best < 0) return null;
  const [x1, y1, x2, y2] = ends[best];
  return { length: Math.hypot(x2 - x1, y2 - y1), sigma: sigma[best], seen: seen[best] };
}
