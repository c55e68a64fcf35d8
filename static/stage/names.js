// @ts-check
// Names and measures in the scene: words beside the places that they name, none over another.
import { h, svg } from "../widgets/dom.js";
import { symbols } from "../widgets/symbols.js";

/** @typedef {[number, number]} Point */
/** @typedef {{text: string, at: Point}} Name at: place of the scan [m] */
/** @typedef {{text: string, start: Point, end: Point, beside?: boolean}} Measure beside: drawn beside its places */
/** @typedef {{left: number, top: number, right: number, bottom: number}} Room */
/** @typedef {import("../wire.js").Framing} Framing */

const NEAR_PX = 14;
const FARTHER_PX = [0, 20, 42, 66, 92, 124, 160];
const ASIDE_PX = 16;
const EDGE_PX = 6;
const DOT_PX = 7;
// A pixel of a line below a name counts as much as this many square pixels of another name.
const LINE_COST = 10;
// Nor should the way from a name to its place cross that of another.
const CROSSING_COST = 200;
// Where a name is put: first to both sides of the line, by turns from there towards the line.
const TURNS = [0, 180, 35, -35, 145, -145, 70, -70, 110, -110].map((degrees) => (degrees * Math.PI) / 180);

/**
 * @param {HTMLElement} holder the stage
 * @param {{project: (x: number, y: number) => Point | null, onMove: (listener: () => void) => void}} view
 */
export function createNames(holder, view) {
  const marks = svg("svg", { class: "name-marks" });
  const words = h("div", { class: "names" });
  holder.append(marks, words);
  /** @type {Name[]} */
  let names = [];
  /** @type {Measure[]} */
  let measures = [];
  /** @type {HTMLElement[]} */
  let parts = [];
  /** Lines that names lie beside. @type {[Point, Point][]} */
  let lines = [];
  /** @type {Point[]} */
  let turns = [];
  view.onMove(place);

  function place() {
    marks.replaceChildren();
    if (!parts.length) return;
    const stage = { left: 0, top: 0, right: holder.clientWidth, bottom: holder.clientHeight };
    const places = [
      ...names.map(({ at }) => view.project(...at)),
      ...measures.map((measure) => middleOf(measure, marks, view)),
    ];
    /** @type {Room[]} */
    const taken = places.flatMap((at) => (at ? [roomAround(at, 2 * DOT_PX, 2 * DOT_PX)] : []));
    const drawn = lines.flatMap((ends) => {
      const [one, other] = ends.map((at) => view.project(...at));
      return one && other ? [/** @type {[Point, Point]} */ ([one, other])] : [];
    });
    taken.push(...drawn.flat().map((end) => roomAround(end, 2 * DOT_PX, 2 * DOT_PX)));
    taken.push(...[...holder.querySelectorAll(".stage-tools, .scale, .scene-key")].map((part) => roomOf(part, holder)));
    /** From each place to its name. @type {[Point, Point][]} */
    const ways = [];
    for (const [k, at] of places.entries()) {
      const part = parts[k];
      part.hidden = at === null;
      if (!at) continue;
      const inset = { left: EDGE_PX, top: EDGE_PX, right: stage.right - EDGE_PX, bottom: stage.bottom - EDGE_PX };
      const room = freeRoom(clamped(at, inset), part, inset, { taken, lines: drawn, ways, turns });
      taken.push(room);
      ways.push([at, middleOfRoom(room)]);
      part.style.transform = `translate(${room.left}px, ${room.top}px)`;
      marks.append(leader(at, room));
    }
  }

  return {
    /** Places them anew, since something else on the stage has moved. */
    place,
    /** @param {Framing | null} framing @param {[Point, Point][]} nextLines that names lie beside */
    set(framing, nextLines) {
      const [a, b] = framing?.normal ?? [0, 1];
      turns = TURNS.map((turn) => [
        a * Math.cos(turn) - b * Math.sin(turn),
        -(a * Math.sin(turn) + b * Math.cos(turn)),
      ]);
      names = framing?.names ?? [];
      measures = framing?.measures ?? [];
      lines = nextLines;
      parts = [...names, ...measures].map(({ text }) => h("span", { class: "scene-name" }, ...symbols(text)));
      words.replaceChildren(...parts);
      place();
    },
  };
}

/** Draws a measure; the place of its words. @param {Measure} measure @param {Element} marks @param {{project: (x: number, y: number) => Point | null}} view @returns {Point | null} */
function middleOf({ start, end, beside }, marks, view) {
  const [from, to] = [view.project(...start), view.project(...end)];
  if (!from || !to) return null;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const long = Math.hypot(dx, dy) || 1;
  const [nx, ny] = [(-dy / long) * ASIDE_PX, (dx / long) * ASIDE_PX];
  const [mx, my] = beside ? [nx, ny] : [0, 0];
  const [x1, y1, x2, y2] = [from[0] + mx, from[1] + my, to[0] + mx, to[1] + my];
  marks.append(svg("line", { class: "measure", x1, y1, x2, y2 }));
  for (const [x, y] of [
    [x1, y1],
    [x2, y2],
  ])
    marks.append(svg("line", { class: "measure", x1: x - nx / 4, y1: y - ny / 4, x2: x + nx / 4, y2: y + ny / 4 }));
  return [(x1 + x2) / 2, (y1 + y2) / 2];
}

