// @ts-check
// The scene: viser's page in a frame of the same origin. Its camera is set here; picking is the server's.
import { h, setText } from "../widgets/dom.js";
import { closePopovers } from "../widgets/menu.js";

/** @typedef {import("../wire.js").Box} Box */

const PLAN_FOV_DEG = 10;
const FREE_FOV_DEG = 45;
const MARGIN = 1.12;
const BAR_PX = 110;
/** Of the camera to the plan [m]. */
const NEAREST = 0.5;
const WHEEL_SPEED = 1;
// camera-controls' actions
const ACTION = { ROTATE: 1, TRUCK: 2, DOLLY: 16, TOUCH_ROTATE: 64, TOUCH_TRUCK: 128, TOUCH_DOLLY_TRUCK: 4096 };
const CAMERA_KEYS = new Set(["KeyW", "KeyA", "KeyS", "KeyD", "KeyQ", "KeyE"]);
// viser's own panel and notices go, because connection and values are the page's to show; and so does its slow fade-in.
const OVERRULED = `
  [data-floating-window], .mantine-Paper-root:has(.mantine-ScrollArea-root), .mantine-Notifications-root { display: none !important; }
  canvas { opacity: 1 !important; }
`;

/**
 * @param {HTMLElement} stage
 * @param {typeof import("../text/page.js").pageText.stage} text
 * @param {{onKey: (event: KeyboardEvent) => boolean, onFrame: (frame: Window) => void}} handlers
 *   onKey: a key pressed in the scene, true if the page took it; onFrame: a scene was loaded
 */
