// @ts-check
// The scene: viser's page in a frame of the same origin. Its camera is set here; picking is the server's.
import { h } from "../widgets/dom.js";
import { closePopovers } from "../widgets/menu.js";
import { onLongPress } from "./long_press.js";
import { paceFrames } from "./pace.js";
import { PlanStage } from "./plan_stage.js";
import {
  bend,
  cameraIn,
  clip,
  hasContent,
  lockPlan,
  NEAREST,
  onScreen,
  PLAN_FOV_DEG,
  planOf,
  rad,
  unlock,
} from "./viser.js";

/** @typedef {import("../wire.js").Box} Box */
/** @typedef {import("./viser.js").Plan} Plan */
/** @typedef {import("./viser.js").Stretch} Stretch */
/** @typedef {import("../view/store.js").Look} Look */
/**
 * onKey: a key pressed in the scene, true if the page took it; onFrame: a scene was loaded
 * @typedef {{onKey: (event: KeyboardEvent) => boolean, onFrame: (frame: Window) => void, onPick: (at: [number, number], radius: number, beside: boolean) => void}} Handlers
 */

// How near to a point a finger must rest.
const FINGER_PX = 30;
const CAMERA_KEYS = new Set(["KeyW", "KeyA", "KeyS", "KeyD", "KeyQ", "KeyE"]);
// viser's own panel and notices go, because the page shows connection and values; its slow fade-in goes, too; the grid
// below it is seen through it.
const OVERRULED = `
  [data-floating-window], .mantine-Paper-root:has(.mantine-ScrollArea-root), .mantine-Notifications-root { display: none !important; }
  canvas { opacity: 1 !important; }
  :root { color-scheme: light !important; }
  body, body div { background-color: transparent !important; }
`;
const TAN = Math.tan(rad(PLAN_FOV_DEG / 2));
// What a link says about viser's first camera holds against the server's, which may arrive at any time. This one does not
// look from straight above, so wherever viser puts it, nobody takes it for a plan that a person has moved.
const FIRST_CAMERA = "?initialCameraPosition=3,3,3&initialCameraLookAt=0,0,0&initialCameraUp=0,0,1&initialCameraFov=1";

