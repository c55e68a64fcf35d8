// @ts-check
// A page that stands alone: the mode Learn over one frame, with everything that the server would say in the file.
import { createThemeButton } from "../bars/theme_button.js";
import { keyboard, showHelp } from "../keys.js";
import { mountLearn } from "../learn/learn.js";
import { CanvasStage } from "../stage/canvas_stage.js";
import { createCloseUp } from "../stage/close_up.js";
import { createKey } from "../stage/key.js";
import { nearestBeam } from "../stage/named.js";
import { createNames } from "../stage/names.js";
import { createOverlay } from "../stage/overlay.js";
import { handoutText as text } from "../text/handout.js";
import { learnText } from "../text/learn.js";
import { pageText } from "../text/page.js";
import { shownText } from "../text/shown.js";
import { createTheme } from "../theme.js";
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { symbols } from "../widgets/symbols.js";
import { toast } from "../widgets/toast.js";
import { setAnswers } from "./answers.js";
import { Pictures } from "./pictures.js";
import { createRanges } from "./ranges.js";
import { Stands } from "./stands.js";
import { unpack } from "./unpack.js";

/** @typedef {import("../wire.js").Handout} Handout */
/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../view/store.js").Patch} Patch */
/** @typedef {[number, number]} Point */

const ZOOM = 1.4;
const REACH_PX = 20;
// As in handout.css.
const NARROW = "(width <= 760px)";

/** @param {string} id */
const place = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

class Page {
  /** @type {Handout} */ #handout;
  #stands;
  #pictures;
  #points;
  /** @type {import("./stands.js").Place} */ #place;
  /** @type {View} */ view;
  /** What close-ups ask for. @type {any} */ drawn = null;
  #shownTrace = /** @type {import("../wire.js").Columns | null} */ (null);
  #origin = /** @type {"page" | "scene"} */ ("page");
  #waiting = false;
  /** Whether it was said that only the result is stored. */ #onlyResult = false;
  #stage;
  #overlay;
  #closeUp;
  #key;
  #learn;
  #ranges;
  #why;
  #back = h("button", { type: "button", class: "button", hidden: true, onclick: () => this.#goBack() }, text.back);
  #dark = false;
  #method = "";

  /** @param {Handout} handout @param {import("./unpack.js").Arrays} arrays */
  constructor(handout, arrays) {
    this.#handout = handout;
    this.#stands = new Stands(handout);
    const { x, y } = handout;
    this.#points = x.map((each, beam) => (each === null ? null : /** @type {Point} */ ([each, y[beam]])));
    this.#pictures = new Pictures(handout, arrays);
    this.#place = this.#stands.first;
    this.view = this.#firstView();
    const holder = place("stage");
    this.#stage = new CanvasStage(holder, pageText.stage, { onPick: (at) => this.#pick(at) });
    this.#key = createKey(holder, pageText.stage.key, this.#stage, () => names.place());
    const names = createNames(holder, this.#stage);
    this.#overlay = createOverlay(holder, this.#stage);
    this.#closeUp = createCloseUp(/** @type {any} */ (this), /** @type {any} */ (this.#stage), {
      whole: this.fit,
      onFraming: names.set,
    });
    this.#why = this.#createWhy();
    holder.append(this.#key.element, this.#createTools(), this.#why.element);
    this.#learn = mountLearn(
      { stage: holder, view: /** @type {any} */ (this.#stage), dock: place("stepper"), panel: place("learn") },
      { tune: pageText.tune, learn: learnText, shown: shownText },
      {
        onChange: (patch) => this.change(patch),
        onDraw: () => {},
        // In a folder of lessons, each is a file.
        onMissing: (id) =>
          handout.index ? (location.href = `${encodeURIComponent(id)}.html`) : toast(text.missing(id)),
        closeUp: this.#closeUp,
        settled: () => !this.#waiting,
        session: () => "",
        stored: true,
      },
    );
    this.#ranges = createRanges(text, pageText.tune, (params) => this.change({ params }));
    this.#settle();
    this.#mountBar();
    this.#listenToKeys();
    this.#tell();
  }

  /** @returns {View} */
  #firstView() {
    const { lesson, frame, step } = this.#handout;
    const asked = new URLSearchParams(location.hash.slice(1));
    const wanted = (/** @type {string} */ name) => Math.max(0, Math.floor(Number(asked.get(name)))) || 0;
    const last = this.#place.stand.trace.kind.length - 1;
    const first = asked.has("step") ? wanted("step") : step;
    return /** @type {any} */ ({
      mode: "learn",
      // The lesson opens itself where its recording is not shown yet.
      recording: lesson ? "" : this.#handout.recording,
      frame,
      method: this.#place.stand.method,
      params: this.#place.params,
      step: lesson || first === null || last < 0 ? null : Math.min(first, last),
      lesson: lesson || null,
      page: wanted("page"),
      selected: null,
      closeup: "on",
      camera: "plan",
    });
  }

