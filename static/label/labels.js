// @ts-check
// The page "Labels" of the mode Inspect: what people say of the frame, and the tool that edits its true lines.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { tooltip } from "../widgets/tooltip.js";
import { fetchText } from "../fetch.js";
import { createKeep } from "./keep.js";
import { drawn, merged, moved, seenOf, split, without } from "./lines.js";
import { createList } from "./list.js";
import { createOverlay } from "./overlay.js";
import { createStatus } from "./status.js";
import { createTags } from "./tags.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("./lines.js").Line} Line */
/** @typedef {import("./lines.js").Sweep} Sweep */

/**
 * @param {HTMLElement} stage
 * @param {import("../stage/stage.js").Stage} view
 * @param {typeof import("../text/label.js").labelText} text
 * @param {{onFrame: (frame: number) => void, number: (frame: number) => number}} handlers number: what a frame is called
 */
export function createLabels(stage, view, text, { onFrame, number }) {
  /** @type {State | null} */
  let state = null;
  /** Of the frame, once it is known. @type {Sweep | null} */
  let sweep = null;
  let sweepOf = "";
  let chosen = -1;
  let cut = 0;
  let drawing = false;
  /** Lines under the hand, not yet said. @type {Line[] | null} */
  let dragged = null;

  const keep = createKeep({ onChange: show });
  const overlay = createOverlay(stage, view, text.handle, { onChoose: choose, onGrip, onDrawn });
  const tags = createTags(text, {
    onTags: (next) => say({ tags: next }),
    onNote(note, from, gesture) {
      const now = keep.of(frame());
      if (now.note === from) say({ note }, gesture);
      else keep.clash(frame(), { ...now, note });
    },
  });
  const list = createList(text, choose);
  const status = createStatus(text.status, { onRetry: () => keep.retry(), onMine: () => keep.insist(), number });
  const button = (/** @type {string} */ label, /** @type {string} */ help, /** @type {() => void} */ run) => {
    const made = h("button", { type: "button", class: "button", onclick: run }, label);
    tooltip(made, help);
    return made;
  };
  const undoButton = iconButton("undo", text.undo, () => undo());
  const redoButton = iconButton("redo", text.redo, () => redo());
  const drawButton = button(text.draw, text.drawHelp, () => draw(!drawing));
  const onLine = [
    button(text.split, text.splitHelp, splitLine),
    button(text.merge, text.mergeHelp, () => mergeLine(1)),
    button(text.remove, text.removeHelp, removeLine),
  ];
  const accept = button(text.accept, text.acceptHelp, () => commit(lines(), chosen));
  const restart = button(text.restart, text.restartHelp, () => commit(proposal(), -1));
  const forget = button(text.forget, text.forgetHelp, () => say({ lines: null }));
  const message = h("p", { class: "hint", role: "status" });
  const element = h(
    "div",
    { class: "labels" },
    status.trouble,
    ...tags.elements,
    h("div", { class: "labels-head" }, h("h3", {}, text.lines), h("span", { class: "spacer" }), undoButton, redoButton),
    h("div", { class: "labels-actions" }, drawButton, ...onLine),
    message,
    list.element,
    h("div", { class: "labels-actions" }, accept, restart, forget),
    status.element,
  );
  new MutationObserver(() => (draw(false), show())).observe(element, { attributeFilter: ["hidden"] });

  const frame = () => state?.frame ?? 0;
  const active = () => !element.hidden && state?.mode === "inspect";
  const editable = () => state?.labels !== null && !state?.labels?.trouble;
  const proposal = () => state?.segments.map(({ first, last, start, end }) => ({ first, last, start, end })) ?? [];
  const lines = () => dragged ?? keep.of(frame()).lines ?? proposal();

  /** @param {Partial<import("./keep.js").Said>} part @param {string | null} [gesture] */
  function say(part, gesture = null) {
    if (editable()) keep.edit(frame(), { ...keep.of(frame()), ...part }, gesture);
    show();
  }

  /** @param {Line[]} next @param {number} then the line that is chosen afterwards @param {string | null} [gesture] */
  function commit(next, then, gesture = null) {
    dragged = null;
    [chosen, cut] = [then, middle(next[then])];
    say({ lines: next }, gesture);
  }

  /** The edited lines, or why they cannot be. @param {{lines: Line[], chosen: number} | null} next @param {string} why */
  function take(next, why) {
    if (next) commit(next.lines, next.chosen);
    else setText(message, why);
  }

  /** @param {Line | undefined} line */
  function middle(line) {
    if (!line || !sweep) return 0;
    const beams = seenOf(line, sweep);
    return beams[Math.floor((beams.length - 1) / 2)] ?? line.first;
  }

  /** @param {number} k @param {number | null} [beam] */
  function choose(k, beam = null) {
    chosen = k;
    const line = lines()[k];
    cut = beam !== null && beam !== line?.last ? beam : middle(line);
    show();
  }

  /** @param {import("./overlay.js").Grip} grip @param {number} beam @param {boolean} done */
  function onGrip(grip, beam, done) {
    // Another may have changed the lines under the hand.
    if (!editable() || !lines()[chosen]) return;
    if (grip === "cut") {
      cut = beam;
      return show();
    }
    const next = moved(lines(), chosen, grip, beam);
    dragged = next.lines;
    chosen = next.chosen;
    if (done) commit(next.lines, chosen, `${grip} of ${next.lines[chosen][grip === "first" ? "last" : "first"]}`);
    else show();
  }

  /** @param {number[]} run */
  function onDrawn(run) {
    draw(false);
    take(sweep && drawn(lines(), run, sweep), text.tooShort);
  }

  /** @param {boolean} on */
  function draw(on) {
    drawing = on && editable();
    if (drawing) chosen = -1;
    show();
  }

  function splitLine() {
    if (!sweep || !lines()[chosen]) return setText(message, text.choose);
    return take(split(lines(), chosen, cut, sweep), text.tooShort);
  }

  /** @param {1 | -1} by */
  function mergeLine(by) {
    if (!sweep || !lines()[chosen]) return setText(message, text.choose);
    // The last of them has its neighbour before it.
    return take(merged(lines(), chosen, by, sweep) ?? merged(lines(), chosen, by === 1 ? -1 : 1, sweep), text.alone);
  }

  function removeLine() {
    if (!lines()[chosen]) return setText(message, text.choose);
    return take(without(lines(), chosen), "");
  }

  const undo = () => arrive(keep.undo());
  const redo = () => arrive(keep.redo());

  /** To the frame whose edit was undone. @param {number | null} there */
  function arrive(there) {
    if (there === null) return;
    if (there !== frame()) onFrame(there);
    chosen = -1;
    show();
  }

  function show() {
    if (!active() || !state) return overlay.set(null);
    const said = keep.of(frame());
    const can = editable();
    const { canUndo, canRedo } = keep.status;
    status.set(keep.status, state.labels, said.lines !== null || said.tags.length > 0 || said.note !== "");
    tags.set(said, can);
    undoButton.disabled = !canUndo;
    redoButton.disabled = !canRedo;
    const shown = lines();
    if (!shown[chosen]) chosen = -1;
    for (const each of [...onLine, drawButton, accept, restart, forget]) each.disabled = !can;
    for (const each of onLine) each.disabled ||= chosen < 0 || !sweep;
    drawButton.setAttribute("aria-pressed", String(drawing));
    accept.hidden = said.lines !== null;
    restart.hidden = forget.hidden = said.lines === null;
    setText(
      message,
      !can
        ? ""
        : state.camera === "free"
          ? text.plan
          : drawing
            ? text.drawing
            : said.lines === null
              ? text.proposed(shown.length)
              : shown.length
                ? text.hint
                : text.none,
    );
    list.set(shown, chosen, sweep);
    overlay.set({ lines: shown, chosen, cut, proposed: said.lines === null && dragged === null, sweep, drawing });
    return void need();
  }

  /** Asks for the points of the frame. */
  async function need() {
    if (!state || state.labels === null) return;
    const { recording, topics, topic } = state;
    const query = new URLSearchParams({
      recording,
      frame: String(frame()),
      ...(topics.length > 1 && topic ? { topic } : {}),
    });
    const key = String(query);
    if (key === sweepOf) return;
    [sweepOf, sweep] = [key, null];
    const { words, trouble } = await fetchText(`/api/labels/points?${key}`);
    if (sweepOf !== key) return;
    if (trouble) sweepOf = "";
    else sweep = JSON.parse(words);
    cut = middle(lines()[chosen]);
    show();
  }

  return {
    element,
    undo,
    redo,
    split: splitLine,
    merge: mergeLine,
    remove: removeLine,
    /** Begins, or ends, drawing a new line. */
    draw: () => draw(!drawing),
    /** Whether the tool is in use. */
    get active() {
      return active();
    },
    /** Leaves the innermost thing. @returns {boolean} false if there was nothing to leave */
    leave() {
      if (!active() || (!drawing && chosen < 0)) return false;
      chosen = -1;
      draw(false);
      return true;
    },
    /** The server is there, perhaps again. */
    setWelcome: () => keep.retry(),
    /** Tags of all frames. @param {string[]} names */
    suggest: (names) => tags.suggest(names),
    /** @param {State} next */
    setState(next) {
      const other =
        !state || next.frame !== state.frame || next.recording !== state.recording || next.topic !== state.topic;
      if (other) {
        tags.commit();
        [dragged, chosen] = [null, -1];
      }
      if (keep.setState(next)) [dragged, chosen] = [null, -1];
      state = next;
      show();
    },
  };
}
