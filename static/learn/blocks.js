// @ts-check
// The blocks of the method (Fig. 3): the lesson that introduces each, and a small picture of what it does.
import { svg } from "../widgets/dom.js";

/** @typedef {NonNullable<import("../wire.js").Lesson["block"]>} Block */
/** @typedef {import("./trace.js").Event} Event */

/** @type {readonly {name: Block, lesson: string}[]} */
export const BLOCKS = [
  { name: "fit", lesson: "13_least_squares" },
  { name: "seed", lesson: "01_seed" },
  { name: "growth", lesson: "03_growth" },
  { name: "enough", lesson: "08_how_much" },
  { name: "overlap", lesson: "05_corner" },
  { name: "endpoints", lesson: "06_endpoints" },
  { name: "segments", lesson: "16_correctness" },
];

/** After each of these lines, the next seed is sought. @type {readonly Block[]} */
export const REPEATED = ["seed", "growth", "enough"];

const OF_LINES = new Set(["line kept", "line dropped"]);

/** The algorithm that each block belongs to; the first one is where the method begins. @type {Partial<Record<Block, string>>} */
const ALGORITHMS = { growth: "growth", enough: "growth", overlap: "overlap", endpoints: "endpoints" };

/** The algorithm that a lesson about a block is about. @param {Block | null | undefined} block */
export function algorithmOf(block) {
  return (block && ALGORITHMS[block]) ?? "seed";
}

/** The block of a decision; of the whole result, the last one. @param {Event | null} event @returns {Block} */
export function blockOf(event) {
  if (!event) return "segments";
  if (event.phase === "growth" && OF_LINES.has(event.kind)) return "enough";
  return /** @type {Block} */ (event.phase);
}

/** line: what is found; thin: what it is measured by; dots: points. @type {Record<Block, {line?: string, thin?: string, dots?: [number, number][]}>} */
const PICTURES = {
  fit: {
    line: "M3 25 41 7",
    thin: "M9 19l1.5 3M18 20l-1.5-1.500M25 10l2 3.800M34 14l-2-3",
    dots: [
      [9, 18.5],
      [18.3, 21.4],
      [25, 10],
      [34, 14.2],
    ],
  },
  seed: {
    thin: "M14 8.5 31 3.5 34 17 17 22z",
    line: "M16 15.5 33 10",
    dots: [
      [4, 26],
      [10, 24],
      [18, 14.5],
      [24.5, 13],
      [31, 10.5],
      [40, 14],
    ],
  },
  growth: {
    line: "M13 20 31 13",
    thin: "M10 21.2 3 24M6.2 20.8 3 24 7.4 24.700M34 11.8 41 9M36.6 8.4 41 9 37.9 12.2",
    dots: [
      [13, 20],
      [19, 17.8],
      [25, 15.2],
      [31, 13],
    ],
  },
  enough: {
    line: "M4 20 26 8",
    thin: "M31 21l2.7-1.500M36 18.3 38.7 16.8",
    dots: [
      [4, 20],
      [11.5, 16],
      [18.5, 12],
      [26, 8],
      [30, 22],
      [40, 16],
    ],
  },
  overlap: {
    line: "M3 10 27 14M19 24 41 5",
    thin: "M23.5 8v18",
    dots: [
      [27, 14],
      [19, 24],
      [31, 13.6],
      [16, 12],
    ],
  },
  endpoints: {
    line: "M8 21 36 11M6.7 17.4 9.3 24.600M34.7 7.4 37.3 14.6",
    thin: "M36 11 38.4 17.7",
    dots: [[38.6, 18.3]],
  },
  segments: { line: "M5 25V5H26M31 5h8V25M13 25H28", dots: [] },
  methods: {
    line: "M4 22 16 7 40 20",
    thin: "M4 22 40 20M16 7 16.7 21.3",
    dots: [
      [4, 22],
      [16, 7],
      [40, 20],
    ],
  },
};

/** @param {Block} name */
export function pictureOf(name) {
  const { line, thin, dots = [] } = PICTURES[name];
  const element = svg("svg", { viewBox: "0 0 44 30", class: "block-picture", "aria-hidden": "true" });
  if (thin) element.append(svg("path", { d: thin, class: "thin" }));
  if (line) element.append(svg("path", { d: line }));
  element.append(...dots.map(([cx, cy]) => svg("circle", { cx, cy, r: 1.7 })));
  return element;
}
