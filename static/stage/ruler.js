// @ts-check
// A ruler: two clicks on points or lines give a distance, and of two lines their angle.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { fromPart, measured } from "./measure.js";
import { nearestBeam } from "./named.js";
import { createOverlay } from "./overlay.js";

/** @typedef {import("./measure.js").Anchor} Anchor */
/** @typedef {import("./measure.js").Point} Point */
/** @typedef {import("../wire.js").State} State */

// How near the pointer must be to an end of a line, a line, or a point.
const REACH_PX = 10;
// A press that moves farther drags the plan.
const CLICK_PX = 4;

/**
 * @param {HTMLElement} holder the stage
 * @param {import("./kinds.js").AnyStage} stage
 * @param {typeof import("../text/page.js").pageText.stage.ruler} text
 * @param {{sweep: () => import("../wire.js").Sweep | null, onHover: (at: Point | null) => void, plan: () => void}} handlers
 *   sweep: the points of the frame, if they are known; onHover: where on the stage the pointer is; plan: shows the plan
 */
export function createRuler(holder, stage, text, { sweep, onHover, plan }) {
  const surface = h("div", { class: "ruler-surface", hidden: true });
  holder.append(surface);
  const overlay = createOverlay(holder, { project: stage.project, onMove: (draw) => stage.onMove(draw) });
  const words = h("span", { class: "notice-words", role: "status" });
  const card = h("div", { class: "notice ruler", hidden: true }, h("div", { class: "notice-row" }, words));
  const button = iconButton("ruler", text.label, toggle);
  button.setAttribute("aria-pressed", "false");
  card.firstElementChild?.append(iconButton("close", text.close, toggle));
  /** @type {Anchor[]} */
  let anchors = [];
  /** @type {State | null} */
  let state = null;

  function toggle() {
    surface.hidden = card.hidden = !surface.hidden;
    button.setAttribute("aria-pressed", String(!surface.hidden));
    if (!surface.hidden) plan();
    anchors = [];
    show(null);
  }

  /** @param {Point} at @param {boolean} exact */
  const anchorAt = (at, exact) => anchorOf(stage, exact ? [] : (state?.segments ?? []), sweep(), at);

  /** @param {Anchor | null} hovered */
  function show(hovered) {
    const [one, other] = anchors.length === 1 && hovered ? [anchors[0], hovered] : anchors;
    const marked = [...anchors, ...(hovered && anchors.length < 2 ? [hovered] : [])];
    overlay.set("ruler-marks", {
      dots: marked.filter(({ line }) => !line).map(({ at }) => at),
      lines: marked.flatMap(({ ends }) => (ends ? [ends] : [])),
    });
    if (!other) {
      overlay.set("ruler", null);
      setText(words, anchors.length ? text.second : text.first);
      return;
    }
    const found = measured(one, other);
    const middle = /** @type {Point} */ ([(found.from[0] + found.to[0]) / 2, (found.from[1] + found.to[1]) / 2]);
    overlay.set("ruler", {
      thin: [[found.from, found.to]],
      labels: [{ at: middle, text: text.length(found.distance) }],
    });
    setText(words, text.said(found));
  }

  listen(surface, stage, {
    onHover(at, exact) {
      onHover(at);
      show(at && anchorAt(at, exact));
    },
    onPlace(at, exact) {
      const anchor = anchorAt(at, exact);
      if (!anchor) return;
      anchors = anchors.length < 2 ? [...anchors, anchor] : [anchor];
      show(null);
    },
  });

  return {
    button,
    card,
    toggle,
    get active() {
      return !surface.hidden;
    },
    /** @param {State} next */
    setState(next) {
      const moved = next.place !== state?.place || next.frame !== state.frame;
      state = next;
      if (moved && anchors.length) {
        anchors = [];
        show(null);
      }
    },
  };
}

/**
 * What lies at a place of the stage: an end of a line, a line, a point, or the place itself.
 * @param {import("./kinds.js").AnyStage} stage @param {State["segments"]} lines @param {import("../wire.js").Sweep | null} points
 * @param {Point} at @returns {Anchor | null}
 */
function anchorOf(stage, lines, points, at) {
  const here = stage.unproject(...at);
  if (!here) return null;
  const seen = (/** @type {Point} */ place) => /** @type {Point} */ (stage.project(...place) ?? [Infinity, Infinity]);
  const near = (/** @type {Point} */ place) => Math.hypot(seen(place)[0] - at[0], seen(place)[1] - at[1]);
  const end = lines.flatMap((line) => [line.start, line.end]).find((place) => near(place) < REACH_PX);
  if (end) return { at: end };
  const line = lines.find((each) => fromPart(at, [seen(each.start), seen(each.end)]) < REACH_PX);
  if (line) return { at: here, ends: [line.start, line.end], line: line.line };
  const beam = points && nearestBeam(points, at, stage.project, REACH_PX);
  return { at: (beam !== null && points?.points[beam]) || here };
}

/**
 * The pointer over the surface of the ruler: a press that moves drags the plan, and another names a place.
 * @param {HTMLElement} surface
 * @param {import("./kinds.js").AnyStage} stage
 * @param {{onHover: (at: Point | null, exact: boolean) => void, onPlace: (at: Point, exact: boolean) => void}} handlers
 *   exact: Shift is held, which passes over lines
 */
function listen(surface, stage, { onHover, onPlace }) {
  /** Where the pointer was pressed and where it is now. @type {{start: Point, last: Point} | null} */
  let pressed = null;
  const placeOf = (/** @type {PointerEvent} */ { offsetX, offsetY }) => /** @type {Point} */ ([offsetX, offsetY]);
  surface.addEventListener("pointerdown", (event) => {
    surface.setPointerCapture(event.pointerId);
    pressed = { start: placeOf(event), last: placeOf(event) };
  });
  surface.addEventListener("pointermove", (event) => {
    const at = placeOf(event);
    if (!pressed) return onHover(at, event.shiftKey);
    const [was, is] = [stage.unproject(...pressed.last), stage.unproject(...at)];
    if (was && is) stage.pan(was[0] - is[0], was[1] - is[1]);
    pressed.last = at;
    return undefined;
  });
  surface.addEventListener("pointerup", (event) => {
    const at = placeOf(event);
    const still = pressed && Math.hypot(at[0] - pressed.start[0], at[1] - pressed.start[1]) <= CLICK_PX;
    pressed = null;
    if (still) onPlace(at, event.shiftKey);
  });
  surface.addEventListener("pointercancel", () => (pressed = null));
  surface.addEventListener("pointerleave", () => onHover(null, false));
  surface.addEventListener("wheel", (event) => (event.preventDefault(), stage.pass(event)), { passive: false });
}
