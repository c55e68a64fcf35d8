// @ts-check
// The numbers of the paper's Table 4 and more, of the frame and of the recording.
import { fetchText } from "../fetch.js";
import { keyOf } from "../view/key.js";
import { h, setText } from "../widgets/dom.js";
import { createFromPoses } from "./from_poses.js";
import { TruthTable } from "./truth_table.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {typeof import("../text/inspect.js").inspectText.truth} Text */
/** @typedef {{sessionId: () => string, answered: () => boolean}} Page */
/** @typedef {{onShow: (shown: boolean) => void, onReference: (reference: "labels" | "wall") => void,
 *            onWalls: (made: boolean) => void}} Handlers  onWalls: makes the truth from poses, or forgets it */

const REST_MS = 300;
const PARTS = /** @type {const} */ (["recording", "method", "params", "judgedBy", "labelled"]);

/** Key of the numbers of the recording. @param {State} state */
function keyOfAll(state) {
  return keyOf({ ...state, labelled: state.judgedBy === "labels" ? state.labels?.stamp : "" }, ...PARTS);
}

/** @param {Text} text @param {Page} page @param {Handlers} handlers */
export function createTruth(text, page, handlers) {
  return new Truth(text, page, handlers);
}

class Truth {
  #text;
  #session;
  #answered;
  /** @type {State | null} */ #state = null;
  /** Key of the last request for numbers of the recording. */ #asked = "";
  #waiting = 0;
  #show;
  #by;
  #table;
  #unlabelled;
  #explained = h("p", { class: "hint" });
  #known;
  #unknown;
  #fromPoses;

  /** @param {Text} text @param {Page} page @param {Handlers} handlers */
  constructor(text, { sessionId, answered }, { onShow, onReference, onWalls }) {
    this.#text = text;
    this.#session = sessionId;
    this.#answered = answered;
    const show = h("input", { type: "checkbox", onchange: () => onShow(show.checked) });
    const by = h("select", {
      class: "select",
      "aria-label": text.judgedBy,
      onchange: () => onReference(/** @type {"labels" | "wall"} */ (by.value)),
    });
    this.#show = show;
    this.#by = by;
    this.#table = new TruthTable(text);
    this.#unlabelled = h("p", { class: "hint" }, text.unlabelled);
    this.#known = h(
      "div",
      {},
      h("label", { class: "truth-by" }, text.judgedBy, by),
      this.#unlabelled,
      h("label", { class: "truth-show" }, show, text.show),
      h(
        "p",
        { class: "verdict-keys muted" },
        verdictKey("matched", text.matched),
        verdictKey("false", text.false),
        verdictKey("missed", text.missed),
        verdictKey("neither", text.neither),
      ),
      this.#table.element,
      this.#explained,
    );
    this.#unknown = h("p", { class: "hint" }, text.unknown);
    this.#fromPoses = createFromPoses(text.fromPoses, onWalls);
    const { element } = this.#fromPoses;
    this.element = h("div", { class: "truth", "aria-label": text.label }, this.#known, this.#unknown, element);
    new MutationObserver(() => this.#askSoon()).observe(this.element, { attributeFilter: ["hidden"] });
  }

  #askSoon() {
    if (!this.#state?.judgedBy || this.#state.mode !== "inspect" || this.element.hidden) return;
    const key = keyOfAll(this.#state);
    if (key === this.#asked) return;
    this.#asked = key;
    this.#table.fill("all", null);
    this.#wait();
  }

  #wait() {
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => this.#ask(), REST_MS);
  }

  /** Requests the numbers of the recording. */
  async #ask() {
    // A change that is under way may remove the truth, or have removed it.
    if (!this.#answered()) return this.#wait();
    if (!this.#state?.judgedBy) {
      this.#asked = "";
      return;
    }
    const query = new URLSearchParams({ session: this.#session() });
    const { words, trouble } = await fetchText(`/api/truth?${query}`);
    if (trouble) return;
    const answer = /** @type {import("../wire.js").Truth} */ (JSON.parse(words));
    // The answer may belong to an earlier state; then the next one is on its way or is requested again.
    if (keyOf(answer, ...PARTS) !== this.#asked) {
      if (this.#state && this.#asked === keyOfAll(this.#state)) this.#wait();
      return;
    }
    const { sampled, labelled, all } = this.#text;
    const whole = answer.judgedBy === "labels" ? labelled : all;
    this.#table.nameAll(answer.stride > 1 ? sampled(answer.stride) : whole);
    this.#table.fill("all", answer.agreement);
  }

  /** @param {import("../wire.js").Refused} refused @param {string} why */
  setRefused(refused, why) {
    this.#fromPoses.setRefused(refused, why);
  }

  /** @param {State} state */
  setState(state) {
    const { layers, judgedBy, references, agreement, byViews } = state;
    this.#state = state;
    this.#show.checked = layers.verdicts;
    this.#known.hidden = judgedBy === "";
    this.#unknown.hidden = judgedBy !== "";
    this.#by.replaceChildren(
      ...references.map((name) => h("option", { value: name }, this.#text.reference(name, byViews !== ""))),
    );
    this.#by.value = judgedBy;
    this.#by.disabled = references.length < 2;
    this.#unlabelled.hidden = judgedBy !== "labels" || agreement !== null;
    if (judgedBy) setText(this.#explained, `${this.#text.matching} ${this.#text.explain(judgedBy, byViews !== "")}`);
    this.#table.fill("frame", agreement ?? {});
    this.#fromPoses.setState(state);
    this.#askSoon();
  }
}

/** @param {string} name @param {string} label */
function verdictKey(name, label) {
  return h("span", { class: "verdict-key" }, h("span", { class: `verdict ${name}` }), label);
}