export class Stage extends PlanStage {
  hasFree = true;
  frame;
  /** @type {"plan" | "free"} */
  #mode = "plan";
  /** What the plan shows. @type {Plan | null} */
  #plan = null;
  /** The plan after a fit. @type {Plan | null} */
  #whole = null;
  /** A fit to repeat once the camera exists. @type {(() => void) | null} */
  #pendingFit = null;
  /** @type {any} */
  #locked = null;
  #source = "";
  #handlers;
  /** @param {HTMLElement} holder @param {typeof import("../text/page.js").pageText.stage} text @param {Handlers} handlers */
  constructor(holder, text, handlers) {
    const frame = h("iframe", { class: "scene", title: text.scene, allow: "" });
    super(holder, frame, text.across);
    this.frame = frame;
    this.#handlers = handlers;
    frame.addEventListener("load", () => this.#loaded());
    new ResizeObserver(() => this.#resized()).observe(frame);
  }

  #loaded() {
    const inner = this.frame.contentWindow;
    if (!inner || !this.#source) return;
    paceFrames(inner);
    const sheet = new /** @type {any} */ (inner).CSSStyleSheet();
    sheet.replaceSync(OVERRULED);
    inner.document.adoptedStyleSheets = [...inner.document.adoptedStyleSheets, sheet];
    inner.addEventListener("keydown", (event) => this.#keyInScene(event), true);
    inner.addEventListener("pointerdown", () => closePopovers(), true);
    inner.addEventListener(
      "pointermove",
      (event) => this.hover(event.buttons ? null : [event.clientX, event.clientY]),
      true,
    );
    inner.document.documentElement.addEventListener("pointerleave", () => this.hover(null));
    onLongPress(inner, (left, top) => this.#held(left, top));
    this.#handlers.onFrame(inner);
    this.#locked = null;
    this.#settle();
  }

  /** A finger rests: asks why. @param {number} left @param {number} top [px] */
  #held(left, top) {
    const [at, sight] = [this.unproject(left, top), this.sight];
    if (at && sight) this.#handlers.onPick(at, FINGER_PX / sight.pxPerMetre, false);
  }

  #resized() {
    this.refit();
    this.tellMoved();
  }

  /** @param {KeyboardEvent} event */
  #keyInScene(event) {
    const taken = this.#handlers.onKey(event);
    const moves = CAMERA_KEYS.has(event.code) && (this.#mode === "plan" || event.ctrlKey || event.metaKey);
    if (!taken && !moves && !event.key.startsWith("Arrow")) return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  /** Locks the camera as soon as it exists. */
  #settle() {
    const found = cameraIn(this.frame);
    if (!found) {
      if (this.#source) requestAnimationFrame(() => this.#settle());
      return;
    }
    if (this.#locked !== found.control) {
      this.#locked = found.control;
      this.#locked.addEventListener("update", () => this.#moved());
    }
    if (this.#pendingFit) this.#pendingFit();
    else this.#applyPlan();
  }

  #moved() {
    const found = cameraIn(this.frame);
    if (!found) return;
    if (this.#mode === "plan") {
      const now = planOf(found);
      if (!now) return this.#applyPlan();
      this.#plan = now;
      clip(found, now.height);
      bend(found, this.stretch, now.height);
    }
    this.tellMoved();
    return undefined;
  }

  #applyPlan() {
    const found = cameraIn(this.frame);
    if (!found || !this.#plan) return;
    if (this.#mode === "plan") {
      bend(found, this.stretch, this.#plan.height);
      lockPlan(found, this.#plan);
    }
    this.#show();
  }

  #unlock() {
    const found = cameraIn(this.frame);
    if (!found) return;
    bend(found, null, null);
    unlock(found, this.#plan ?? { x: 0, y: 0, height: 100 });
    this.#show();
  }

  #apply() {
    if (this.#mode === "plan") this.#applyPlan();
    else this.#unlock();
  }

  /** Shows the scene as soon as there is something in it. */
  #show() {
    if (hasContent(this.frame)) this.frame.classList.add("ready");
    else requestAnimationFrame(() => this.#show());
    this.tellMoved();
  }

  /** The plan as it is seen; null before it is loaded and in the free view. */
  get sight() {
    const plan = this.#plan;
    if (this.#mode !== "plan" || !plan) return null;
    const { width, height } = this.size;
    return {
      x: plan.x,
      y: plan.y,
      pxPerMetre: height / (2 * plan.height * TAN),
      width,
      height,
      stretch: this.stretch,
    };
  }

  /** @param {string} path of the session's viser page */
  open(path) {
    if (path === this.#source) return;
    this.#source = path;
    this.frame.classList.remove("ready");
    this.frame.src = path + FIRST_CAMERA;
  }

  /** @type {PlanStage["showBox"]} */
  showBox(box, stretch, room) {
    super.showBox(box, stretch, room);
    const { x, y, span } = this.around(box, room);
    this.#plan = this.#whole = { x, y, height: Math.max(span / 2 / TAN, NEAREST) };
    this.#pendingFit = cameraIn(this.frame) ? null : () => this.showBox(box, stretch, room);
    this.#apply();
  }

  /** The visible part of the plan, if a person has moved it. @returns {Look | null} */
  get look() {
    const [plan, whole] = [this.#plan, this.#whole];
    if (!plan || !whole || this.#pendingFit) return null;
    const lifted = Math.abs(plan.height - whole.height) / 10;
    const moved = Math.max(Math.abs(plan.x - whole.x), Math.abs(plan.y - whole.y), lifted);
    return moved > 1e-3 * whole.height ? { x: plan.x, y: plan.y, span: 2 * plan.height * TAN } : null;
  }

  /** @param {Look} look */
  lookAt({ x, y, span }) {
    this.#plan = { x, y, height: Math.max(NEAREST, span / 2 / TAN) };
    this.#pendingFit = null;
    this.#apply();
  }

  /** @returns {[number, number] | null} */
  get middle() {
    return this.#plan && [this.#plan.x, this.#plan.y];
  }

  /** Position of a point of the laser on the stage [px], in any view; null if it cannot be seen. @param {number} x @param {number} y @returns {[number, number] | null} */
  seen = (x, y) => {
    if (this.#mode === "plan") return this.project(x, y);
    const found = cameraIn(this.frame);
    const there = this.placed([x, y]);
    const at = found && there && onScreen(found, [...there, 0]);
    return at && [at[0] * this.frame.clientWidth, at[1] * this.frame.clientHeight];
  };

  /** Passes to the scene a wheel event that an element over it received. @param {WheelEvent} event */
  pass = (event) => {
    this.frame.contentDocument?.querySelector("canvas")?.dispatchEvent(new WheelEvent("wheel", event));
  };

  /** Moves the plan. @param {number} dx @param {number} dy [m] */
  pan(dx, dy) {
    if (this.#mode !== "plan" || !this.#plan) return;
    this.#plan = { ...this.#plan, x: this.#plan.x + dx, y: this.#plan.y + dy };
    this.#applyPlan();
  }

  /** @param {"plan" | "free"} next */
  setMode(next) {
    if (next === this.#mode) return;
    this.#mode = next;
    this.#apply();
    this.#resized();
  }
}
