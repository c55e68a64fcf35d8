// @ts-check
// What the parts of this tab share: its View, its session, the last drawn state, and the calls that inform every part.
import { tell } from "./parts.js";
import { overlaid, usualScore } from "./view/fields.js";
import { isIn } from "./view/key.js";
import { Link } from "./view/link.js";
import { keepSessionOnLeave, takeSession } from "./view/session.js";
import { Store } from "./view/store.js";

/** @typedef {import("./parts.js").Part} Part */
/** @typedef {import("./wire.js").Method} Method */
/** @typedef {import("./wire.js").Params} Params */
/** @typedef {import("./wire.js").State} State */

export class Page {
  store = new Store();
  session = takeSession();
  /** @type {Link | null} */
  link = null;
  /** The first message of the server. @type {import("./wire.js").Welcome | null} */
  welcome = null;
  /** The last drawn state. @type {State | null} */
  drawn = null;
  /** In the order in which they are informed. @type {Part[]} */
  parts = [];
  #method = "";

  constructor() {
    this.store.onChange((view, patch, linked) => {
      if (patch) this.link?.send(patch, linked);
      this.showMethod();
      const { canUndo, canRedo } = this.store;
      this.tell("setView", view, { patch, canUndo, canRedo });
    });
  }

  /**
   * @param {ConstructorParameters<typeof Link>[1]["onMessage"]} onMessage
   * @param {{readonly presenter: string | null}} following the presenter that this tab mirrors
   */
  connect(onMessage, following) {
    const { session } = this;
    const link = new Link(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/session`, {
      rev: session.rev,
      hello: (waiting) => ({
        type: "hello",
        session: session.id,
        rev: link.rev,
        view: overlaid(this.view, waiting),
        follow: following.presenter,
      }),
      onMessage,
      onConnection: (connection, reason) => this.tell("setConnection", connection, reason),
    });
    this.link = link;
    keepSessionOnLeave(() => ({ id: session.id, rev: link.rev, hash: this.store.hash }));
  }

  /** @template {keyof Part} Name @param {Name} name @param {Parameters<NonNullable<Part[Name]>>} what */
  tell(name, ...what) {
    tell(this.parts, name, ...what);
  }

  get view() {
    return this.store.view;
  }

  get methods() {
    return this.welcome?.methods ?? [];
  }

  /** The method of this name, or the first one. @param {string} name */
  methodOf(name) {
    return this.methods.find((method) => method.name === name) ?? this.methods[0];
  }

  /** Informs the parts if another method was chosen. */
  showMethod() {
    const { method } = this.view;
    if (method === this.#method || !this.methods.length) return;
    this.#method = method;
    this.tell("setMethod", this.methodOf(method), this.methods);
  }

  /** Takes over the View of the drawn state. */
  adoptDrawn() {
    if (this.drawn) this.store.adopt(this.drawn.view);
  }

  /** The id of the session for requests. */
  sessionId = () => this.session.id ?? "";

  /** Whether every change made in this tab is drawn, or nobody waits for it any more. */
  settled = () => this.link?.settled ?? true;

  /** Whether every change made in this tab is drawn or refused. */
  answered = () => this.link?.answered ?? true;

  get learning() {
    return this.view.mode === "learn";
  }

  get replaying() {
    return this.learning || this.view.step !== null;
  }

  /** @param {import("./view/fields.js").Patch} patch @param {string | null} [gesture] */
  change = (patch, gesture = null) => this.store.change(patch, gesture);

  /** @param {number} frame */
  goToFrame = (frame) => {
    // Another frame has other decisions.
    this.change({ frame, selected: null, step: this.replaying ? 0 : null, live: false });
  };

  /** @param {boolean} on whether the newest frame of a live recording is followed */
  follow = (on) => this.change(on ? { live: true, step: null, selected: null } : { live: false });

  /** @param {import("./wire.js").View["mode"]} mode */
  setMode = (mode) => {
    if (mode === this.view.mode) return;
    // Inspect starts with the most suspicious frames, Learn with the first decision.
    const usual = mode === "inspect" && this.view.score === usualScore(this.view.mode);
    this.change({ mode, step: mode === "learn" ? 0 : null, ...(usual && { score: usualScore(mode) }) });
  };

  /** Opens the initial world for drawing. */
  drawWorld = () => {
    const recording = this.welcome?.recordings.find(({ group }) => group === "Drawn")?.id;
    if (recording) this.change({ recording, step: null });
  };

  /** Whether the View shows a method to this extent. @param {string} method @param {Params} params */
  looksAt(method, params) {
    const view = this.view;
    return method === view.method && isIn(params, view.params);
  }
}
