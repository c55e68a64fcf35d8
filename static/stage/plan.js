// @ts-check
// The plan on a stage: which place of the scan is at which pixel. All functions are pure.
import { stretched } from "./viser.js";

/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("./viser.js").Stretch} Stretch */
/** @typedef {[number, number]} Point */
/** @typedef {{width: number, height: number}} Size of a stage [px] */
/** @typedef {Size & {left: number, top: number}} Part of a stage [px] */
/** What lies over the upper edge of a stage [px]. @typedef {{left: number, right: number, bottom: number}} Cover */
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
// Beside what covers the stage a plan is shown only where there is at least this much room.
const LEAST_ROOM_PX = 90;

/**
 * Where to look to see all of a box, beside what covers the stage: the middle of the stage and its height [m].
 * @param {Box} box @param {Size} size @param {{margin: number, least: number}} room @param {Cover[]} covers
 */
export function around(box, size, room, covers = []) {
  const [whole, ...others] = roomsBeside(covers, size).map((part) => within(box, size, part, room));
  return (
    [whole, ...others]
      .filter(
        ({ span, ...middle }) =>
          !hidden(covers, { ...middle, pxPerMetre: size.height / span, ...size, stretch: null }, box),
      )
      .reduce(
        (best, each) => (best && best.span <= each.span ? best : each),
        /** @type {typeof whole | null} */ (null),
      ) ?? whole
  );
}

/** The same in a part of the stage. @param {Box} box @param {Size} size @param {Part} part @param {{margin: number, least: number}} room */
function within([xmin, ymin, xmax, ymax], size, part, { margin, least }) {
  const { width, height } = part;
  const half = margin * Math.max((ymax - ymin) / 2, ((xmax - xmin) / 2 / width) * Math.max(1, height), least);
  return seenIn(part, size, [(xmin + xmax) / 2, (ymin + ymax) / 2], (2 * half) / Math.max(1, height));
}

/** Where to look to see a place in the middle of a part of the stage. @param {Part} part @param {Size} size @param {Point} place @param {number} scale [m/px] */
function seenIn({ left, top, width, height }, size, [x, y], scale) {
  return {
    x: x - (left + (width - size.width) / 2) * scale,
    y: y + (top + (height - size.height) / 2) * scale,
    span: scale * Math.max(1, size.height),
  };
}

/** The whole stage, and its parts below and beside what covers it. @param {Cover[]} covers @param {Size} size @returns {Part[]} */
function roomsBeside(covers, { width, height }) {
  const onTheLeft = (/** @type {Cover} */ { left, right }) => left + right < width;
  const lefts = [0, ...covers.filter(onTheLeft).map(({ right }) => right)];
  const rights = [width, ...covers.filter((cover) => !onTheLeft(cover)).map(({ left }) => left)];
  const [whole, ...parts] = [0, ...covers.map(({ bottom }) => bottom)].flatMap((top) =>
    lefts.flatMap((left) => rights.map((right) => ({ left, top, width: right - left, height: height - top }))),
  );
  return [whole, ...parts.filter((part) => Math.min(part.width, part.height) >= LEAST_ROOM_PX)];
}

/** Whether a part of a box, all of which is on the stage, is covered. @param {Cover[]} covers @param {Sight} sight @param {Box} box */
function hidden(covers, sight, [xmin, , xmax, ymax]) {
  const [[first, top], [last]] = [project(sight, xmin, ymax), project(sight, xmax, ymax)];
  return covers.some(({ left, right, bottom }) => first < right && last > left && top < bottom);
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

/** Where to look to see a box well, from nearer by if it is too small; null if it can be seen well. @param {Sight | null} sight @param {Size} size @param {Box} box @param {Cover[]} covers */
export function towards(sight, size, box, covers = []) {
  const { width, height } = size;
  const [xmin, ymin, xmax, ymax] = box;
  const [wide, high] = [xmax - xmin, ymax - ymin];
  const scale = sight?.pxPerMetre ?? 0;
  const large = Math.max(wide, high) * scale > EASILY_SEEN_PX && wide * scale < width && high * scale < height;
  const inside =
    sight &&
    [project(sight, xmin, ymin), project(sight, xmax, ymax)].every((at) =>
      at.every((place, k) => place > EDGE_PX && place < [width, height][k] - EDGE_PX),
    );
  if (large && inside && !hidden(covers, sight, box)) return null;
  const near = Math.max(high, (wide * height) / Math.max(1, width), 0.5) / SHARE;
  const span = large ? height / scale : near;
  const middle = /** @type {Point} */ ([(xmin + xmax) / 2, (ymin + ymax) / 2]);
  const looks = roomsBeside(covers, size).map((part) => seenIn(part, size, middle, span / Math.max(1, height)));
  const clear = looks.find(
    ({ x, y }) => !hidden(covers, { x, y, pxPerMetre: height / span, ...size, stretch: null }, box),
  );
  return clear ?? looks[0];
}
