// @ts-check
// A finger that rests.
const HOLD_MS = 500;
const STILL_PX = 10;

/** @param {Window | HTMLElement} target @param {(left: number, top: number) => void} run told where the finger rests on the page of the target [px] */
export function onLongPress(target, run) {
  let timer = 0;
  let [left, top] = [0, 0];
  const stop = () => clearTimeout(timer);
  /** @type {[string, (event: any) => void][]} */
  const heard = [
    [
      "pointerdown",
      ({ pointerType, isPrimary, clientX, clientY }) => {
        stop();
        if (pointerType !== "touch" || !isPrimary) return;
        [left, top] = [clientX, clientY];
        timer = setTimeout(() => run(left, top), HOLD_MS);
      },
    ],
    ["pointermove", ({ clientX, clientY }) => Math.hypot(clientX - left, clientY - top) > STILL_PX && stop()],
    ["pointerup", stop],
    ["pointercancel", stop],
    ["contextmenu", (event) => event.pointerType === "touch" && event.preventDefault()],
  ];
  for (const [kind, listener] of heard) target.addEventListener(kind, listener, true);
}
