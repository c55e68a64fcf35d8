// @ts-check

/** @typedef {[number, number, number, number]} Stroke x1, y1, x2, y2 in cells */

/**
 * Lines of one height over a grid of heights (marching squares); cells with an unknown corner have none.
 * @param {(number | null)[][]} heights rows of equal length
 * @param {number} level
 * @returns {Stroke[]}
 */
export function contour(heights, level) {
  /** @type {Stroke[]} */
  const strokes = [];
  for (let j = 0; j + 1 < heights.length; j++) {
    for (let i = 0; i + 1 < heights[j].length; i++) {
      const corners = [heights[j][i], heights[j][i + 1], heights[j + 1][i + 1], heights[j + 1][i]];
      if (corners.some((corner) => corner === null)) continue;
      const cuts = crossings(/** @type {number[]} */ (corners), level).map(([x, y]) => [i + x, j + y]);
      for (let k = 0; k + 1 < cuts.length; k += 2)
        strokes.push([cuts[k][0], cuts[k][1], cuts[k + 1][0], cuts[k + 1][1]]);
    }
  }
  return strokes;
}

/** Where the level crosses the sides of a cell, anticlockwise from its lower side. @param {number[]} corners @param {number} level */
function crossings(corners, level) {
  const places = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];
  /** @type {number[][]} */
  const found = [];
  for (let k = 0; k < 4; k++) {
    const [one, other] = [corners[k], corners[(k + 1) % 4]];
    if (one < level === other < level) continue;
    const share = (level - one) / (other - one);
    const [from, to] = [places[k], places[(k + 1) % 4]];
    found.push([from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]);
  }
  return found;
}
