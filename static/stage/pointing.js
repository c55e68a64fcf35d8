// @ts-check
// Lights in the scene what a sentence names, and goes there.
import { createOverlay } from "./overlay.js";
import { beamsOf, boxAround, nearestBeam, shapeOfFinding, shapeOfNamed } from "./named.js";
import { FrameSweep } from "./sweep.js";

/** @typedef {import("../wire.js").Link} Link */
/** @typedef {import("../wire.js").Finding} Finding */
/** @typedef {import("../wire.js").State} State */

const REST_MS = 150;
const REACH_PX = 14;

/**
 * @param {import("../page.js").Page} page
 * @param {HTMLElement} holder
 * @param {import("./kinds.js").AnyStage} stage
 * @param {{onLight: (threshold: string | null) => void, onThreshold: (name: string) => void, label: (beam: number) => string,
 *          onPlace: (at: [number, number] | null, sweep: import("../wire.js").Sweep | null) => void}} handlers
 *   onLight: the threshold that is pointed at; onThreshold: one was chosen; label: of the beam at the pointer; onPlace: where in the plan the pointer is
 */
export function createPointing(page, holder, stage, handlers) {
  return new Pointing(page, holder, stage, handlers);
}

class Pointing {
  #page;
  #stage;
  #handlers;
  #overlay;
  #sweep = new FrameSweep(() => this.#come());
  /** @type {State | null} */ #state = null;
  /** What the sentences were about. */ #key = "";
  /** Pointed at. @type {Link | null} */ #lit = null;
  /** Chosen. @type {Link | null} */ #kept = null;
  /** Chosen, and its points are still on their way. @type {Link | null} */ #awaited = null;
  /** @type {Finding | null} */ #finding = null;
  /** Where the pointer is on the stage. @type {[number, number] | null} */ #pointer = null;
  /** Whether the pointer labels the nearest point. */ #labels = true;
  #resting = 0;

  /** @param {import("../page.js").Page} page @param {HTMLElement} holder @param {import("./kinds.js").AnyStage} stage @param {Parameters<typeof createPointing>[3]} handlers */
  constructor(page, holder, stage, handlers) {
    this.#page = page;
    this.#stage = stage;
    this.#handlers = handlers;
    this.#overlay = createOverlay(holder, { project: stage.seen, onMove: (draw) => stage.onMove(draw) });
    stage.onHover((at) => this.hover(at));
  }

  /** A word is pointed at; null: no longer. @param {Link | null} named */
  at = (named) => {
    this.#lit = named;
    this.#need();
    this.#draw();
    this.#handlers.onLight(named?.threshold ?? null);
  };

  /** A word was chosen: what it names stays lit, and the camera goes there. @param {Link} named */
  go = (named) => {
    if (named.threshold) return this.#handlers.onThreshold(named.threshold);
    this.#kept = this.#awaited = named;
    this.#need();
    return this.#come();
  };

  /** Draws what a finding speaks of, and goes there; null: nothing. @param {Finding | null} finding */
  show(finding) {
    this.#finding = finding;
    this.#need();
    this.#draw();
    if (finding) this.#show(shapeOfFinding(finding, this.#sweep.now));
  }

  get #numbered() {
    return this.#state?.layers.numbers ?? false;
  }

  /** Requests the points of the frame if they are needed. The frames of a robot come and go too fast. */
  #need() {
    const wanted = this.#numbered || this.#lit || this.#kept || this.#finding || this.#pointer;
    if (this.#state && wanted && this.#state.live === null) this.#sweep.need(this.#state);
  }

  #come() {
    if (this.#awaited && this.#state) {
      const shape = shapeOfNamed(this.#awaited, this.#state, this.#sweep.now);
      if (shape) this.#show(shape);
      if (shape) this.#awaited = null;
    }
    this.#draw();
  }

  /** @param {import("./overlay.js").Shape | null} shape */
  #show(shape) {
    const box = shape && boxAround(shape);
    if (!box) return;
    if (this.#page.view.camera !== "plan") this.#page.change({ camera: "plan" });
    this.#stage.goTo(box);
  }

  #draw() {
    const state = this.#state;
    if (!state) return;
    const sweep = this.#sweep.now;
    const shapeOf = (/** @type {Link | null} */ named) => named && shapeOfNamed(named, state, sweep);
    this.#overlay.set("finding", this.#finding && shapeOfFinding(this.#finding, sweep));
    this.#overlay.set("kept", shapeOf(this.#kept));
    this.#overlay.set("lit", shapeOf(this.#lit));
    this.#overlay.set("numbers", this.#numbered && sweep ? { labels: beamsOf(sweep) } : null);
    this.#drawPointer();
  }

  /** The points of the frame, if they are known. */
  get sweep() {
    return this.#sweep.now;
  }

  /** @param {[number, number] | null} at where the pointer is on the stage [px] @param {boolean} [labels] whether it labels the nearest point */
  hover = (at, labels = true) => {
    this.#labels = labels;
    this.#pointer = at;
    clearTimeout(this.#resting);
    if (at && !this.#sweep.now) this.#resting = setTimeout(() => this.#need(), REST_MS);
    this.#drawPointer();
  };

  #drawPointer() {
    const sweep = this.#sweep.now;
    this.#handlers.onPlace(this.#pointer && this.#stage.unproject(...this.#pointer), sweep);
    const beam =
      this.#labels && this.#pointer && sweep ? nearestBeam(sweep, this.#pointer, this.#stage.seen, REACH_PX) : null;
    const at = beam === null ? null : sweep?.points[beam];
    this.#overlay.set("pointer", at ? { labels: [{ at, text: this.#handlers.label(Number(beam)) }] } : null);
  }

  /** @param {State} state */
  setState(state) {
    const { place, frame, method, params, step, selected } = state;
    const key = JSON.stringify([place, frame, method, params, step, selected]);
    const moved = state.place !== this.#state?.place || frame !== this.#state.frame;
    this.#state = state;
    if (moved) this.#sweep.drop();
    if (key !== this.#key) this.#kept = this.#awaited = null;
    this.#key = key;
    this.#need();
    this.#draw();
  }
}
