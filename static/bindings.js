// @ts-check
// What each key does.
import { closePopovers } from "./widgets/menu.js";

/** @typedef {import("./keys.js").Binding} Binding */
/** @typedef {{toggle: () => void, togglePlay: () => unknown, move: (by: number) => void, jump: (mark: "seed" | "line" | "drop") => void, leave: () => void}} Steps */
/** @typedef {{readonly active: boolean, undo: () => void, redo: () => void}} Editor */

/**
 * @param {import("./page.js").Page} page
 * @param {{replay: Steps, learn: {stepper: import("./learn/stepper.js").Stepper, answer: (yes: boolean) => void},
 *          timeline: {toggle: () => void, pace: (by: 1 | -1) => void, move: (by: number) => void, doubtful: (by: 1 | -1) => void},
 *          inspect: ReturnType<typeof import("./inspect/inspect.js").createInspect>, labels: ReturnType<typeof import("./label/labels.js").createLabels>,
 *          draw: Editor, panel: {open: (name: string) => void}, camera: {fit: () => void, closeUp: {toggle: () => void}, toggle: () => void},
 *          layout: {toggle: (part: "panel" | "timeline") => void}, ruler: {readonly active: boolean, toggle: () => void}, layers: {button: HTMLElement, toggle: (name: string) => void}, world: {toggle: () => unknown}, opening: {choose: () => void}}} parts
 * @param {typeof import("./text/words.js").words} words
 * @param {() => void} help
 * @returns {Binding[]}
 */
export function bindingsOf(page, parts, words, help) {
  const does = words.page.help.keys;
  const { timeline, inspect, labels, draw, camera, learn } = parts;
  const steps = () => (page.learning ? learn.stepper : parts.replay);
  /** What ← and → move through. */
  const place = () => (page.replaying ? steps() : timeline);
  /** The part whose edits Ctrl+Z undoes. */
  const editor = () => [draw, labels].find(({ active }) => active) ?? page.store;

  /** @param {"refusal" | "merge" | "cut"} mark */
  const jumpInLearn = (mark) => page.learning && learn.stepper.jump(mark);

  const openLabels = () => (page.setMode("inspect"), parts.panel.open("labels"));

  /** @param {1 | -1} by */
  function doubtful(by) {
    if (page.view.mode === "inspect") inspect.frames.next(by);
    else timeline.doubtful(by);
  }

  function leave() {
    if (document.querySelector(":popover-open:not([popover=manual])")) closePopovers();
    else if (labels.leave()) return;
    else if (parts.ruler.active) parts.ruler.toggle();
    else if (page.view.selected !== null) page.change({ selected: null });
    else if (page.replaying) steps().leave();
  }

  return [
    {
      keys: ["Space"],
      shown: "␣",
      does: does.play,
      run: () => (page.replaying ? steps().togglePlay() : timeline.toggle()),
    },
    { keys: [","], shown: ", .", does: does.pace, run: () => timeline.pace(-1) },
    { keys: ["."], shown: "", does: "", run: () => timeline.pace(1) },
    { keys: ["ArrowLeft"], shown: "← →", does: does.step, run: () => place().move(-1) },
    { keys: ["ArrowRight"], shown: "", does: "", run: () => place().move(1) },
    { keys: ["Shift+ArrowLeft"], shown: "", does: "", run: () => place().move(-10) },
    { keys: ["Shift+ArrowRight"], shown: "", does: "", run: () => place().move(10) },
    { keys: ["Home"], shown: "Home End", does: does.ends, run: () => place().move(-Infinity) },
    { keys: ["End"], shown: "", does: "", run: () => place().move(Infinity) },
    { keys: ["r"], shown: "R", does: does.replay, run: () => steps().toggle() },
    {
      keys: ["s"],
      shown: "S N D",
      does: does.jumps,
      run: () => (labels.active ? labels.split() : steps().jump("seed")),
    },
    { keys: ["n"], shown: "", does: "", run: () => (page.replaying ? steps().jump("line") : doubtful(1)) },
    { keys: ["d"], shown: "", does: "", run: () => steps().jump("drop") },
    { keys: ["x"], shown: "X M C", does: words.learn.keys.jumps, run: () => jumpInLearn("refusal") },
    { keys: ["m"], shown: "", does: "", run: () => (labels.active ? labels.merge(1) : jumpInLearn("merge")) },
    { keys: ["c"], shown: "", does: "", run: () => jumpInLearn("cut") },
    { keys: ["z"], shown: "Z", does: words.learn.keys.closeUp, run: () => page.learning && camera.closeUp.toggle() },
    { keys: ["Shift+n"], shown: "N Shift+N", does: does.doubtful, run: () => !page.replaying && doubtful(-1) },
    { keys: ["b"], shown: "B Shift+B", does: words.inspect.keys.ab, run: inspect.togglePin },
    { keys: ["Shift+b"], shown: "", does: "", run: inspect.nextDifference },
    { keys: ["e"], shown: "E", does: words.label.keys.open, run: openLabels },
    { keys: ["a"], shown: "A S M Del", does: words.label.keys.edit, run: () => labels.active && labels.draw() },
    { keys: ["Shift+m"], shown: "", does: "", run: () => labels.active && labels.merge(-1) },
    { keys: ["Delete", "Backspace"], shown: "", does: "", run: () => labels.active && labels.remove() },
    { keys: ["1"], shown: "1 2", does: words.learn.keys.answer, run: () => page.learning && learn.answer(true) },
    { keys: ["2"], shown: "", does: "", run: () => page.learning && learn.answer(false) },
    { keys: ["f"], shown: "F", does: does.fit, run: camera.fit },
    { keys: ["v"], shown: "V", does: does.view, run: camera.toggle },
    { keys: ["g"], shown: "G", does: does.world, run: parts.world.toggle },
    { keys: ["l"], shown: "L", does: does.layers, run: () => parts.layers.button.click() },
    { keys: ["p"], shown: "P T", does: does.hide, run: () => parts.layout.toggle("panel") },
    { keys: ["t"], shown: "", does: "", run: () => parts.layout.toggle("timeline") },
    { keys: ["u"], shown: "U", does: does.ruler, run: () => parts.ruler.toggle() },
    { keys: ["i"], shown: "I", does: does.numbers, run: () => parts.layers.toggle("numbers") },
    { keys: ["o", "Ctrl+o"], shown: "O", does: does.open, run: parts.opening.choose },
    { keys: ["Ctrl+z"], shown: "Ctrl+Z", does: does.undo, run: () => editor().undo() },
    { keys: ["Ctrl+Shift+z", "Ctrl+y"], shown: "Ctrl+Shift+Z", does: does.redo, run: () => editor().redo() },
    { keys: ["Escape"], shown: "Esc", does: does.escape, run: leave },
    { keys: ["?"], shown: "?", does: does.help, run: help },
  ];
}
