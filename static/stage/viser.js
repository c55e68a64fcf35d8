// @ts-check
// viser's camera (camera-controls on three.js): locked to the plan, or free; in the coordinates of the scan.

/** @typedef {{control: any, camera: any, mutable: any, nodes: () => Record<string, any>}} Found viser's camera and its control; nodes: of its scene, by name */
/** What the plan shows, and from how high [m]. @typedef {{x: number, y: number, height: number}} Plan */

export const PLAN_FOV_DEG = 10;
const FREE_FOV_DEG = 45;
/** The smallest distance of the camera from the plan [m]. */
export const NEAREST = 0.2;
/** How high the drawing may be, as a part of the camera's height: what lies higher is drawn farther out. */
const FLAT = 0.002;
/** The height of the drawing (app/scene/viser_scene.py) [m]. */
const DRAWN_HEIGHT = 0.5;
const WHEEL_SPEED = 1;
/** The node as large as one pixel (app/scene/viser_scene.py). */
const PIXEL = "/pixel";
// camera-controls' actions
const ACTION = { ROTATE: 1, TRUCK: 2, DOLLY: 16, TOUCH_ROTATE: 64, TOUCH_TRUCK: 128, TOUCH_DOLLY_TRUCK: 4096 };

/** viser's camera, once viser has put it where it begins and tells where it is. @param {HTMLIFrameElement} frame @returns {Found | null} */
export function cameraIn(frame) {
  const scene = /** @type {any} */ (frame.contentWindow);
  const mutable = scene?.__viserMutable;
  const control = mutable?.cameraControl;
  const camera = control?.camera ?? mutable?.camera;
  return control && camera && mutable.sendCamera
    ? { control, camera, mutable, nodes: () => scene.__viserSceneTree?.getState() ?? {} }
    : null;
}

/** Whether viser has heard what to draw; before, it shows axes on white. @param {HTMLIFrameElement} frame */
export function hasContent(frame) {
  const tree = /** @type {any} */ (frame.contentWindow)?.__viserSceneTree;
  return Boolean(tree?.getState()["/seen/points"]);
}

/** The point it looks at from straight above; null if it looks from elsewhere. @param {Found} found @returns {Plan | null} */
export function planOf({ control, camera }) {
  const up = toWorld(camera.up);
  const eye = control.getPosition(camera.position.clone());
  const at = control.getTarget(camera.position.clone());
  const above =
    up[1] > 0.999 &&
    Math.hypot(eye.x - at.x, eye.z - at.z) < 1e-3 * control.distance &&
    Math.abs(camera.fov - PLAN_FOV_DEG) < 0.01;
  const [x, y] = toWorld(at);
  return above ? { x, y, height: control.distance } : null;
}

/** @param {Found} found @param {number} height */
export function clip({ camera }, height) {
  camera.near = height / 4;
  camera.far = height * 4;
  camera.updateProjectionMatrix();
}

/**
 * How the plan is drawn: distances along the unit vector `normal` are `factor` times as long, about the point `at`.
 * @typedef {{factor: number, normal: [number, number], at: [number, number]}} Stretch
 */

/** Shows the plan stretched and flat; null: as it is, in space. @param {Found} found @param {Stretch | null} stretch @param {number | null} height */
export function bend(found, stretch, height) {
  const { camera, mutable } = found;
  const flat = height === null ? 1 : Math.min(1, (FLAT * height) / DRAWN_HEIGHT);
  const [u, v, w] = toThree([...(stretch?.normal ?? [0, 1]), 0]);
  const k = (stretch?.factor ?? 1) - 1;
  const at = toThree([...(stretch?.at ?? [0, 0]), 0]);
  const linear = [
    [1 + k * u * u, k * u * v, k * u * w],
    [k * v * u, flat + k * v * v, k * v * w],
    [k * w * u, k * w * v, 1 + k * w * w],
  ];
  const rows = linear.flatMap((row, i) => [
    ...row,
    at[i] * (i === 1 ? 0 : 1) - row.reduce((sum, part, j) => sum + part * at[j], 0),
  ]);
  rememberBend(
    found,
    height,
    camera.matrixWorld
      .clone()
      .set(...rows, 0, 0, 0, 1)
      .invert(),
  );
  mutable.requestRender();
}

