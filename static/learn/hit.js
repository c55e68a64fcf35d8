// @ts-check
// Finds the term of the formulas that belongs to a place in the scene.
import { fromPart } from "../stage/measure.js";
import { shapeOf } from "./shapes.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {(x: number, y: number) => Point | null} Project */

const REACH_PX = 10;
// Points lie on lines, so a point takes precedence.
const DOT_AHEAD_PX = 5;

/**
 * @param {Point} at place on the stage [px]
 * @param {string[]} names terms of the current formulas @param {Event} event @param {Trace} trace @param {Project} project
 * @returns {string | null} the term whose geometry is nearest; of two that share it, the one that is less beside it
 */
export function termAt(at, names, event, trace, project) {
  const near = names.flatMap((name) => {
    const shape = shapeOf(name, event, trace);
    const far = shape ? distance(at, shape, project) : Infinity;
    const parts = (shape?.dots?.length ?? 0) + (shape?.lines?.length ?? 0);
    return far < REACH_PX ? [{ name, far, parts }] : [];
  });
  near.sort((one, other) => one.far - other.far || one.parts - other.parts);
  return near[0]?.name ?? null;
}

/** @param {Point} at @param {import("./shapes.js").Shape} shape @param {Project} project */
function distance(at, { dots = [], lines = [] }, project) {
  const toDots = dots.map((dot) => toSegment(at, project(...dot), project(...dot)) - DOT_AHEAD_PX);
  const toLines = lines.map(([from, to]) => toSegment(at, project(...from), project(...to)));
  return Math.min(...toDots, ...toLines);
}

/** @param {Point} at @param {Point | null} from @param {Point | null} to */
function toSegment(at, from, to) {
  return from && to ? fromPart(at, [from, to]) : Infinity;
}