  fit = () => this.#stage.fit(this.#handout.box);

  /** Puts the own parts in their places among those of the mode Learn. */
  #settle() {
    const dock = place("stepper");
    const method = /** @type {HTMLElement} */ (document.querySelector(".method"));
    const charts = /** @type {HTMLElement} */ (document.querySelector(".charts"));
    dock.querySelector(".stepper-more")?.prepend(this.#back);
    method.before(this.#ranges.element);
    const narrow = matchMedia(NARROW);
    this.#ranges.element.open = !this.#handout.lesson && !narrow.matches;
    const arrange = () => (narrow.matches ? method : dock).append(charts);
    narrow.addEventListener("change", arrange);
    arrange();
  }

  #createTools() {
    return h(
      "div",
      { class: "stage-tools" },
      iconButton("plus", text.zoomIn, () => this.#stage.zoom(1 / ZOOM)),
      iconButton("minus", text.zoomOut, () => this.#stage.zoom(ZOOM)),
      iconButton("fit", text.fit, this.fit),
    );
  }

  #createWhy() {
    const words = h("p", { class: "decision", role: "status" });
    const element = h(
      "section",
      { class: "explanation handout-why", hidden: true, "aria-label": text.why },
      words,
      iconButton("close", text.close, () => this.change({ selected: null })),
    );
    return { element, words };
  }

  #mountBar() {
    const { title, index, lesson } = this.#handout;
    const theme = createTheme((dark) => {
      this.#dark = dark;
      this.#drawLater();
    });
    this.#dark = theme.show();
    place("topbar").append(
      h("h1", { class: "app-name" }, ...symbols(title)),
      h("span", { class: "spacer" }),
      lesson
        ? h("button", { type: "button", class: "button quiet", onclick: () => this.#learn.saveProgress() }, text.save)
        : "",
      index ? h("a", { class: "button quiet", href: index }, text.index) : "",
      createThemeButton(pageText.top, theme.saved(), theme.set),
      h(
        "button",
        { type: "button", class: "icon-button", "aria-label": pageText.top.help, onclick: () => this.#help() },
        "?",
      ),
    );
  }

  #bindings() {
    const { stepper } = this.#learn;
    const does = text.keys;
    /** @param {string} name */
    const jump = (name) => () => stepper.jump(name);
    return [
      { keys: ["ArrowLeft"], shown: "← →", does: does.step, run: () => stepper.move(-1) },
      { keys: ["ArrowRight"], shown: "", does: "", run: () => stepper.move(1) },
      { keys: ["Home"], shown: "Home End", does: does.ends, run: () => stepper.move(-Infinity) },
      { keys: ["End"], shown: "", does: "", run: () => stepper.move(Infinity) },
      { keys: ["Space"], shown: "␣", does: does.play, run: () => stepper.togglePlay() },
      { keys: ["s"], shown: "S L D", does: does.jumps, run: jump("seed") },
      { keys: ["l"], shown: "", does: "", run: jump("line") },
      { keys: ["d"], shown: "", does: "", run: jump("drop") },
      { keys: ["x"], shown: "X M C", does: does.learnJumps, run: jump("refusal") },
      { keys: ["m"], shown: "", does: "", run: jump("merge") },
      { keys: ["c"], shown: "", does: "", run: jump("cut") },
      { keys: ["z"], shown: "Z", does: does.closeUp, run: this.#closeUp.toggle },
      { keys: ["1"], shown: "1 2", does: does.answer, run: () => this.#learn.answer(true) },
      { keys: ["2"], shown: "", does: "", run: () => this.#learn.answer(false) },
      { keys: ["f"], shown: "F", does: does.fit, run: this.fit },
      { keys: ["Escape"], shown: "Esc", does: does.escape, run: () => this.#leave() },
      { keys: ["?"], shown: "?", does: does.help, run: () => this.#help() },
    ];
  }

  #listenToKeys() {
    addEventListener("keydown", keyboard(this.#bindings()));
  }

  #help() {
    showHelp(this.#bindings(), { ...pageText, help: { ...pageText.help, mouse: text.mouse } });
  }

  #leave() {
    if (this.view.selected !== null) this.change({ selected: null });
    else this.#learn.stepper.leave();
  }

  /** To the thresholds whose decisions are stored. */
  #goBack() {
    this.change({ params: this.#place.stand.params });
  }

  /** @param {[number, number]} at of the plan */
  #pick(at) {
    const spot = this.#stage.project(...at);
    const beam =
      spot && nearestBeam(/** @type {any} */ ({ points: this.#points }), spot, this.#stage.project, REACH_PX);
    this.#origin = "scene";
    this.change({ selected: beam });
  }

  /** @param {Patch} patch */
  change(patch) {
    if (patch.lesson === null) return this.#finish();
    const method = patch.method ?? this.view.method;
    const params = { ...(method === this.view.method ? this.view.params : this.#defaultsOf(method)), ...patch.params };
    const next = this.#stands.nearest(method, params, this.#place);
    const moved = next.stand !== this.#place.stand || next.result !== this.#place.result;
    this.#place = next;
    this.view = /** @type {View} */ ({
      ...this.view,
      ...patch,
      method: next.stand.method,
      params: next.params,
      step: patch.step !== undefined ? patch.step : moved ? null : this.view.step,
    });
    if (!next.whole) this.view = { ...this.view, step: null };
    this.#tell();
    return undefined;
  }

  /** After the last page of a lesson. */
  #finish() {
    const { next, index, lesson } = this.#handout;
    if (next || index) location.href = next || index;
    else this.#learn.openLesson(lesson);
  }

  /** @param {string} method */
  #defaultsOf(method) {
    return Object.fromEntries(this.#knobsOf(method).map((knob) => [knob.name, knob.default]));
  }

  /** @param {string} method */
  #knobsOf(method) {
    return this.#methods.find(({ name }) => name === method)?.knobs ?? [];
  }

  get #methods() {
    return /** @type {import("../wire.js").Method[]} */ (/** @type {unknown} */ (this.#handout.methods));
  }

  #tell() {
    this.#drawLater();
    this.#showMethod();
    this.#learn.setView(this.view);
  }

  #showMethod() {
    if (this.#method === this.view.method) return;
    this.#method = this.view.method;
    const method = this.#methods.find(({ name }) => name === this.#method);
    if (method) this.#learn.setMethod(method, this.#methods);
  }

  /** As an answer of the server would come: after all that is under way. */
  #drawLater() {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      this.#draw();
    });
  }

  #draw() {
    const { step, selected } = this.view;
    const { stand, result, whole } = this.#place;
    const { moment, segments } = this.#handout.results[result];
    const picture = this.#pictures.at(step === null ? moment : stand.first + step, this.#dark);
    this.#stage.show(picture);
    const state = {
      ...this.view,
      segments: segments.map((number) => this.#handout.segments[number]),
      framing: this.#framing(step),
      place: this.#handout.recording,
      steps: whole ? stand.trace.kind.length : 0,
      ahead: step === null ? null : this.#ahead(step + 1),
      nodes: picture.nodes.map(({ name }) => name),
    };
    this.drawn = state;
    this.#closeUp.set(state);
    this.#key.setState(/** @type {any} */ (state));
    this.#explain(selected);
    this.#ranges.set(this.#place, this.#knobsOf(stand.method));
    this.#back.hidden = whole;
    const trace = this.#stands.columnsOf(this.#place);
    if (trace !== this.#shownTrace) {
      this.#shownTrace = trace;
      this.#learn.setTrace(trace);
    }
    const origin = this.#origin;
    this.#origin = "page";
    this.#learn.setState(/** @type {any} */ (state), origin);
    if (!whole) this.#learn.stepper.say(text.resultOnly(segments.length));
    else if (this.#onlyResult) this.#learn.stepper.say(null);
    this.#onlyResult = !whole;
    document.documentElement.dataset.drawn = JSON.stringify([stand.method, this.#place.params, step, segments.length]);
  }

  /** @param {number | null} step */
  #framing(step) {
    if (this.view.closeup === "off") return null;
    if (step !== null) return this.#place.stand.framings[step]?.framing ?? null;
    return this.#handout.pages[this.view.page] ?? null;
  }

  /** The view of the next decision without what would answer a question about it. @param {number} step */
  #ahead(step) {
    const framed = this.view.closeup === "off" ? null : this.#place.stand.framings[step];
    if (!framed) return null;
    const { framing, tells } = framed;
    return { ...framing, names: framing.names.filter((_, k) => !tells.includes(k)), measures: [] };
  }

  /** @param {number | null} beam */
  #explain(beam) {
    const at = beam === null ? null : this.#points[beam];
    this.#overlay.set("selected", at ? { dots: [at], lines: [[[0, 0], at]] } : null);
    const why = beam === null || !this.#place.whole ? "" : this.#place.stand.why[beam];
    this.#why.element.hidden = !why;
    if (why) this.#why.words.replaceChildren(...symbols(why.charAt(0).toUpperCase() + why.slice(1)));
  }
}

async function open() {
  const words = place("opening");
  if (!("DecompressionStream" in window)) return setText(words, text.tooOld);
  try {
    const { content, arrays } = await unpack(place("data").textContent ?? "");
    setAnswers(content.answers);
    words.remove();
    new Page(content, arrays);
  } catch (error) {
    setText(words, text.broken);
    console.error(error);
  }
  return undefined;
}
open();
