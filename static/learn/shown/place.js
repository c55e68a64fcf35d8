// @ts-check
// Where places of the plan are on a small canvas that shows a whole scan.

/** @typedef {[number, number]} Point */

const MARGIN = 12;

/** @param {{width: number, height: number}} size of the canvas [px] @param {number[]} xs @param {number[]} ys of all points [m] @returns {(at: Point) => Point} */
export function placeOn({ width, height }, xs, ys) {
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min(
    (width - 2 * MARGIN) / Math.max(right - left, 0.1),
    (height - 2 * MARGIN) / Math.max(high - low, 0.1),
  );
  return ([x, y]) => [width / 2 + scale * (x - (left + right) / 2), height / 2 - scale * (y - (low + high) / 2)];
}
