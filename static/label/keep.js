// @ts-check
// Labels of frames: their undo, and saving them to the file, one edit after the other, without losing any.
import { Book, same } from "./book.js";

/** @typedef {import("./book.js").Said} Said */
/** @typedef {import("./book.js").Answer} Answer */
/** @typedef {{frame: number, before: Said, after: Said, gesture: string | null}} Edit */
/** refused: the server says why; away: it does not answer. @typedef {"saved" | "saving" | "refused" | "away"} Status */

const RETRY_MS = 1500;
const LONGEST_PAST = 500;

export class Keep {
  #onChange;
  #place = "";
  #book = new Book("", {});
  /** One book for each recording that was opened: unsaved labels are kept while another recording is open. @type {Map<string, Book>} */
  #books = new Map();
  /** @type {Edit[]} */ #past = [];
  /** @type {Edit[]} */ #future = [];
  /** @type {Status} */ #status = "saved";
  #message = "";
  /** Labels that were not saved because another tab changed the frame. @type {{frame: number, mine: Said} | null} */
  #conflict = null;
  #busy = false;
  #timer = 0;

  /** @param {{onChange: () => void}} handlers onChange: what is said, or its way into the file, has changed */
  constructor({ onChange }) {
    this.#onChange = onChange;
    addEventListener("beforeunload", (event) => this.#unsaved && event.preventDefault());
  }

  get #unsaved() {
    return [...this.#books.values()].find(({ wanted }) => wanted.size);
  }

  /** @param {number} frame @returns {Said} */
  of(frame) {
    return this.#book.of(frame);
  }

  /** @param {number} frame @param {Said} said */
  #want(frame, said) {
    this.#book.wanted.set(frame, said);
    if (this.#conflict?.frame === frame) this.#conflict = null;
    this.#run();
  }

  /** Saves one frame after the other until all are saved or one fails. */
  async #run() {
    clearTimeout(this.#timer);
    if (this.#busy) return this.#onChange();
    this.#busy = true;
    this.#status = "saving";
    this.#onChange();
    for (let book = this.#unsaved; book && this.#status === "saving"; book = this.#unsaved) {
      const [frame, said] = /** @type {[number, Said]} */ (book.wanted.entries().next().value);
      this.#status = this.#take(book, frame, said, await book.put(frame, said));
    }
    this.#busy = false;
    if (this.#status === "saving") this.#status = "saved";
    if (this.#status === "away") this.#timer = setTimeout(() => this.#run(), RETRY_MS);
    return this.#onChange();
  }

  /** @param {Book} book @param {number} frame @param {Said} said @param {Answer} answer @returns {Status} */
  #take(book, frame, said, { code, body }) {
    const theirs = code === 409 ? body.theirs : null;
    if (code !== 200 && !theirs) {
      this.#message = body.message ?? "";
      return code ? "refused" : "away";
    }
    const mine = /** @type {Said} */ (book.wanted.get(frame));
    const now = theirs ?? body;
    book.known.set(frame, now);
    book.unseen.set(frame, now.revision);
    // If the other version is the same, this edit was saved and only the answer was lost.
    const clash = theirs && !same(theirs, said);
    if (clash || mine === said) book.wanted.delete(frame);
    if (clash && book === this.#book) this.#clashed(frame, mine);
    return "saving";
  }

  /** @param {number} frame @param {Said} mine */
  #clashed(frame, mine) {
    this.#conflict = { frame, mine };
    this.#past = this.#past.filter((edit) => edit.frame !== frame);
    this.#future = this.#future.filter((edit) => edit.frame !== frame);
  }

  /** @param {Edit[]} from @param {Edit[]} to @param {"before" | "after"} back @returns {number | null} the frame that it belongs to */
  #travel(from, to, back) {
    const edit = from.pop();
    if (!edit) return null;
    // An edit is not undone if another tab has changed the frame since.
    if (same(this.of(edit.frame), edit[back === "before" ? "after" : "before"])) {
      to.push(edit);
      this.#want(edit.frame, edit[back]);
    }
    return edit.frame;
  }

  /** @param {number} frame @param {Said} after @param {string | null} [gesture] edits of one gesture are undone together */
  edit(frame, after, gesture = null) {
    const before = this.of(frame);
    if (same(before, after)) return;
    const last = this.#past.at(-1);
    if (gesture !== null && last?.gesture === gesture && last.frame === frame) last.after = after;
    else this.#past = [...this.#past.slice(-LONGEST_PAST), { frame, before, after, gesture }];
    this.#future = [];
    this.#want(frame, after);
  }

  undo() {
    return this.#travel(this.#past, this.#future, "before");
  }

  redo() {
    return this.#travel(this.#future, this.#past, "after");
  }

  /** Another tab changed the frame meanwhile: keeps that version; this tab's version waits for a decision. @param {number} frame @param {Said} mine */
  clash(frame, mine) {
    this.#conflict = { frame, mine };
    this.#onChange();
  }

  /** Saves this tab's version over the other one. */
  insist() {
    if (this.#conflict) this.edit(this.#conflict.frame, this.#conflict.mine);
  }

  /** Tries again to save. */
  retry() {
    if (this.#unsaved && !this.#busy) this.#run();
  }

  get status() {
    return {
      status: this.#status,
      message: this.#message,
      conflict: this.#conflict?.frame ?? null,
      canUndo: this.#past.length > 0,
      canRedo: this.#future.length > 0,
    };
  }

  /** @param {import("../wire.js").State} state @returns {boolean} whether another has changed what is said of the frame */
  setState({ place, recording, readAs, frame, labels }) {
    this.#open(place, recording, readAs);
    if (!labels) return false;
    const before = this.of(frame);
    this.#book.see(frame, labels);
    return !same(before, this.of(frame));
  }

  /** @param {string} place @param {string} recording @param {import("../wire.js").Reading} reading */
  #open(place, recording, reading) {
    if (place === this.#place) return;
    this.#place = place;
    this.#book = this.#books.get(place) ?? new Book(recording, reading);
    this.#books.set(place, this.#book);
    [this.#past, this.#future, this.#conflict] = [[], [], null];
  }
}
