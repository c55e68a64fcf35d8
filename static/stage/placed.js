// @ts-check
// Where the laser stands in the world, and so where its points are on the plan.

/** @typedef {[number, number]} Point */
/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("../wire.js").World} World */

/** A point of the laser in the world. @param {World | null} world null: the plan is that of the laser @param {Point} at @returns {Point | null} null if the place of the laser is not known */
export function placed(world, [x, y]) {
  if (!world) return [x, y];
  if (!world.pose) return null;
  const [left, low, heading] = world.pose;
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  const up = world.upsideDown ? -y : y;
  return [left + cos * x - sin * up, low + sin * x + cos * up];
}

/** The inverse of `placed`. @param {World | null} world @param {Point} at @returns {Point | null} */
export function seenFrom(world, at) {
  if (!world) return at;
  if (!world.pose) return null;
  const [dx, dy] = [at[0] - world.pose[0], at[1] - world.pose[1]];
  const [cos, sin] = [Math.cos(world.pose[2]), Math.sin(world.pose[2])];
  const up = cos * dy - sin * dx;
  return [cos * dx + sin * dy, world.upsideDown ? -up : up];
}

/** The box around a box of the laser in the world. @param {World | null} world @param {Box} box @returns {Box | null} */
export function placedBox(world, [x1, y1, x2, y2]) {
  /** @type {Point[]} */
  const corners = [
    [x1, y1],
    [x2, y1],
    [x2, y2],
    [x1, y2],
  ];
  const found = corners.flatMap((at) => {
    const there = placed(world, at);
    return there ? [there] : [];
  });
  if (!found.length) return null;
  const [xs, ys] = [found.map(([x]) => x), found.map(([, y]) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}
