// @ts-check
// What the marks of a decision mean. On a low stage only its title is there until it is opened.
import { h } from "../widgets/dom.js";

/** @typedef {typeof import("../text/page.js").pageText.stage.key} Text */

const TALL_PX = 420;

const ROOM_PX = 12;
// As in stage.css.
const BELOW_TOOLS_PX = 60;
// So far beside the line its band and its names still are.
const BESIDE_PX = 30;
// A place with a name counts as much as this many places of the line.
const NAMED = 4;

/**
 * It lies in the corner of the stage where it covers least: the lower right one, the upper left one, or below the tools.
 * @param {HTMLElement} holder the stage @param {Text} text
 * @param {{project: (x: number, y: number) => [number, number] | null, onMove: (listener: () => void) => void}} view
 * @param {() => void} onPlaced it may now lie elsewhere; after a move of the view it is placed without this
 */
export function createKey(holder, text, view, onPlaced) {
  const list = h("ul");
  const element = h("details", { class: "scene-key", hidden: true }, h("summary", {}, text.label), list);
  // Whoever opens or closes it decides for the rest.
  let chosen = false;
  element.firstElementChild?.addEventListener("click", () => (chosen = true));
  /** @type {import("../wire.js").Framing | null} */
  let shown = null;
  view.onMove(place);
  element.addEventListener("toggle", () => {
    place();
    onPlaced();
  });

  function place() {
    if (!shown || element.hidden) return;
    const { clientWidth: right, clientHeight: bottom } = holder;
    const spots = spotsOf(shown).flatMap(([x, y]) => [view.project(x, y) ?? []]);
    const [wide, tall] = [element.offsetWidth + ROOM_PX, element.offsetHeight + ROOM_PX];
    const covered = (/** @type {boolean} */ aside, /** @type {number} */ from) => {
      const [left, top] = [aside ? right - wide : 0, from];
      return spots.filter(
        ([x, y]) =>
          (aside ? x > left - BESIDE_PX : x < wide + BESIDE_PX) && y > top - BESIDE_PX && y < top + tall + BESIDE_PX,
      ).length;
    };
    const corners = /** @type {const} */ ([
      ["low", covered(true, bottom - tall)],
      ["upper-left", covered(false, 0)],
      ["below-tools", covered(true, BELOW_TOOLS_PX)],
    ]);
    const [best] = corners.reduce((one, other) => (other[1] < one[1] ? other : one));
    for (const [name] of corners) element.classList.toggle(name, name === best);
  }

  return {
    element,
    /** @param {import("../wire.js").State} state */
    setState({ framing, nodes }) {
      const marks = framing ? Object.keys(text.marks).filter((name) => nodes.includes(name)) : [];
      element.hidden = !marks.length;
      shown = framing ?? null;
      if (element.hidden) return;
      if (!chosen) element.open = holder.clientHeight >= TALL_PX;
      list.replaceChildren(
        ...marks.map((name) =>
          h("li", {}, h("i", { class: `mark mark-${name}`, "aria-hidden": "true" }), text.marks[name]),
        ),
      );
      place();
      onPlaced();
    },
  };
}

/** Places that a step speaks of, and its line. @param {import("../wire.js").Framing} framing @returns {[number, number][]} */
function spotsOf({ box: [x1, y1, x2, y2], normal: [a, b], at: [x, y], names, measures }) {
  const long = Math.hypot(x2 - x1, y2 - y1) / 2;
  const line = Array.from({ length: 41 }, (_, k) => long * (k / 20 - 1));
  return [
    ...Array(NAMED)
      .fill([...names.map(({ at }) => at), ...measures.flatMap(({ start, end }) => [start, end])])
      .flat(),
    ...line.map((along) => /** @type {[number, number]} */ ([x - b * along, y + a * along])),
  ];
}
