// @ts-check
// The handles of a world, and what dragging each of them does.

/** @typedef {import("./world.js").World} World */
/** @typedef {import("./world.js").Thing} Thing */
/** @typedef {import("./world.js").Point} Point */
/** @typedef {typeof import("../text/draw.js").drawText.handle} Text */
/** How a handle changes the numbers of its thing when it moves. @typedef {{thing: Thing, label: string, at: Point, moved: (by: Point) => number[]}} Handle */

/** @param {World} world @param {Text} text @returns {Handle[]} */
export function handlesOf({ wall, circle, laser }, text) {
  return [
    ...wall.flatMap((numbers, index) => handlesOfWall(numbers, index, text)),
    ...circle.flatMap((numbers, index) => handlesOfCircle(numbers, index, text)),
    handleOfLaser(laser[0], text),
  ];
}

/** @param {number[]} wall @param {number} index @param {Text} text @returns {Handle[]} */
function handlesOfWall([x1, y1, x2, y2], index, text) {
  const thing = /** @type {Thing} */ ({ kind: "wall", index });
  return [
    { thing, label: text.wallStart(index + 1), at: [x1, y1], moved: ([dx, dy]) => [x1 + dx, y1 + dy, x2, y2] },
    { thing, label: text.wallEnd(index + 1), at: [x2, y2], moved: ([dx, dy]) => [x1, y1, x2 + dx, y2 + dy] },
    {
      thing,
      label: text.wall(index + 1),
      at: [(x1 + x2) / 2, (y1 + y2) / 2],
      moved: ([dx, dy]) => [x1 + dx, y1 + dy, x2 + dx, y2 + dy],
    },
  ];
}

/** @param {number[]} circle @param {number} index @param {Text} text @returns {Handle[]} */
function handlesOfCircle([x, y, radius], index, text) {
  const thing = /** @type {Thing} */ ({ kind: "circle", index });
  return [
    { thing, label: text.circle(index + 1), at: [x, y], moved: ([dx, dy]) => [x + dx, y + dy, radius] },
    {
      thing,
      label: text.radius(index + 1),
      at: [x + radius, y],
      moved: ([dx, dy]) => [x, y, Math.hypot(radius + dx, dy)],
    },
  ];
}

/** @param {number[]} laser @param {Text} text @returns {Handle} */
function handleOfLaser([x, y, heading], text) {
  return {
    thing: { kind: "laser", index: 0 },
    label: text.laser,
    at: [x, y],
    moved: ([dx, dy]) => [x + dx, y + dy, heading],
  };
}