export function mountStage(stage, text, { onKey, onFrame }) {
  const frame = h("iframe", { class: "scene", title: text.scene, allow: "" });
  const barWords = h("span");
  const bar = h("div", { class: "scale-bar", "aria-hidden": "true", hidden: true }, barWords);
  stage.append(frame, bar);

  /** @type {"plan" | "free"} */
  let mode = "plan";
  /** What the plan shows. @type {{x: number, y: number, height: number} | null} */
  let plan = null;
  /** What it shows after a fit. @type {{x: number, y: number, height: number} | null} */
  let whole = null;
  /** @type {Box | null} */
  let pendingFit = null;
  /** @type {any} */
  let locked = null;
  let source = "";
  /** Whether a person may have moved the camera. */
  let touched = false;
  /** @type {(() => void)[]} */
  const moveListeners = [];
  /** @type {((at: [number, number] | null) => void)[]} */
  const hoverListeners = [];

  frame.addEventListener("load", () => {
    const inner = frame.contentWindow;
    if (!inner || !source) return;
    const sheet = new /** @type {any} */ (inner).CSSStyleSheet();
    sheet.replaceSync(OVERRULED);
    inner.document.adoptedStyleSheets = [...inner.document.adoptedStyleSheets, sheet];
    inner.addEventListener("keydown", keyInScene, true);
    inner.addEventListener("pointerdown", () => closePopovers(), true);
    inner.addEventListener(
      "pointermove",
      (event) => hover(event.buttons ? null : [event.clientX, event.clientY]),
      true,
    );
    inner.document.documentElement.addEventListener("pointerleave", () => hover(null));
    for (const kind of ["pointerdown", "wheel"]) inner.addEventListener(kind, () => (touched = true), true);
    onFrame(inner);
    locked = null;
    touched = false;
    settle();
  });

  /** @param {KeyboardEvent} event */
  function keyInScene(event) {
    const taken = onKey(event);
    const moves = CAMERA_KEYS.has(event.code) && (mode === "plan" || event.ctrlKey || event.metaKey);
    if (!taken && !moves && !event.key.startsWith("Arrow")) return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  /** @param {[number, number] | null} at */
  function hover(at) {
    for (const listener of hoverListeners) listener(at);
  }

  /** viser's camera, once its scene stands. */
  function controls() {
    const mutable = /** @type {any} */ (frame.contentWindow)?.__viserMutable;
    const control = mutable?.cameraControl;
    const camera = control?.camera ?? mutable?.camera;
    return control && camera ? { control, camera, mutable } : null;
  }

  /** Locks the camera as soon as there is one. */
  function settle() {
    const found = controls();
    if (!found) {
      if (source) requestAnimationFrame(settle);
      return;
    }
    if (locked !== found.control) {
      locked = found.control;
      locked.addEventListener("update", moved);
    }
    if (pendingFit) showBox(pendingFit);
    else applyCamera();
  }

  function moved() {
    const found = controls();
    if (!found) return;
    if (mode === "plan") {
      const at = target(found.control);
      const height = found.control.distance;
      // viser resets its camera when the server's initial one arrives.
      if (
        !isPlan(found) ||
        (!touched && plan && Math.hypot(at.x - plan.x, at.y - plan.y, height - plan.height) > 1e-3 * height)
      )
        return applyCamera();
      plan = { x: at.x, y: at.y, height };
      found.camera.near = height / 4;
      found.camera.far = height * 4;
      found.camera.updateProjectionMatrix();
    }
    drawBar();
    return undefined;
  }

  /** @param {{control: any, camera: any}} found */
  function isPlan({ control, camera }) {
    const up = toWorld(camera.up);
    const eye = control.getPosition(camera.position.clone());
    const at = control.getTarget(camera.position.clone());
    return (
      up[1] > 0.999 &&
      Math.hypot(eye.x - at.x, eye.z - at.z) < 1e-3 * control.distance &&
      Math.abs(camera.fov - PLAN_FOV_DEG) < 0.01
    );
  }

  /** @param {any} control */
  function target(control) {
    const at = control.getTarget(control.camera.position.clone());
    const [x, y] = toWorld(at);
    return { x, y };
  }

  function applyCamera() {
    const found = controls();
    if (!found || !plan) return;
    if (mode === "plan") lockPlan(found, plan);
    frame.classList.add("ready");
    drawBar();
  }

  /** @param {{control: any, camera: any, mutable: any}} found @param {{x: number, y: number, height: number}} view */
  function lockPlan({ control, camera, mutable }, { x, y, height }) {
    free(control);
    camera.fov = PLAN_FOV_DEG;
    camera.near = height / 4;
    camera.far = height * 4;
    camera.updateProjectionMatrix();
    place(control, camera, [0, 1, 0], [x, y, height], [x, y, 0]);
    control.minPolarAngle = control.maxPolarAngle = Math.PI / 2;
    control.minAzimuthAngle = control.maxAzimuthAngle = control.azimuthAngle;
    control.mouseButtons.left = control.mouseButtons.right = ACTION.TRUCK;
    control.mouseButtons.middle = ACTION.TRUCK;
    control.mouseButtons.wheel = ACTION.DOLLY;
    control.touches.one = ACTION.TOUCH_TRUCK;
    control.touches.two = control.touches.three = ACTION.TOUCH_DOLLY_TRUCK;
    control.dollyToCursor = true;
    control.dollySpeed = WHEEL_SPEED;
    control.minDistance = NEAREST;
    mutable.requestRender();
  }

  /** Any angle is allowed. @param {any} control */
  function free(control) {
    control.minPolarAngle = 0;
    control.maxPolarAngle = Math.PI;
    control.minAzimuthAngle = -Infinity;
    control.maxAzimuthAngle = Infinity;
  }

  function unlock() {
    const found = controls();
    if (!found) return;
    const { control, camera, mutable } = found;
    const { x, y, height } = plan ?? { x: 0, y: 0, height: 100 };
    const away = (height * Math.tan(rad(PLAN_FOV_DEG / 2))) / Math.tan(rad(FREE_FOV_DEG / 2));
    free(control);
    camera.fov = FREE_FOV_DEG;
    camera.near = 0.05;
    camera.far = 2000;
    camera.updateProjectionMatrix();
    place(control, camera, [0, 0, 1], [x, y - 0.75 * away, 0.8 * away], [x, y, 0]);
    control.mouseButtons.left = ACTION.ROTATE;
    control.mouseButtons.right = control.mouseButtons.middle = ACTION.TRUCK;
    control.touches.one = ACTION.TOUCH_ROTATE;
    control.dollyToCursor = false;
    mutable.requestRender();
    frame.classList.add("ready");
    drawBar();
  }

  /**
   * @param {any} control @param {any} camera
   * @param {number[]} up @param {number[]} eye @param {number[]} at in the coordinates of the scan
   */
  function place(control, camera, up, eye, at) {
    camera.up.set(...toThree(up));
    control.updateCameraUp();
    control.setLookAt(...toThree(eye), ...toThree(at), false);
    control.update(0);
  }

  /** @param {Box} box */
  function showBox(box) {
    const [xmin, ymin, xmax, ymax] = box;
    const aspect = frame.clientWidth / Math.max(1, frame.clientHeight);
    const half = MARGIN * Math.max((ymax - ymin) / 2, (xmax - xmin) / 2 / aspect, 0.5);
    plan = whole = { x: (xmin + xmax) / 2, y: (ymin + ymax) / 2, height: half / Math.tan(rad(PLAN_FOV_DEG / 2)) };
    pendingFit = controls() ? null : box;
    if (mode === "plan") applyCamera();
    else unlock();
  }

  function drawBar() {
    for (const listener of moveListeners) listener();
    bar.hidden = mode !== "plan" || !plan;
    if (bar.hidden || !plan) return;
    const pxPerMetre = frame.clientHeight / (2 * plan.height * Math.tan(rad(PLAN_FOV_DEG / 2)));
    const metres = niceLength(BAR_PX / pxPerMetre);
    bar.style.width = `${Math.round(metres * pxPerMetre)}px`;
    setText(barWords, metres >= 1 ? `${metres} m` : `${Math.round(metres * 100)} cm`);
  }

  new ResizeObserver(drawBar).observe(frame);

  return {
    frame,
    /** @param {string} path of the session's viser page */
    open(path) {
      if (path === source) return;
      source = path;
      frame.classList.remove("ready");
      frame.src = path;
    },
    /** Shows the whole box. @param {Box} box */
    fit: showBox,
    /** What the plan shows, where a person has moved it. @returns {import("../view/store.js").Look | null} */
    get look() {
      if (!plan || !whole || pendingFit) return null;
      const moved = Math.max(
        Math.abs(plan.x - whole.x),
        Math.abs(plan.y - whole.y),
        Math.abs(plan.height - whole.height) / 10,
      );
      return moved > 1e-3 * whole.height
        ? { x: plan.x, y: plan.y, span: 2 * plan.height * Math.tan(rad(PLAN_FOV_DEG / 2)) }
        : null;
    },
    /** @param {import("../view/store.js").Look} look */
    lookAt({ x, y, span }) {
      plan = { x, y, height: Math.max(NEAREST, span / 2 / Math.tan(rad(PLAN_FOV_DEG / 2))) };
      pendingFit = null;
      if (mode === "plan") applyCamera();
      else unlock();
    },
    /** Where a point of the plan is on the stage [px]; null in the free view. @param {number} x @param {number} y @returns {[number, number] | null} */
    project(x, y) {
      if (mode !== "plan" || !plan) return null;
      const pxPerMetre = frame.clientHeight / (2 * plan.height * Math.tan(rad(PLAN_FOV_DEG / 2)));
      return [frame.clientWidth / 2 + (x - plan.x) * pxPerMetre, frame.clientHeight / 2 - (y - plan.y) * pxPerMetre];
    },
    /** The point of the plan under a place on the stage [px]; null in the free view. @param {number} left @param {number} top @returns {[number, number] | null} */
    unproject(left, top) {
      if (mode !== "plan" || !plan) return null;
      const pxPerMetre = frame.clientHeight / (2 * plan.height * Math.tan(rad(PLAN_FOV_DEG / 2)));
      return [
        plan.x + (left - frame.clientWidth / 2) / pxPerMetre,
        plan.y - (top - frame.clientHeight / 2) / pxPerMetre,
      ];
    },
    /** Gives the scene a turn of the wheel that something over it has received. @param {WheelEvent} event */
    pass(event) {
      frame.contentDocument?.querySelector("canvas")?.dispatchEvent(new WheelEvent("wheel", event));
    },
    /** Moves the plan. @param {number} dx @param {number} dy [m] */
    pan(dx, dy) {
      if (mode !== "plan" || !plan) return;
      plan = { ...plan, x: plan.x + dx, y: plan.y + dy };
      applyCamera();
    },
    /** @param {(at: [number, number] | null) => void} listener told where on the stage the pointer is [px]; null: elsewhere, or dragging */
    onHover(listener) {
      hoverListeners.push(listener);
    },
    /** @param {() => void} listener called when the view of the scene changed */
    onMove(listener) {
      moveListeners.push(listener);
    },
    /** @param {"plan" | "free"} next */
    setMode(next) {
      if (next === mode) return;
      mode = next;
      if (mode === "plan") applyCamera();
      else unlock();
    },
  };
}

/** The greatest of 1, 2, 5 · 10ⁿ that is at most `most`. @param {number} most */
function niceLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  const factor = most / power >= 5 ? 5 : most / power >= 2 ? 2 : 1;
  return Number((factor * power).toPrecision(1));
}

/** @param {number} degrees */
function rad(degrees) {
  return (degrees * Math.PI) / 180;
}

// viser shows z up; three.js, which its camera lives in, has y up.
/** @param {number[]} point @returns {[number, number, number]} */
function toThree([x, y, z]) {
  return [-y, z, -x];
}

/** @param {{x: number, y: number, z: number}} point @returns {[number, number, number]} */
function toWorld({ x, y, z }) {
  return [-z, -x, y];
}
