// @ts-check
// The socket for long work. Requests of each kind are numbered; answers to older requests are dropped.

/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").Job} Kind */
/** @typedef {import("../wire.js").Measure} Measure */
/** @typedef {import("../wire.js").Answer} Answer */

const RETRY_MS = 2000;

export class Workbench {
  /** @type {WebSocket | null} */ #socket = null;
  /** @type {Map<Kind, {job: number, wish: object | null}>} */ #latest = new Map();
  #url;
  #onAnswer;
  #onMeasures;
  #job = 0;

  /**
   * @param {() => string | null} url null while there is no session yet
   * @param {{onAnswer: (answer: Answer) => void, onMeasures: (measures: Measure[]) => void}} handlers
   */
  constructor(url, { onAnswer, onMeasures }) {
    this.#url = url;
    this.#onAnswer = onAnswer;
    this.#onMeasures = onMeasures;
  }

  /** Starts work of a kind and stops earlier work of this kind. @param {Kind} kind @param {object} wish */
  ask(kind, wish) {
    const job = ++this.#job;
    const full = { type: kind, job, ...wish };
    this.#latest.set(kind, { job, wish: full });
    this.#post(full);
  }

  /** Whether work of this kind is under way. @param {Kind} kind */
  has(kind) {
    return Boolean(this.#latest.get(kind)?.wish);
  }

  /** @param {Kind} kind */
  stop(kind) {
    this.#post({ type: "stop", what: kind });
  }

  /** @param {object} message */
  #post(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
    else this.connect();
  }

  /** Connects, if there is a session and no connection yet. */
  connect() {
    const url = this.#url();
    if (this.#socket || !url) return;
    const socket = new WebSocket(url);
    this.#socket = socket;
    socket.onopen = () => {
      for (const { wish } of this.#latest.values()) if (wish) socket.send(JSON.stringify(wish));
    };
    socket.onmessage = ({ data }) => this.#receive(JSON.parse(data));
    socket.onclose = () => {
      this.#socket = null;
      if ([...this.#latest.values()].some(({ wish }) => wish)) setTimeout(() => this.connect(), RETRY_MS);
    };
  }

  /** @param {any} answer */
  #receive(answer) {
    if (answer.type === "measures") return this.#onMeasures(answer.measures);
    if (answer.type === "error") {
      // Refused before it started, so it belongs to the latest request.
      const open = [...this.#latest]
        .filter(([, { wish }]) => wish)
        .sort(([, one], [, other]) => other.job - one.job)[0];
      if (open) this.#receive({ type: open[0], job: open[1].job, done: true, message: answer.message });
      return undefined;
    }
    const latest = this.#latest.get(answer.type);
    if (!latest || answer.job !== latest.job) return undefined;
    if (answer.done) latest.wish = null;
    return this.#onAnswer(answer);
  }
}
