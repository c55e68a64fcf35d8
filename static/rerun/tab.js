// @ts-check
// The tab Rerun: over the scene, rerun's viewer with a recording of the current view.
import { keyOf } from "../view/key.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { addressOf, record } from "./run.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {typeof import("../text/rerun.js").rerunText} Text */
/** @typedef {{setFrame: (frame: number) => Promise<void>}} Viewer */
/** @typedef {{session: () => string, dark: () => boolean, onFrame: (frame: number) => void, onOpen: (open: boolean) => void, cancelLabel: string}} Handlers */

const PARTS = /** @type {const} */ (["place", "method", "params"]);

export class RerunTab {
  /** @type {State | null} */
  #state = null;
  /** What the recording shows, and its id. */
  #recorded = { key: "", id: "" };
  /** @type {AbortController | null} */
  #work = null;
  /** @type {Viewer | null} */
  #viewer = null;
  /** Where the cursor is, and where it was last sent. */
  #cursor = -1;
  #asked = -1;
  /** Counts the opened iframes, so that a viewer that loads too late is ignored. */
  #generation = 0;
  #text;
  #handlers;
  #words = h("span", { class: "rerun-words", role: "status" });
  #bar = h("progress", { class: "progress rerun-progress", max: 1, hidden: true });
  #place = h("div", { class: "rerun-place" });
  #cancel;
  #again;
  #save;
  #box;

  /** @param {HTMLElement} stage @param {Text} text @param {Handlers} handlers */
  constructor(stage, text, handlers) {
    this.#text = text;
    this.#handlers = handlers;
    const cancelled = () => this.#work?.abort();
    const { cancelLabel } = handlers;
    this.#cancel = h("button", { type: "button", class: "button", hidden: true, onclick: cancelled }, cancelLabel);
    const repeat = { type: "button", class: "button primary", hidden: true, onclick: () => this.#show() };
    this.#again = h("button", repeat, text.again);
    this.#save = h("a", { class: "button", download: "", hidden: true }, text.download);
    const close = iconButton("close", text.close, () => this.close());
    const head = [this.#words, this.#bar, this.#cancel, this.#again, this.#save, close];
    this.#box = h(
      "section",
      { class: "rerun", "aria-label": text.viewer, hidden: true },
      h("div", { class: "rerun-head" }, ...head),
      this.#place,
    );
    stage.append(this.#box);
    const toggle = () => (this.#box.hidden ? this.#open() : this.close());
    const tab = { type: "button", class: "mode", "aria-pressed": "false", title: text.tabHelp, onclick: toggle };
    this.button = h("button", tab, text.tab);
  }

  #open() {
    this.#box.hidden = false;
    this.button.setAttribute("aria-pressed", "true");
    this.#handlers.onOpen(true);
    if (!this.#state) return;
    if (this.#recorded.key !== keyOf(this.#state, ...PARTS)) this.#show();
    else this.#follow();
  }

  close() {
    this.#work?.abort();
    this.#box.hidden = true;
    this.button.setAttribute("aria-pressed", "false");
    this.#handlers.onOpen(false);
  }

  async #show() {
    if (!this.#state) return;
    this.#work?.abort();
    const mine = new AbortController();
    this.#work = mine;
    const { label } = this.#state;
    const key = keyOf(this.#state, ...PARTS);
    this.#again.hidden = this.#save.hidden = true;
    this.#cancel.hidden = this.#bar.hidden = false;
    setText(this.#words, this.#text.recording(label));
    try {
      const show = (/** @type {number} */ done, /** @type {number} */ total) => {
        this.#bar.value = done / total;
      };
      const { recording } = await record(this.#handlers.session(), false, show, mine.signal);
      this.#recorded = { key, id: recording };
      this.#save.href = addressOf(recording, label);
      this.#save.hidden = false;
      await this.#start();
    } catch (error) {
      if (this.#work !== mine) return;
      const why = String(error instanceof Error ? error.message : error);
      setText(this.#words, mine.signal.aborted ? this.#text.cancelled : why);
      this.#again.hidden = false;
    }
    if (this.#work !== mine) return;
    this.#work = null;
    this.#cancel.hidden = this.#bar.hidden = true;
  }

  /** Opens a new iframe with a new viewer, because an old viewer keeps what it has loaded. */
  async #start() {
    setText(this.#words, this.#text.starting);
    this.#viewer = null;
    this.#cursor = this.#asked = -1;
    const mine = ++this.#generation;
    const frame = h("iframe", { class: "rerun-frame", title: this.#text.viewer, allow: "", src: "/rerun/" });
    this.#place.replaceChildren(frame);
    await new Promise((resolve) => frame.addEventListener("load", resolve, { once: true }));
    const inner = /** @type {any} */ (frame.contentWindow).rerunViewer;
    if (!inner?.canDraw()) return setText(this.#words, this.#text.noDrawing);
    try {
      const moved = (/** @type {number} */ to) => this.#moved(to);
      const started = await inner.start(addressOf(this.#recorded.id), this.#handlers.dark(), moved);
      if (mine !== this.#generation) return;
      this.#viewer = started;
      setText(this.#words, this.#text.follows);
      this.#follow();
    } catch (error) {
      setText(this.#words, this.#text.crashed(String(error)));
    }
  }

  /** @param {number} frame */
  #moved(frame) {
    this.#cursor = this.#asked = frame;
    if (this.#viewer && !this.#box.hidden && this.#state && frame !== this.#state.frame) this.#handlers.onFrame(frame);
  }

  #follow() {
    if (!this.#viewer || this.#box.hidden || !this.#state || this.#asked === this.#state.frame) return;
    const { frame } = this.#state;
    this.#asked = frame;
    this.#viewer.setFrame(frame).then(
      () => {
        this.#cursor = frame;
      },
      (error) => setText(this.#words, this.#text.crashed(String(error))),
    );
  }

  /** @param {State} next */
  setState(next) {
    // A replay is shown in the scene, which the viewer covers.
    if (!this.#box.hidden && this.#state?.step === null && next.step !== null) this.close();
    this.#state = next;
    const stale = this.#recorded.id !== "" && this.#recorded.key !== keyOf(next, ...PARTS);
    if (!this.#work && this.#recorded.id) {
      this.#again.hidden = !stale;
      if (this.#viewer) setText(this.#words, stale ? this.#text.stale : this.#text.follows);
    }
    if (!stale) this.#follow();
  }

  /** For scripts and tests. */
  get cursor() {
    return this.#viewer ? this.#cursor : null;
  }
}
