// @ts-check
// The page "Labels" of the mode Inspect: the labels of the frame, and the tool that edits its true lines.
import { h, setText } from "../widgets/dom.js";
import { Keep } from "./keep.js";
import { drawn, merged, moved, seenOf, split, without } from "./lines.js";
import { createList } from "./list.js";
import { Overlay } from "./overlay.js";
import { createStatus } from "./status.js";
import { FrameSweep } from "../stage/sweep.js";
import { Tags } from "./tags.js";
import { Tools } from "./tools.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("./lines.js").Line} Line */
/** @typedef {import("./book.js").Said} Said */
/** @typedef {typeof import("../text/label.js").labelText} Text */
/** @typedef {{onFrame: (frame: number) => void}} Handlers */

/**
 * @param {HTMLElement} stage
 * @param {import("./overlay.js").PlanView} view
 * @param {Text} text
 * @param {Handlers} handlers
 */
export function createLabels(stage, view, text, handlers) {
  return new Labels(stage, view, text, handlers);
}

class Labels {
  #text;
  #onFrame;
  /** @type {State | null} */ #state = null;
  #sweep = new FrameSweep(() => this.choose(this.#chosen));
  /** Index of the selected line; −1: none. */ #chosen = -1;
  /** The beam at which it would be split. */ #cut = 0;
  #drawing = false;
  /** Lines during a drag, not saved yet. @type {Line[] | null} */ #dragged = null;
  #keep = new Keep({ onChange: () => this.#show() });
  #overlay;
  #tags;
  #list;
  #status;
  #tools;
  #message = h("p", { class: "hint", role: "status" });

