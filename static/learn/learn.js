// @ts-check
// Mode Learn: one frame, decision by decision, in words, pseudocode, formulas and charts.
import { createOverlay } from "../stage/overlay.js";
import { h, setText } from "../widgets/dom.js";
import { algorithmOf, blockOf } from "./blocks.js";
import { createCharts } from "./charts.js";
import { fetchInto } from "./fetched.js";
import { Diagram } from "./diagram.js";
import { Glossary } from "./glossary.js";
import { createFormulas } from "./formulas.js";
import { termAt } from "./hit.js";
import { Ladder } from "./ladder.js";
import { Lessons } from "./lessons.js";
import { Listing } from "./listing.js";
import { shapeOf } from "./shapes.js";
import { shapeOfQuestion } from "./question.js";
import { boxOnStage, openMaking } from "./make_lesson.js";
import { createPredict } from "./predict.js";
import { SplitListing } from "./split_listing.js";
import { Stepper } from "./stepper.js";
import { Trace } from "./trace.js";
import { trailOf } from "./trail.js";
import { compared, variables } from "./values.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../view/store.js").Patch} Patch */
/** @typedef {import("./trace.js").Event} Event */
/** @typedef {{project: (x: number, y: number) => [number, number] | null, onMove: (listener: () => void) => void,
 *            onHover: (listener: (at: [number, number] | null) => void) => void, fit: (box: import("../wire.js").Box) => void}} PlanView */
/** @typedef {{stage: HTMLElement, view: PlanView, dock: HTMLElement, panel: HTMLElement}} Places */
/** @typedef {{tune: typeof import("../text/page.js").pageText.tune, learn: typeof import("../text/learn.js").learnText, shown: typeof import("../text/shown.js").shownText}} Words */
/** @typedef {{onChange: (patch: Patch, gesture?: string | null) => void,
 *            onDraw: () => void, onMissing?: (id: string) => void, closeUp: {toggle: () => void, ask: (asked: boolean) => void}, settled: () => boolean, session: () => string, stored?: boolean}} Handlers stored: whether the page stands alone */

const VIEWS = /** @type {const} */ (["step", "all"]);

/** @param {Places} places @param {Words} words @param {Handlers} handlers */
export function mountLearn(places, words, handlers) {
  return new Learn(places, words, handlers);
}

class Learn {
  #text;
  #view;
  #dock;
  #handlers;
  /** @type {Trace | null} */ #trace = null;
  /** @type {number | null} */ #step = null;
  /** @type {import("../wire.js").Params} */ #params = {};
  /** @type {import("../wire.js").Knob[]} */ #knobs = [];
  /** Whether the method is region growing, which pseudocode, formulas and charts belong to. */ #own = true;
  #overlay;
  #formulas;
  #charts;
  #ladder;
  #predict;
  #trail;
  #views;
  #lessons;
  #glossary;
  /** @type {Listing | null} */ #listing = null;
  /** The lesson that the listing was opened for. */ #listed = "";
  #listingPlace = h("div", { class: "listing-place" });
  #splitting;
  #diagram;
  #panel;
  #stage;
  /** Whether the block diagram with its lessons is wanted, rather than the replay of a decision. */ #overview = true;
  #other = h("p", { class: "hint other-method", hidden: true });

