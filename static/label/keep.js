// @ts-check
// What is said of frames: its undo, and its way into the file, one edit after the other, none lost.

/** @typedef {import("./lines.js").Line} Line */
/** Everything said of a frame; lines null: nobody has said which are true. @typedef {{lines: Line[] | null, tags: string[], note: string}} Said */
/** @typedef {{frame: number, before: Said, after: Said, gesture: string | null}} Edit */
/** refused: the server says why; away: it does not answer. @typedef {"saved" | "saving" | "refused" | "away"} Status */

const RETRY_MS = 1500;
const LONGEST_PAST = 500;
// Browsers take no more along when the page is left.
const KEPT_ALIVE = 60_000;

/** @param {Said} one @param {Said} other */
const same = (one, other) => wordsOf(one) === wordsOf(other);
/** @param {Said} said */
const wordsOf = ({ lines, tags, note }) => JSON.stringify([lines?.map(({ first, last }) => [first, last]), tags, note]);

/** @param {{onChange: () => void}} handlers onChange: what is said, or its way into the file, has changed */
export function createKeep({ onChange }) {
  let book = emptyBook("", null);
  /** Of every recording that was looked at: what could not be saved waits, whatever is looked at meanwhile. @type {Map<string, Book>} */
  const books = new Map();
  /** @type {Edit[]} */
  let past = [];
  /** @type {Edit[]} */
  let future = [];
  /** @type {Status} */
  let status = "saved";
  let message = "";
  /** What was not saved, because another has changed the frame. @type {{frame: number, mine: Said} | null} */
  let conflict = null;
  let busy = false;
  let timer = 0;
  const unsaved = () => [...books.values()].find(({ wanted }) => wanted.size);
  addEventListener("beforeunload", (event) => unsaved() && event.preventDefault());

  /** @param {number} frame @returns {Said} */
  function of(frame) {
    return book.wanted.get(frame) ?? book.known.get(frame) ?? { lines: null, tags: [], note: "" };
  }

  /** @param {number} frame @param {Said} said */
  function want(frame, said) {
    book.wanted.set(frame, said);
    if (conflict?.frame === frame) conflict = null;
    run();
  }

  async function run() {
    clearTimeout(timer);
    if (busy) return onChange();
    busy = true;
    status = "saving";
    onChange();
    for (let of = unsaved(); of && status === "saving"; of = unsaved()) {
      const [frame, said] = /** @type {[number, Said]} */ (of.wanted.entries().next().value);
      status = take(of, frame, said, await put(of, frame, said));
    }
    busy = false;
    if (status === "saving") status = "saved";
    if (status === "away") timer = setTimeout(run, RETRY_MS);
    return onChange();
  }

  /** @param {Book} of @param {number} frame @param {Said} said @param {{code: number, body: any}} answer @returns {Status} */
  function take(of, frame, said, { code, body }) {
    const { known, unseen, wanted } = of;
    const theirs = code === 409 ? body.theirs : null;
    if (code !== 200 && !theirs) {
      message = body.message ?? "";
      return code ? "refused" : "away";
    }
    const mine = /** @type {Said} */ (wanted.get(frame));
    known.set(frame, theirs ?? body);
    unseen.set(frame, (theirs ?? body).revision);
    // An answer that was lost: it had been saved.
    if (!theirs || same(theirs, said)) {
      if (mine === said) wanted.delete(frame);
      return "saving";
    }
    wanted.delete(frame);
    if (of !== book) return "saving";
    conflict = { frame, mine };
    past = past.filter((edit) => edit.frame !== frame);
    future = future.filter((edit) => edit.frame !== frame);
    return "saving";
  }

  /** @param {Edit[]} from @param {Edit[]} to @param {"before" | "after"} back @returns {number | null} the frame that it belongs to */
  function travel(from, to, back) {
    const edit = from.pop();
    if (!edit) return null;
    // What another has changed since is not undone.
    if (same(of(edit.frame), edit[back === "before" ? "after" : "before"])) {
      to.push(edit);
      want(edit.frame, edit[back]);
    }
    return edit.frame;
  }

  return {
    of,
    /** @param {number} frame @param {Said} after @param {string | null} [gesture] edits of one gesture are undone together */
    edit(frame, after, gesture = null) {
      const before = of(frame);
      if (same(before, after)) return;
      const last = past.at(-1);
      if (gesture !== null && last?.gesture === gesture && last.frame === frame) last.after = after;
      else past = [...past.slice(-LONGEST_PAST), { frame, before, after, gesture }];
      future = [];
      want(frame, after);
    },
    undo: () => travel(past, future, "before"),
    redo: () => travel(future, past, "after"),
    /** Another has changed the frame meanwhile: it stays, and mine waits for a word. @param {number} frame @param {Said} mine */
    clash(frame, mine) {
      conflict = { frame, mine };
      onChange();
    },
    /** Mine instead of what another has saved. */
    insist() {
      if (conflict) this.edit(conflict.frame, conflict.mine);
    },
    /** Saves what could not be saved. */
    retry() {
      if (unsaved() && !busy) run();
    },
    get status() {
      return {
        status,
        message,
        conflict: conflict?.frame ?? null,
        canUndo: past.length > 0,
        canRedo: future.length > 0,
      };
    },
    /** @param {import("../wire.js").State} state @returns {boolean} whether another has changed what is said of the frame */
    setState({ recording, topics, topic, frame, labels }) {
      const stream = topics.length > 1 ? topic : null;
      if (book.recording !== recording || book.topic !== stream) {
        const key = `${recording} ${stream}`;
        book = books.get(key) ?? emptyBook(recording, stream);
        books.set(key, book);
        [past, future, conflict] = [[], [], null];
      }
      if (!labels || labels.revision < (book.unseen.get(frame) ?? 0)) return false;
      const before = of(frame);
      book.unseen.delete(frame);
      book.known.set(frame, labels);
      return !same(before, of(frame));
    },
  };
}

/**
 * What is said of one recording. known: as its file has it; wanted: to be saved; unseen: revisions that are saved and
 * were not in a picture yet, for older pictures under way must not bring back what was.
 * @typedef {{recording: string, topic: string | null, known: Map<number, Said & {revision: number}>, wanted: Map<number, Said>, unseen: Map<number, number>}} Book
 */

/** @param {string} recording @param {string | null} topic @returns {Book} */
function emptyBook(recording, topic) {
  return { recording, topic, known: new Map(), wanted: new Map(), unseen: new Map() };
}

/** @param {Book} book @param {number} frame @param {Said} said @returns {Promise<{code: number, body: any}>} code 0: no answer */
async function put({ recording, topic, known }, frame, { lines, tags, note }) {
  const body = JSON.stringify({
    recording,
    topic,
    frame,
    revision: known.get(frame)?.revision ?? 0,
    lines,
    tags,
    note,
  });
  try {
    const response = await fetch("/api/labels", { method: "PUT", body, keepalive: body.length < KEPT_ALIVE });
    return { code: response.status, body: await response.json() };
  } catch {
    return { code: 0, body: {} };
  }
}