  /**
   * @param {HTMLElement} stage
   * @param {import("./overlay.js").PlanView} view
   * @param {Text} text
   * @param {Handlers} handlers
   */
  constructor(stage, view, text, { onFrame }) {
    this.#text = text;
    this.#onFrame = onFrame;
    this.#overlay = new Overlay(stage, view, text.handle, {
      onChoose: (line, beam) => this.choose(line, beam),
      onGrip: (grip, beam, done) => this.#grip(grip, beam, done),
      onDrawn: (run) => this.#drawn(run),
    });
    this.#tags = new Tags(text, {
      onTags: (tags) => this.#say({ tags }),
      onNote: (note, from, gesture) => this.#note(note, from, gesture),
    });
    this.#list = createList(text, (line) => this.choose(line));
    this.#status = createStatus(text.status, {
      onRetry: () => this.#keep.retry(),
      onMine: () => this.#keep.insist(),
    });
    this.#tools = new Tools(text, {
      undo: () => this.undo(),
      redo: () => this.redo(),
      draw: () => this.draw(),
      split: () => this.split(),
      merge: () => this.merge(1),
      remove: () => this.remove(),
      accept: () => this.#commit(this.#lines, this.#chosen),
      restart: () => this.#commit(this.#proposal, -1),
      forget: () => this.#say({ lines: null }),
    });
    this.element = h(
      "div",
      { class: "labels" },
      this.#status.trouble,
      ...this.#tags.elements,
      this.#tools.head,
      this.#tools.lines,
      this.#message,
      this.#list.element,
      this.#tools.whole,
      this.#status.element,
    );
    new MutationObserver(() => this.#setDrawing(false)).observe(this.element, { attributeFilter: ["hidden"] });
  }

  get #frame() {
    return this.#state?.frame ?? 0;
  }

  get #editable() {
    return this.#state?.labels !== null && !this.#state?.labels?.trouble;
  }

  /** The lines of the current result. @returns {Line[]} */
  get #proposal() {
    return this.#state?.segments.map(({ first, last, start, end }) => ({ first, last, start, end })) ?? [];
  }

  get #lines() {
    return this.#dragged ?? this.#keep.of(this.#frame).lines ?? this.#proposal;
  }

  /** What is written of the frame. */
  note = () => (this.#state ? this.#keep.of(this.#frame).note : "");

  /** Whether the tool is in use. */
  get active() {
    return !this.element.hidden && this.#state?.mode === "inspect";
  }

  /** @param {Partial<Said>} part @param {string | null} [gesture] */
  #say(part, gesture = null) {
    if (this.#editable) this.#keep.edit(this.#frame, { ...this.#keep.of(this.#frame), ...part }, gesture);
    this.#show();
  }

  /** @param {string} note @param {string} from the note that was typed in @param {string} gesture */
  #note(note, from, gesture) {
    const now = this.#keep.of(this.#frame);
    if (now.note === from) this.#say({ note }, gesture);
    else this.#keep.clash(this.#frame, { ...now, note });
  }

  /** @param {Line[]} lines @param {number} then the line that is chosen afterwards @param {string | null} [gesture] */
  #commit(lines, then, gesture = null) {
    this.#dragged = null;
    this.#chosen = then;
    this.#cut = this.#middle(lines[then]);
    this.#say({ lines }, gesture);
  }

  /** Keeps the edited lines, or says why they are not allowed. @param {{lines: Line[], chosen: number} | null} edited @param {string} why */
  #take(edited, why) {
    if (edited) this.#commit(edited.lines, edited.chosen);
    else setText(this.#message, why);
  }

  /** The beam in the middle. @param {Line | undefined} line */
  #middle(line) {
    if (!line || !this.#sweep.now) return 0;
    const beams = seenOf(line, this.#sweep.now);
    return beams[Math.floor((beams.length - 1) / 2)] ?? line.first;
  }

  /** @param {number} k @param {number | null} [beam] at which it would be split */
  choose(k, beam = null) {
    const line = this.#lines[k];
    this.#chosen = k;
    this.#cut = beam !== null && beam !== line?.last ? beam : this.#middle(line);
    this.#show();
  }

  /** @param {import("./overlay.js").Grip} grip @param {number} beam @param {boolean} done */
  #grip(grip, beam, done) {
    // Another tab may have changed the lines during the drag.
    if (!this.#editable || !this.#lines[this.#chosen]) return;
    if (grip === "cut") {
      this.#cut = beam;
      return this.#show();
    }
    const { lines, chosen } = moved(this.#lines, this.#chosen, grip, beam);
    this.#dragged = lines;
    this.#chosen = chosen;
    if (done) this.#commit(lines, chosen, `${grip} of ${lines[chosen][grip === "first" ? "last" : "first"]}`);
    else this.#show();
  }

  /** @param {number[]} run of beams */
  #drawn(run) {
    this.#setDrawing(false);
    this.#take(this.#sweep.now && drawn(this.#lines, run, this.#sweep.now), this.#text.tooShort);
  }

  /** @param {boolean} on */
  #setDrawing(on) {
    this.#drawing = on && this.#editable;
    if (this.#drawing) this.#chosen = -1;
    this.#show();
  }

  /** Starts or stops drawing a new line. */
  draw() {
    this.#setDrawing(!this.#drawing);
  }

  /** Edits the selected line, if there is one. @param {(lines: Line[], chosen: number, sweep: import("./lines.js").Sweep) => {lines: Line[], chosen: number} | null} edit @param {string} why it is not possible */
  #edit(edit, why) {
    const { now } = this.#sweep;
    if (now && this.#lines[this.#chosen]) this.#take(edit(this.#lines, this.#chosen, now), why);
    else setText(this.#message, this.#text.choose);
  }

  split() {
    this.#edit((lines, chosen, sweep) => split(lines, chosen, this.#cut, sweep), this.#text.tooShort);
  }

  /** Merges with the next (1) or previous (−1) line; the last line has only a previous one. @param {1 | -1} by */
  merge(by) {
    const other = by === 1 ? -1 : 1;
    this.#edit(
      (lines, chosen, sweep) => merged(lines, chosen, by, sweep) ?? merged(lines, chosen, other, sweep),
      this.#text.alone,
    );
  }

  remove() {
    if (this.#lines[this.#chosen]) this.#take(without(this.#lines, this.#chosen), "");
    else setText(this.#message, this.#text.choose);
  }

  undo() {
    this.#arrive(this.#keep.undo());
  }

  redo() {
    this.#arrive(this.#keep.redo());
  }

  /** Goes to the frame whose edit was undone. @param {number | null} there */
  #arrive(there) {
    if (there === null) return;
    if (there !== this.#frame) this.#onFrame(there);
    this.#chosen = -1;
    this.#show();
  }

  /** Closes the innermost thing. @returns {boolean} false if there was nothing to leave */
  leave() {
    if (!this.active || (!this.#drawing && this.#chosen < 0)) return false;
    this.#chosen = -1;
    this.#setDrawing(false);
    return true;
  }

  /** The server is connected, perhaps again. */
  setWelcome() {
    this.#keep.retry();
  }

  /** Tags of all frames. @param {string[]} names */
  suggest(names) {
    this.#tags.suggest(names);
  }

  #show() {
    if (!this.active || !this.#state) return this.#overlay.set(null);
    const said = this.#keep.of(this.#frame);
    const [lines, editable, proposed] = [this.#lines, this.#editable, said.lines === null];
    const { status } = this.#keep;
    if (!lines[this.#chosen]) this.#chosen = -1;
    const [chosen, cut, drawing, sweep] = [this.#chosen, this.#cut, this.#drawing, this.#sweep.now];
    this.#status.set(status, this.#state.labels, !proposed || said.tags.length > 0 || said.note !== "");
    this.#tags.set(said, editable);
    this.#tools.setPast(status.canUndo, status.canRedo);
    this.#tools.set(editable, chosen >= 0 && sweep !== null, proposed, drawing);
    setText(this.#message, editable ? this.#hint(lines.length, proposed, this.#state.camera) : "");
    this.#list.set(lines, chosen, sweep);
    this.#overlay.set({ lines, chosen, cut, proposed: proposed && this.#dragged === null, sweep, drawing });
    if (this.#state.labels !== null) this.#sweep.need(this.#state);
    return undefined;
  }

  /** @param {number} lines @param {boolean} proposed @param {"plan" | "free"} camera */
  #hint(lines, proposed, camera) {
    const { plan, drawing, proposed: proposes, hint, none } = this.#text;
    if (camera === "free") return plan;
    if (this.#drawing) return drawing;
    if (proposed) return proposes(lines);
    return lines ? hint : none;
  }

  /** @param {State} state */
  setState(state) {
    const before = this.#state;
    const other = !before || state.frame !== before.frame || state.place !== before.place;
    // Typed text belongs to the frame that was shown while typing.
    if (other) this.#tags.commit();
    const changed = this.#keep.setState(state);
    if (other || changed) [this.#dragged, this.#chosen] = [null, -1];
    this.#state = state;
    this.#show();
  }
}