/** Makes the camera see the world moved by the inverse of `back`. @param {Found} found @param {number | null} height @param {any} back */
function rememberBend(found, height, back) {
  const { camera } = found;
  const first = !camera.userData.back;
  Object.assign(camera.userData, { back, height });
  if (!first) return;
  for (const name of ["updateMatrixWorld", "updateWorldMatrix"]) {
    const usual = camera[name];
    camera[name] = (/** @type {any[]} */ ...given) => {
      usual.apply(camera, given);
      camera.matrixWorld.premultiply(camera.userData.back);
      camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
      if (camera.userData.height !== null) sizeMarks(found, camera.userData.height);
    };
  }
}

/**
 * Gives the marks of the plan their size on the screen before each frame. The server changes it, too, but only when it
 * has heard where the camera is, which may take seconds.
 * @param {Found} found @param {number} height
 */
function sizeMarks({ mutable, nodes }, height) {
  const all = nodes();
  const pixel = all[PIXEL]?.message.props.point_size;
  const { canvas } = mutable;
  if (!pixel || !canvas?.clientHeight) return;
  const density = canvas.height / canvas.clientHeight;
  for (const [name, { message }] of Object.entries(all)) {
    if (message.type !== "PointCloudMessage") continue;
    const wide = (message.props.point_size / pixel) * 2 * height * density;
    mutable.nodeRefFromName[name]?.traverse((/** @type {any} */ part) => {
      if (part.isPoints && part.material.uniforms?.scale) part.material.uniforms.scale.value = wide;
    });
  }
}

/** A point of the plan as it is drawn, or with `back` the other way. @param {Stretch | null} stretch @param {[number, number]} point @param {boolean} [back] @returns {[number, number]} */
export function stretched(stretch, [x, y], back = false) {
  if (!stretch) return [x, y];
  const [a, b] = stretch.normal;
  const aside = a * (x - stretch.at[0]) + b * (y - stretch.at[1]);
  const more = aside * ((back ? 1 / stretch.factor : stretch.factor) - 1);
  return [x + more * a, y + more * b];
}

/** Allows only panning and zooming. @param {Found} found @param {Plan} plan */
export function lockPlan(found, { x, y, height }) {
  const { control, camera, mutable } = found;
  allowAnyAngle(control);
  camera.fov = PLAN_FOV_DEG;
  clip(found, height);
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

/** Allows free rotation, starting with a view of the plan from the south. @param {Found} found @param {Plan} plan */
export function unlock({ control, camera, mutable }, { x, y, height }) {
  const away = (height * Math.tan(rad(PLAN_FOV_DEG / 2))) / Math.tan(rad(FREE_FOV_DEG / 2));
  allowAnyAngle(control);
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
}

/** Where a point of the scan is on the screen, from 0, 0 at the upper left to 1, 1; null if it is behind the camera. @param {Found} found @param {number[]} point @returns {[number, number] | null} */
export function onScreen({ camera }, point) {
  camera.updateMatrixWorld();
  const eye = times(camera.matrixWorldInverse.elements, [...toThree(point), 1]);
  const [x, y, , w] = times(camera.projectionMatrix.elements, eye);
  return w > 0 ? [(1 + x / w) / 2, (1 - y / w) / 2] : null;
}

/** A matrix, column after column, times a vector. @param {number[]} matrix @param {number[]} vector */
function times(matrix, vector) {
  return vector.map((_, row) => vector.reduce((sum, value, column) => sum + matrix[4 * column + row] * value, 0));
}

/** @param {any} control */
function allowAnyAngle(control) {
  control.minPolarAngle = 0;
  control.maxPolarAngle = Math.PI;
  control.minAzimuthAngle = -Infinity;
  control.maxAzimuthAngle = Infinity;
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

/** @param {number} degrees */
export function rad(degrees) {
  return (degrees * Math.PI) / 180;
}

// In viser z points up; in three.js, which its camera uses, y does.
/** @param {number[]} point @returns {[number, number, number]} */
function toThree([x, y, z]) {
  return [-y, z, -x];
}

/** @param {{x: number, y: number, z: number}} point @returns {[number, number, number]} */
function toWorld({ x, y, z }) {
  return [-z, -x, y];
}