/** The nearest free place for a name; if there is none, the one that covers least. @param {Point} at @param {HTMLElement} part @param {Room} inset @param {{taken: Room[], lines: [Point, Point][], ways: [Point, Point][], turns: Point[]}} around */
function freeRoom([x, y], part, inset, { taken, lines, ways, turns }) {
  const { offsetWidth: wide, offsetHeight: tall } = part;
  let best = { room: roomAround([x, y], wide, tall), cost: Infinity };
  for (const farther of FARTHER_PX) {
    for (const [dx, dy] of turns) {
      const far = NEAR_PX + farther;
      const room = roomAround([x + dx * (far + wide / 2), y + dy * (far + tall / 2)], wide, tall);
      const covered = lines.reduce((sum, line) => sum + within(line, room), 0);
      const crossed = ways.filter((way) => cross(way, [[x, y], middleOfRoom(room)])).length;
      const drawnOver = outside(room, inset) + LINE_COST * covered + CROSSING_COST * crossed;
      const cost = taken.reduce((sum, other) => sum + shared(room, other), drawnOver);
      if (cost < 1) return room;
      if (cost < best.cost) best = { room, cost };
    }
  }
  const { left, top } = best.room;
  return roomAround(
    [
      Math.min(Math.max(left, inset.left), inset.right - wide) + wide / 2,
      Math.min(Math.max(top, inset.top), inset.bottom - tall) + tall / 2,
    ],
    wide,
    tall,
  );
}

/** @param {Point} at @param {Room} room */
function leader(at, room) {
  const x2 = Math.min(Math.max(at[0], room.left), room.right);
  const y2 = Math.min(Math.max(at[1], room.top), room.bottom);
  return svg("line", { class: "leader", x1: at[0], y1: at[1], x2, y2 });
}

/** @param {Point} at @param {number} wide @param {number} tall @returns {Room} */
function roomAround([x, y], wide, tall) {
  return { left: x - wide / 2, top: y - tall / 2, right: x + wide / 2, bottom: y + tall / 2 };
}

/** @param {Room} room @returns {Point} */
function middleOfRoom({ left, top, right, bottom }) {
  return [(left + right) / 2, (top + bottom) / 2];
}

/** Whether two ways cross. @param {[Point, Point]} one @param {[Point, Point]} other */
function cross(one, other) {
  const side = (/** @type {[Point, Point]} */ [[x1, y1], [x2, y2]], /** @type {Point} */ [x, y]) =>
    Math.sign((x2 - x1) * (y - y1) - (y2 - y1) * (x - x1));
  return side(one, other[0]) * side(one, other[1]) < 0 && side(other, one[0]) * side(other, one[1]) < 0;
}

/** @param {Element} part @param {HTMLElement} holder @returns {Room} */
function roomOf(part, holder) {
  const [inner, outer] = [part.getBoundingClientRect(), holder.getBoundingClientRect()];
  return {
    left: inner.left - outer.left,
    top: inner.top - outer.top,
    right: inner.right - outer.left,
    bottom: inner.bottom - outer.top,
  };
}

/** @param {Room} one @param {Room} other */
function shared(one, other) {
  const wide = Math.min(one.right, other.right) - Math.max(one.left, other.left);
  const tall = Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top);
  return wide > 0 && tall > 0 ? wide * tall : 0;
}

/** How long a line is within a room. @param {[Point, Point]} line @param {Room} room */
function within([[x1, y1], [x2, y2]], { left, top, right, bottom }) {
  const [dx, dy] = [x2 - x1, y2 - y1];
  let [from, to] = [0, 1];
  for (const [step, low, high] of [
    [dx, left - x1, right - x1],
    [dy, top - y1, bottom - y1],
  ]) {
    if (step === 0 && (low > 0 || high < 0)) return 0;
    if (step === 0) continue;
    from = Math.max(from, Math.min(low / step, high / step));
    to = Math.min(to, Math.max(low / step, high / step));
  }
  return Math.max(0, to - from) * Math.hypot(dx, dy);
}

/** How much of a room lies outside of another. @param {Room} room @param {Room} inset */
function outside(room, inset) {
  return (room.right - room.left) * (room.bottom - room.top) - shared(room, inset);
}

/** @param {Point} at @param {Room} room @returns {Point} */
function clamped([x, y], { left, top, right, bottom }) {
  return [Math.min(Math.max(x, left), right), Math.min(Math.max(y, top), bottom)];
}
