// @ts-check
// How often viser draws. For a quarter of a second after each change it draws as often as the screen shows pictures, and
// without a graphics card this takes all of the processor, also from whatever else the page is to show.

// A frame that takes no longer [ms] is no burden.
const LIGHT_MS = 12;
// After other frames, viser rests for this many times as long as they took, but not for long [ms].
const REST = 2;
const LONGEST_REST_MS = 40;
// A frame that takes longer is no longer waited for [ms].
const PATIENCE_MS = 60;
const POLL_MS = 4;

/** Lets the scene rest after frames that take long. @param {any} scene the window of viser's page */
export function paceFrames(scene) {
  const ask = scene.requestAnimationFrame.bind(scene);
  const cancel = scene.cancelAnimationFrame.bind(scene);
  /** The present request of each that was asked for, none while it waits for the end of a rest. @type {Map<number, number | null>} */
  const asked = new Map();
  /** What waits. @type {Map<number, FrameRequestCallback>} */
  const waiting = new Map();
  let number = 0;
  let resting = false;
  /** The picture of the screen that is being drawn [ms]. */
  let drawing = 0;

  /** Waits until what was drawn is on the screen. */
  function rest() {
    const pen = scene.document.querySelector("canvas")?.getContext("webgl2");
    const fence = pen?.fenceSync(pen.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    resting = true;
    pen.flush();
    const begun = performance.now();
    const look = () => {
      const took = performance.now() - begun;
      const done = pen.isContextLost() || pen.getSyncParameter(fence, pen.SYNC_STATUS) === pen.SIGNALED;
      if (!done && took < PATIENCE_MS) return setTimeout(look, POLL_MS);
      pen.deleteSync(fence);
      return setTimeout(goOn, took > LIGHT_MS ? Math.min(REST * took, LONGEST_REST_MS) : 0);
    };
    setTimeout(look, 0);
  }

  /** To ask for each frame of a rest would have the page laid out and painted for each. @param {number} own @param {FrameRequestCallback} tried */
  function askOrWait(own, tried) {
    asked.set(own, resting ? null : ask(tried));
    if (resting) waiting.set(own, tried);
  }

  function goOn() {
    resting = false;
    for (const [own, tried] of waiting) asked.set(own, ask(tried));
    waiting.clear();
  }

  scene.requestAnimationFrame = (/** @type {FrameRequestCallback} */ draw) => {
    const own = --number;
    const tried = (/** @type {number} */ now) => {
      if (resting && now !== drawing) return askOrWait(own, tried);
      drawing = now;
      asked.delete(own);
      draw(now);
      if (!resting) rest();
    };
    askOrWait(own, tried);
    return own;
  };
  scene.cancelAnimationFrame = (/** @type {number} */ id) => {
    const present = asked.get(id);
    if (present !== null) cancel(present ?? id);
    asked.delete(id);
    waiting.delete(id);
  };
}
