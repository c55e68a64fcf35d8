// @ts-check
// The labels of one recording: as its file has them, and what is still to be saved.

/** @typedef {import("./lines.js").Line} Line */
/** Everything said of a frame; lines null: nobody has said which are true. @typedef {{lines: Line[] | null, tags: string[], note: string}} Said */
/** code 0: no answer. @typedef {{code: number, body: any}} Answer */

// Browsers send no more than this when the page is closed.
const KEPT_ALIVE = 60_000;

/** @param {Said} one @param {Said} other */
export const same = (one, other) => wordsOf(one) === wordsOf(other);
/** @param {Said} said */
const wordsOf = ({ lines, tags, note }) =>
  JSON.stringify([lines?.map(({ first, last }) => [first, last]) ?? null, tags, note]);

export class Book {
  /** As in the file. @type {Map<number, Said & {revision: number}>} */ known = new Map();
  /** Still to be saved. @type {Map<number, Said>} */ wanted = new Map();
  /** Saved revisions that no drawn state has shown yet: an older state still on its way must not bring back old labels. @type {Map<number, number>} */
  unseen = new Map();

  /** @param {string} recording @param {import("../wire.js").Reading} reading how its file is read */
  constructor(recording, reading) {
    this.recording = recording;
    this.reading = reading;
  }

  /** @param {number} frame @returns {Said} */
  of(frame) {
    return this.wanted.get(frame) ?? this.known.get(frame) ?? { lines: null, tags: [], note: "" };
  }

  /** Asks the server to save the labels of a frame. @param {number} frame @param {Said} said @returns {Promise<Answer>} */
  async put(frame, { lines, tags, note }) {
    const { recording, reading, known } = this;
    const revision = known.get(frame)?.revision ?? 0;
    const body = JSON.stringify({ recording, reading, frame, revision, lines, tags, note });
    try {
      const response = await fetch("/api/labels", { method: "PUT", body, keepalive: body.length < KEPT_ALIVE });
      return { code: response.status, body: await response.json() };
    } catch {
      return { code: 0, body: {} };
    }
  }

  /** Takes the labels that the drawn state of a frame contains. @param {number} frame @param {Said & {revision: number}} told */
  see(frame, told) {
    if (told.revision < (this.unseen.get(frame) ?? 0)) return;
    this.unseen.delete(frame);
    this.known.set(frame, told);
  }
}
