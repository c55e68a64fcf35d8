// @ts-check
// The plan on a stage: which place of the scan is at which pixel. All functions are pure.
import { stretched } from "./viser.js";

/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("./viser.js").Stretch} Stretch */
/** @typedef {[number, number]} Point */
/** The plan on a stage: its middle [m], its scale, and the size of the stage [px].
 * @typedef {{x: number, y: number, pxPerMetre: number, width: number, height: number, stretch: Stretch | null}} Sight */

/** Around a whole plan; the smallest half of one [m]. */
export const WHOLE = { margin: 1.08, least: 0.5 };
/** Around a close-up there is room for names. */
export const CLOSE = { margin: 1.35, least: 0.02 };
// What is gone to fills this share of the stage, unless it can be seen already.
const SHARE = 0.25;
const EASILY_SEEN_PX = 60;
// And it is not as near as this to an edge.
const EDGE_PX = 30;

/** The middle of a box and the height of a stage [m] that shows all of it. @param {Box} box @param {{width: number, height: number}} size @param {{margin: number, least: number}} room */
export function around([xmin, ymin, xmax, ymax], { width, height }, { margin, least }) {
  const half = margin * Math.max((ymax - ymin) / 2, ((xmax - xmin) / 2 / width) * Math.max(1, height), least);
  return { x: (xmin + xmax) / 2, y: (ymin + ymax) / 2, span: 2 * half };
}

/** Where a point of the plan is [px]. @param {Sight} sight @param {number} x @param {number} y @returns {Point} */
export function project(sight, x, y) {
  const [right, up] = stretched(sight.stretch, [x, y]);
  const { pxPerMetre: scale, width, height } = sight;
  return [width / 2 + (right - sight.x) * scale, height / 2 - (up - sight.y) * scale];
}

/** The point of the plan at a pixel. @param {Sight} sight @param {number} left @param {number} top @returns {Point} */
export function unproject(sight, left, top) {
  const { pxPerMetre: scale, width, height } = sight;
  const drawn = /** @type {Point} */ ([sight.x + (left - width / 2) / scale, sight.y - (top - height / 2) / scale]);
  return stretched(sight.stretch, drawn, true);
}

/** Where to look to see a box well, from nearer by if it is too small; null if it can be seen well. @param {Sight | null} sight @param {{width: number, height: number}} size @param {Box} box */
export function towards(sight, { width, height }, [xmin, ymin, xmax, ymax]) {
  const [wide, high] = [xmax - xmin, ymax - ymin];
  const scale = sight?.pxPerMetre ?? 0;
  const large = Math.max(wide, high) * scale > EASILY_SEEN_PX && wide * scale < width && high * scale < height;
  const inside =
    sight &&
    [project(sight, xmin, ymin), project(sight, xmax, ymax)].every((at) =>
      at.every((place, k) => place > EDGE_PX && place < [width, height][k] - EDGE_PX),
    );
  if (large && inside) return null;
  const near = Math.max(high, (wide * height) / Math.max(1, width), 0.5) / SHARE;
  return { x: (xmin + xmax) / 2, y: (ymin + ymax) / 2, span: large ? height / scale : near };
}
