// @ts-check
// The WebSocket. At most one change is under way; newer ones replace each other meanwhile, and the last one is always sent.
import { merged } from "./fields.js";
import { messageOf } from "./message.js";
import { markStage } from "./stages.js";

/** @typedef {import("../wire.js").Message} Message */
/** @typedef {import("./fields.js").Patch} Patch */
/** @typedef {"connecting" | "open" | "lost"} Connection */

const FIRST_RETRY_MS = 250;
const SLOWEST_RETRY_MS = 4000;
// A server that lost an answer must not block the page for good.
const PATIENCE_MS = 3000;
// Close codes of the server: this tab was idle too long; too many tabs.
const IDLE = 4001;
const TOO_MANY = 4002;

export class Link {
  /** @type {WebSocket | null} */ #socket = null;
  #url;
  #hello;
  #onMessage;
  #onConnection;
  #rev;
  /** The newest revision that was answered. */
  #heard = -1;
  #retryMs = FIRST_RETRY_MS;
  #retryTimer = 0;
  #welcomed = false;
  #closed = false;
  /** @type {{rev: number, since: number, timer: number} | null} */ #underWay = null;
  /** @type {{patch: Patch, since: number, linked: boolean} | null} */ #waiting = null;

  /**
   * @param {string} url
   * @param {{rev: number, hello: (waiting: Patch) => object, onMessage: (message: Message, latencyMs: number | null) => void,
   *          onConnection: (connection: Connection, reason: string) => void}} options
   *   rev: the last revision of a resumed session; hello: the first message of each connection
   */
  constructor(url, { rev, hello, onMessage, onConnection }) {
    this.#url = url;
    this.#rev = rev;
    this.#hello = hello;
    this.#onMessage = onMessage;
    this.#onConnection = onConnection;
    addEventListener("online", () => this.retry());
    document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && this.retry());
    this.#connect();
  }

  /** The newest revision that was sent. */
  get rev() {
    return this.#rev;
  }

  /** Whether every change made here is drawn. */
  get settled() {
    return this.#underWay === null && this.#waiting === null;
  }

  /** Whether the server has answered every change, however long that took. */
  get answered() {
    return this.settled && this.#heard >= this.#rev;
  }

  /** @param {Patch} patch @param {boolean} [linked] a link says it: the server takes what it can, and tells the rest */
  send(patch, linked = false) {
    const waiting = this.#waiting;
    this.#waiting = waiting
      ? { patch: merged(waiting.patch, patch), since: waiting.since, linked: waiting.linked || linked }
      : { patch, since: performance.now(), linked };
    if (!this.#socket && !this.#retryTimer) this.retry();
    this.#next();
  }

  cancel() {
    this.#post({ type: "cancel" });
  }

  /** Mirrors the tab with this presenter id; null stops mirroring. @param {string | null} id */
  follow(id) {
    this.#post({ type: "follow", id });
  }

  close() {
    this.#closed = true;
    this.#post({ type: "close" });
    this.#socket?.close();
  }

  /** Connects at once instead of after the current pause. */
  retry() {
    if (this.#socket || this.#closed) return;
    clearTimeout(this.#retryTimer);
    this.#retryTimer = 0;
    this.#connect();
  }

  /** @param {object} message */
  #post(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }

  #next() {
    if (!this.#waiting || this.#underWay || !this.#welcomed) return;
    const { patch, since, linked } = this.#waiting;
    this.#waiting = null;
    this.#rev += 1;
    const rev = this.#rev;
    this.#underWay = { rev, since, timer: setTimeout(() => this.#answered(rev), PATIENCE_MS) };
    this.#post({ type: linked ? "link" : "view", rev, patch });
    markStage("changed", rev, since);
    markStage("sent", rev);
  }

  /** @param {number} rev */
  #answered(rev) {
    if (!this.#underWay || rev < this.#underWay.rev) return null;
    const latencyMs = performance.now() - this.#underWay.since;
    clearTimeout(this.#underWay.timer);
    this.#underWay = null;
    this.#next();
    return latencyMs;
  }

  #connect() {
    this.#welcomed = false;
    const socket = new WebSocket(this.#url);
    this.#socket = socket;
    this.#onConnection("connecting", "");
    socket.onopen = () => {
      // hello contains the whole View, including waiting changes.
      if (this.#underWay) clearTimeout(this.#underWay.timer);
      this.#underWay = null;
      const hello = this.#hello(this.#waiting?.patch ?? {});
      this.#waiting = null;
      this.#post(hello);
    };
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => this.#receive(messageOf(event.data));
    socket.onclose = (event) => {
      if (this.#socket !== socket) return;
      this.#socket = null;
      this.#welcomed = false;
      if (this.#closed) return;
      this.#onConnection("lost", event.reason);
      // An idle tab reconnects when someone returns to it.
      if (event.code === IDLE) return;
      if (event.code === TOO_MANY) this.#retryMs = SLOWEST_RETRY_MS;
      this.#retryTimer = setTimeout(() => this.retry(), this.#retryMs * (0.8 + 0.4 * Math.random()));
      this.#retryMs = Math.min(2 * this.#retryMs, SLOWEST_RETRY_MS);
    };
  }

  /** @param {Message} message */
  #receive(message) {
    let latencyMs = null;
    if (message.type === "welcome") {
      this.#retryMs = FIRST_RETRY_MS;
      this.#welcomed = true;
      this.#onConnection("open", "");
    }
    // A long load must not hold back the slider: the server lets the newest view win by itself.
    if (message.type === "loading" && this.#underWay) this.#answered(this.#underWay.rev);
    if (message.type === "drawn" || (message.type === "error" && message.rev !== null)) {
      markStage("answered", message.rev ?? 0);
      this.#heard = Math.max(this.#heard, message.rev ?? 0);
      latencyMs = this.#answered(message.rev ?? 0);
    }
    this.#onMessage(message, latencyMs);
    if (message.type === "welcome") this.#next();
  }
}