  /** @param {Places} places @param {Words} words @param {Handlers} handlers */
  constructor({ stage, view, dock, panel }, words, handlers) {
    const text = words.learn;
    const { onChange, settled, session } = handlers;
    this.#text = text;
    this.#view = view;
    this.#stage = stage;
    this.#dock = dock;
    this.#handlers = handlers;
    this.#splitting = new SplitListing(text.listing);
    this.#overlay = createOverlay(stage, view);
    this.#formulas = createFormulas(text.formulas, (term) => this.#showTerm(term));
    view.onHover((at) => this.#lightTerm(at));
    this.#charts = createCharts(
      text.charts,
      (beam) => this.#showBeam(beam),
      (beam) => this.#choose(beam),
    );
    const onGo = (/** @type {number | null} */ step) => this.stepper.go(step);
    this.#ladder = new Ladder(text.ladder, {
      session,
      onGo,
      onParams: (params, gesture) => onChange({ params }, gesture),
    });
    this.#predict = createPredict(text.predict, {
      onAnswer: (event, right) => this.#answered(event, right),
      onToggle: () => {
        this.stepper.say(null);
        this.#show();
      },
    });
    this.#trail = switchButton(text.views.trail, () => this.#show());
    this.#trail.title = text.views.trailHelp;
    this.#views = new Map(VIEWS.map((name) => [name, switchButton(text.views[name], () => this.#chooseView(name))]));
    const views = h("span", { class: "chips", role: "group", "aria-label": text.views.label }, ...this.#views.values());
    this.#glossary = new Glossary(text.glossary, (id, page) => this.#lessons.open(id, page));
    this.stepper = new Stepper(dock, text, {
      mark: (words) => this.#glossary.page()(words),
      onStep: (step) => onChange({ step }),
      onBeam: (beam) => this.#choose(beam),
      onCloseUp: handlers.closeUp.toggle,
      settled,
      mayStep: (next) => this.#mayStep(next),
      answers: this.#predict.buttons,
      extras: [views, this.#trail, this.#predict.toggle, this.#predict.score],
    });
    const project = (/** @type {number} */ x, /** @type {number} */ y) => view.project(x, y);
    const box = () => (this.#event ? null : boxOnStage(project, stage));
    const onMake = () => openMaking(text.making, { session, box, onMade: (lessons) => this.takeLessons(lessons) });
    const onLeft = () => this.#showOverview();
    // A lesson that a link names may come after the View.
    const onRead = () => this.#arrange();
    this.#lessons = new Lessons(words, this.#glossary, { ...handlers, onGo, onMake, onLeft, onRead });
    this.#panel = panel;
    panel.setAttribute("aria-label", text.panel);
    const replay = h(
      "div",
      { class: "lesson-head replay-head" },
      h("h2", { class: "lesson-title" }, text.replay),
      ...this.#glossary.buttons(),
      h("button", { type: "button", class: "button quiet to-overview", onclick: onLeft }, text.lesson.all),
    );
    const method = h(
      "div",
      { class: "method" },
      this.#lessons.showing.element,
      this.#other,
      this.#splitting.element,
      this.#listingPlace,
      this.#formulas.element,
    );
    this.#diagram = new Diagram(text.diagram, (id) => this.#lessons.open(id));
    panel.append(this.#diagram.element, replay, this.#lessons.element, method);
    dock.append(this.#charts.element, this.#ladder.element);
    this.#chooseView("step");
    this.#fetchListing();
  }

  #fetchListing() {
    fetchInto(
      this.#listingPlace,
      new URL("./listing.json", import.meta.url).href,
      this.#text.listing,
      (/** @type {{algorithms: import("./listing.js").Algorithm[]}} */ { algorithms }) => {
        this.#listing = new Listing(algorithms, this.#text.listing);
        this.#listingPlace.append(this.#listing.element);
        this.#show();
      },
    );
  }

  /** One step, or all of them. @param {"step" | "all"} name */
  #chooseView(name) {
    for (const [each, button] of this.#views) button.setAttribute("aria-pressed", String(each === name));
    this.#charts.element.hidden = !this.#own || name === "all";
    this.#ladder.show(this.#own && name === "all");
  }

  /** @returns {Event | null} the decision that is shown */
  get #event() {
    return this.#step !== null && this.#trace && this.#step < this.#trace.length ? this.#trace.at(this.#step) : null;
  }

  /** @param {string | null} term of a formula, shown in the scene */
  #showTerm(term) {
    const event = this.#event;
    this.#overlay.set("term", term && this.#trace && event ? shapeOf(term, event, this.#trace) : null);
  }

  /** Highlights the term under the pointer in the scene. @param {[number, number] | null} at */
  #lightTerm(at) {
    const event = this.#own ? this.#event : null;
    const { names } = this.#formulas;
    const project = (/** @type {number} */ x, /** @type {number} */ y) => this.#view.project(x, y);
    this.#formulas.light(at && this.#trace && event ? termAt(at, names, event, this.#trace, project) : null);
  }

  /** @param {number | null} beam */
  #showBeam(beam) {
    const at = beam === null ? null : this.#trace?.point(beam);
    this.#overlay.set("beam", at ? { dots: [at], lines: [[[0, 0], at]] } : null);
  }

  /** Makes a step wait for the answer to its question. @param {number} next */
  #mayStep(next) {
    const trace = this.#trace;
    if (!trace || !this.#own || !this.#predict.on) return true;
    if (this.#predict.asked?.index === next) return false;
    const event = trace.at(next);
    const question = this.#predict.ask(event);
    if (!question) return true;
    this.stepper.say(question);
    this.#dock.classList.add("asking");
    this.#handlers.closeUp.ask(true);
    this.#overlay.set("question", shapeOfQuestion(event, trace, this.#params));
    return false;
  }

  /** @param {Event} event @param {boolean} right */
  #answered(event, right) {
    const { predict } = this.#text;
    this.stepper.go(event.index);
    this.stepper.say(`${right ? predict.right : predict.wrong} ${event.text}`);
  }

  /** Goes to the next decision about a beam; after the last, to the first. @param {number} beam */
  #runTo(beam) {
    if (!this.#trace) return;
    const next = this.#trace.nextAbout(beam, this.#step ?? -1);
    const there = next >= 0 ? next : this.#trace.nextAbout(beam, -1);
    if (there < 0) return;
    this.stepper.stop();
    this.stepper.go(there);
  }

  /** The same as a click on its point in the scene. @param {number} beam */
  #choose(beam) {
    this.#handlers.onChange({ selected: beam });
    this.#runTo(beam);
  }

  #show() {
    const event = this.#event;
    const explained = this.#own ? event : null;
    const trailing = this.#trail.getAttribute("aria-pressed") === "true";
    const { asked } = this.#predict;
    this.#overlay.set("term", null);
    this.#overlay.set("trail", trailing && explained && this.#trace ? trailOf(this.#trace, explained) : null);
    if (asked && asked.index !== (this.#step ?? -2) + 1) this.#predict.drop();
    if (!this.#predict.asked && this.#overlay.has("question")) {
      this.#overlay.set("question", null);
      this.#handlers.closeUp.ask(false);
    }
    this.#dock.classList.toggle("asking", this.#predict.asked !== null);
    this.#formulas.set(explained, this.#trace, this.#params, this.#knobs);
    this.#charts.set(explained, this.#trace, this.#params);
    this.#arrange();
    this.#splitting.light(event?.kind ?? "");
    this.#listing?.set(
      explained,
      event ? variables(event) : [],
      event ? compared(event, this.#knobs) : "",
      !this.#lessons.showing.active,
      this.#params,
    );
    this.#openListing();
  }

  /** A lesson begins with the algorithm that it is about. */
  #openListing() {
    const { lesson } = this.#lessons;
    if (!this.#listing || this.#listed === (lesson?.id ?? "")) return;
    this.#listed = lesson?.id ?? "";
    if (lesson && !this.#event) this.#listing.open(algorithmOf(lesson.block));
  }

  #showOverview() {
    this.#overview = true;
    this.#show();
  }

  /** A lesson, the replay of a decision, or the diagram with all lessons. */
  #arrange() {
    const { lesson } = this.#lessons;
    const overview = this.#overview && !this.#handlers.stored;
    this.#panel.dataset.shows = lesson ? "lesson" : overview ? "overview" : "replay";
    const event = this.#own ? this.#event : null;
    const lit = this.#own ? blockOf(event) : null;
    const about = lesson?.block === "methods" ? "segments" : lesson?.block;
    this.#diagram.light(event ? lit : (about ?? lit));
    this.#lessons.light(lit);
    this.#hideBefore();
  }

  /** Under the words of a lesson nothing else is shown than what they are about. */
  #hideBefore() {
    this.#stage.classList.toggle("before-lesson", this.#lessons.waiting);
  }

  /** Lessons of the user. @param {import("./lessons.js").Lesson[]} lessons */
  takeLessons(lessons) {
    this.#lessons.take(lessons);
  }

  /** How many lessons are done. */
  get done() {
    return this.#lessons.done;
  }

  /** Saves what was answered in lessons as a file. */
  saveProgress() {
    this.#lessons.saveProgress();
  }

  /** @param {string} text of a file that was saved so */
  readProgress(text) {
    this.#handlers.onChange({ mode: "learn" });
    this.#lessons.readProgress(text);
  }

  /** Opens a lesson at its first page. @param {string} id */
  openLesson(id) {
    this.#lessons.open(id);
  }

  /** @param {boolean} yes */
  answer(yes) {
    this.#predict.answer(yes);
  }

  /** @param {import("./trace.js").Columns} columns */
  setTrace(columns) {
    this.#trace = new Trace(columns);
    this.#predict.drop();
    this.stepper.setTrace(this.#trace);
    this.#ladder.setTrace(this.#trace);
    this.#show();
  }

  /** @param {Readonly<View>} view */
  setView(view) {
    // Whoever steps wants to see the decisions.
    if (view.step !== this.#step) this.#overview = view.step === null;
    this.#step = view.step;
    this.#params = view.params;
    this.#lessons.setView(view);
    if (view.mode !== "learn") return this.stepper.stop();
    this.stepper.setStep(view.step);
    this.stepper.setCloseUp(view.closeup === "on");
    return this.#show();
  }

  /** @param {import("../wire.js").Method} method the chosen one @param {import("../wire.js").Method[]} methods the lessons are about the first */
  setMethod(method, [{ knobs }]) {
    this.#knobs = knobs;
    this.#own = method.knobs === knobs;
    this.#listingPlace.hidden = this.#formulas.element.hidden = !this.#own;
    this.#other.hidden = this.#own;
    this.#splitting.setMethod(method.name, method.label);
    setText(this.#other, this.#text.otherMethod(method.label, method.citation));
    const { toggle, score } = this.#predict;
    for (const part of [...this.#views.values(), this.#trail, toggle, score]) part.hidden = !this.#own;
    this.stepper.setMethod(method);
    this.#chooseView("step");
    this.#ladder.setKnobs(knobs);
    this.#lessons.setKnobs(knobs);
  }

  /** @param {State} state @param {"page" | "scene"} origin */
  setState(state, origin) {
    this.stepper.setLines(state.segments.length);
    if (state.mode !== "learn") return;
    this.#ladder.setState(state);
    if (origin === "scene" && state.selected !== null) this.#runTo(state.selected);
    if (this.#trace && this.#handlers.settled()) this.#lessons.settle(state, this.#trace);
    this.#hideBefore();
  }
}

/** @param {string} words @param {() => void} onSwitch */
function switchButton(words, onSwitch) {
  const button = h("button", { type: "button", class: "chip", "aria-pressed": "false" }, words);
  button.addEventListener("click", () => {
    button.setAttribute("aria-pressed", String(button.getAttribute("aria-pressed") !== "true"));
    onSwitch();
  });
  return button;
}
