// @ts-check
// A drawn world and its text form, which is the id of the recording (lineseg/simulate/drawing.py).

export const DRAWN = "drawn:";
export const MOST_WALLS = 80;
export const MOST_CIRCLES = 40;
const SHORTEST = 0.05;
const DIGITS = 3;

/** @typedef {[number, number]} Point */
/** @typedef {"wall" | "circle" | "laser" | "beams"} Kind */
/** Something of a world; index among its kind. @typedef {{kind: Kind, index: number}} Thing */
/** @typedef {{wall: number[][], circle: number[][], laser: number[][], beams: number[][], seed: number}} World */

const COUNTS = { wall: 4, circle: 3, laser: 3, beams: 5 };
const LETTERS = /** @type {Record<string, Kind>} */ ({ w: "wall", c: "circle", l: "laser", b: "beams" });

/** @param {string} id @returns {World | null} null if it is not the id of a drawing */
export function worldOf(id) {
  if (!id.startsWith(DRAWN)) return null;
  /** @type {World} */
  const world = { wall: [], circle: [], laser: [], beams: [], seed: 0 };
  for (const part of id.slice(DRAWN.length).split(";").filter(Boolean)) {
    const numbers = part.slice(1).split(",").map(Number);
    const kind = LETTERS[part[0]];
    // The server says what is not allowed.
    if (kind && (numbers.length !== COUNTS[kind] || !numbers.every(Number.isFinite))) return null;
    if (kind) world[kind].push(numbers);
    else if (part[0] === "s") world.seed = numbers[0];
  }
  if (!world.laser.length) world.laser.push([0, 0, 0]);
  if (!world.beams.length) world.beams.push([-135, 135, 0.5, 30, 0.01]);
  return world;
}

/** @param {World} world */
export function idOf(world) {
  const part = (/** @type {string} */ letter, /** @type {number[]} */ numbers) =>
    letter + numbers.map((value) => Number(value.toFixed(DIGITS))).join(",");
  const parts = Object.entries(LETTERS).flatMap(([letter, kind]) =>
    world[kind].map((numbers) => part(letter, numbers)),
  );
  return `${DRAWN}${[...parts, `s${world.seed}`].join(";")}`;
}

/** The world with new numbers for a thing; unchanged if they are not allowed. @param {World} world @param {Thing} thing @param {number[]} numbers @returns {World} */
export function withNumbers(world, { kind, index }, numbers) {
  if (kind === "wall" && Math.hypot(numbers[2] - numbers[0], numbers[3] - numbers[1]) < SHORTEST) return world;
  if (kind === "circle" && numbers[2] < SHORTEST) return world;
  return { ...world, [kind]: world[kind].map((old, k) => (k === index ? numbers : old)) };
}

/** @param {World} world @param {Thing} thing @returns {World} */
export function without(world, { kind, index }) {
  return { ...world, [kind]: world[kind].filter((_, k) => k !== index) };
}

/** Position of a point of the world in the plan, which is the frame of the laser. @param {World} world @param {Point} point @returns {Point} */
export function inPlan(world, [x, y]) {
  const [x0, y0, heading] = world.laser[0];
  const [c, s] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  return [c * (x - x0) + s * (y - y0), -s * (x - x0) + c * (y - y0)];
}

/** @param {World} world @param {Point} point of the plan @returns {Point} */
export function inWorld(world, [u, v]) {
  const [x0, y0, heading] = world.laser[0];
  const [c, s] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  return [x0 + c * u - s * v, y0 + s * u + c * v];
}
