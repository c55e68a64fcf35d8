// @ts-check
// The tab Rerun: over the scene, rerun's viewer with a recording of the present view.
import { keyOf } from "../view/key.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { addressOf, record } from "./run.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {{setFrame: (frame: number) => Promise<void>}} Viewer */

const PARTS = /** @type {const} */ (["recording", "topic", "method", "params"]);

/**
 * @param {HTMLElement} stage
 * @param {typeof import("../text/rerun.js").rerunText} text
 * @param {{session: () => string, dark: () => boolean, onFrame: (frame: number) => void, cancelLabel: string}} handlers
 */
export function mountRerun(stage, text, { session, dark, onFrame, cancelLabel }) {
  /** @type {State | null} */
  let state = null;
  /** What the recording shows, and its id. */
  let recorded = { key: "", id: "" };
  /** @type {AbortController | null} */
  let work = null;
  /** @type {Viewer | null} */
  let viewer = null;
  /** Where the cursor is, and where it was last sent. */
  let cursor = -1;
  let asked = -1;
  /** Counts the frames of the page that were opened, so that a viewer that comes too late is not taken. */
  let generation = 0;

  const words = h("span", { class: "rerun-words", role: "status" });
  const bar = h("progress", { class: "progress rerun-progress", max: 1, hidden: true });
  const cancel = h(
    "button",
    { type: "button", class: "button", hidden: true, onclick: () => work?.abort() },
    cancelLabel,
  );
  const again = h(
    "button",
    { type: "button", class: "button primary", hidden: true, onclick: () => show() },
    text.again,
  );
  const save = h("a", { class: "button", download: "", hidden: true }, text.download);
  const head = h(
    "div",
    { class: "rerun-head" },
    words,
    bar,
    cancel,
    again,
    save,
    iconButton("close", text.close, close),
  );
  const place = h("div", { class: "rerun-place" });
  const box = h("section", { class: "rerun", "aria-label": text.viewer, hidden: true }, head, place);
  stage.append(box);
  const button = h(
    "button",
    {
      type: "button",
      class: "mode",
      "aria-pressed": "false",
      title: text.tabHelp,
      onclick: () => (box.hidden ? open() : close()),
    },
    text.tab,
  );

  function open() {
    box.hidden = false;
    button.setAttribute("aria-pressed", "true");
    if (!state) return;
    if (recorded.key !== keyOf(state, ...PARTS)) show();
    else follow();
  }

  function close() {
    work?.abort();
    box.hidden = true;
    button.setAttribute("aria-pressed", "false");
  }

  async function show() {
    if (!state) return;
    work?.abort();
    const mine = (work = new AbortController());
    const { label } = state;
    const key = keyOf(state, ...PARTS);
    again.hidden = save.hidden = true;
    cancel.hidden = bar.hidden = false;
    setText(words, text.recording(label));
    try {
      const { recording } = await record(session(), false, (done, total) => (bar.value = done / total), mine.signal);
      recorded = { key, id: recording };
      save.href = addressOf(recording, label);
      save.hidden = false;
      await start();
    } catch (error) {
      if (work !== mine) return;
      setText(words, mine.signal.aborted ? text.cancelled : String(error instanceof Error ? error.message : error));
      again.hidden = false;
    }
    if (work !== mine) return;
    work = null;
    cancel.hidden = bar.hidden = true;
  }

  /** A new frame with a new viewer: one that has run keeps what it had loaded. */
  async function start() {
    setText(words, text.starting);
    viewer = null;
    cursor = asked = -1;
    const mine = ++generation;
    const frame = h("iframe", { class: "rerun-frame", title: text.viewer, allow: "", src: "/rerun/" });
    place.replaceChildren(frame);
    await new Promise((resolve) => frame.addEventListener("load", resolve, { once: true }));
    const inner = /** @type {any} */ (frame.contentWindow).rerunViewer;
    if (!inner?.canDraw()) return setText(words, text.noDrawing);
    try {
      const started = await inner.start(addressOf(recorded.id), dark(), moved);
      if (mine !== generation) return;
      viewer = started;
      setText(words, text.follows);
      follow();
    } catch (error) {
      setText(words, text.crashed(String(error)));
    }
  }

  /** @param {number} frame */
  function moved(frame) {
    cursor = asked = frame;
    if (viewer && !box.hidden && state && frame !== state.frame) onFrame(frame);
  }

  function follow() {
    if (!viewer || box.hidden || !state || asked === state.frame) return;
    const frame = (asked = state.frame);
    viewer.setFrame(frame).then(
      () => (cursor = frame),
      (error) => setText(words, text.crashed(String(error))),
    );
  }

  return {
    button,
    /** @param {State} next */
    setState(next) {
      state = next;
      const stale = recorded.id !== "" && recorded.key !== keyOf(next, ...PARTS);
      if (!work && recorded.id) {
        again.hidden = !stale;
        if (viewer) setText(words, stale ? text.stale : text.follows);
      }
      if (!stale) follow();
    },
    /** For scripts and tests. */
    get cursor() {
      return viewer ? cursor : null;
    },
  };
}
