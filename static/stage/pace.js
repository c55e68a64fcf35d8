// @ts-check
// How often viser draws. For a quarter of a second after each change it draws as often as the screen shows pictures, and
// without a graphics card this takes all of the processor, also from whatever else the page is to show.

// A frame that takes no longer [ms] is no burden.
const LIGHT_MS = 12;
const POLL_MS = 4;
// After a frame, viser rests for this many times as long as it took.
const REST = 1;
const LONGEST_MS = 120;

/** Lets the scene rest after frames that take long. @param {any} scene the window of viser's page */
export function paceFrames(scene) {
  const usual = scene.requestAnimationFrame.bind(scene);
  const cancel = scene.cancelAnimationFrame.bind(scene);
  /** What waits for the end of a rest, by its number. @type {Map<number, FrameRequestCallback>} */
  const waiting = new Map();
  let number = 0;
  let resting = false;

  /** @param {FrameRequestCallback} draw */
  function next(draw) {
    return usual((/** @type {number} */ now) => {
      const begun = performance.now();
      draw(now);
      if (!resting) afterwards(begun);
    });
  }

  /** Waits until what was drawn is on the screen. @param {number} begun */
  function afterwards(begun) {
    const pen = scene.document.querySelector("canvas")?.getContext("webgl2");
    const fence = pen?.fenceSync(pen.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    resting = true;
    pen.flush();
    const look = () => {
      const took = performance.now() - begun;
      const done = pen.getSyncParameter(fence, pen.SYNC_STATUS) === pen.SIGNALED || pen.isContextLost();
      if (!done && took < LONGEST_MS) return setTimeout(look, POLL_MS);
      pen.deleteSync(fence);
      return setTimeout(go, took > LIGHT_MS ? Math.min(REST * took, LONGEST_MS) : 0);
    };
    setTimeout(look, 0);
  }

  function go() {
    resting = false;
    for (const draw of waiting.values()) next(draw);
    waiting.clear();
  }

  scene.requestAnimationFrame = (/** @type {FrameRequestCallback} */ draw) => {
    if (!resting) return next(draw);
    number -= 1;
    waiting.set(number, draw);
    return number;
  };
  scene.cancelAnimationFrame = (/** @type {number} */ id) => waiting.delete(id) || cancel(id);
}
