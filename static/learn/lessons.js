// @ts-check
// Lessons: texts that control the page, and one task that the page checks. They are data from /api/lessons.
import { Threshold } from "../tune/threshold.js";
import { isIn } from "../view/key.js";
import { h } from "../widgets/dom.js";
import { gestureCount } from "../widgets/slider.js";
import { fetchText } from "../fetch.js";
import { fetchInto } from "./fetched.js";
import { find, missing } from "./goals.js";
import { LessonList } from "./lesson_list.js";
import { Reader } from "./reader.js";
import { Showing } from "./shown.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../view/store.js").Patch} Patch */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("../wire.js").Find} Find */
/** @typedef {import("../wire.js").Step} LessonStep */
/** @typedef {import("../wire.js").NamedLesson} Lesson */
/** @typedef {import("../wire.js").Lessons} Told */
/** @typedef {{onChange: (patch: Patch, gesture?: string | null) => void, onLeft: () => void, onRead: () => void, onGo: (step: number | null) => void, onDraw: () => void, onMake: () => void, onMissing?: (id: string) => void, session: () => string, stored?: boolean}} Handlers */

// Every lesson is about this method; a step may show another for comparison.
const METHOD = "region-growing";

export class Lessons {
  #words;
  #handlers;
  /** @type {Lesson | null} */ #lesson = null;
  /** Index of the shown text; lesson.steps.length means the task. */
  #at = 0;
  /** What is to be shown once the lesson's frame and thresholds are drawn. @type {{find: Find | null} | null} */
  #pending = null;
  #solved = false;
  /** What was set before the lesson, to be given back when it is left. @type {Patch | null} */ #before = null;
  /** Lessons that were asked for by name. @type {Set<string>} */ #fetched = new Set();
  /** @type {Readonly<View> | null} */ #view = null;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Map<string, Threshold>} */ #sliders = new Map();
  /** The last of the states. @type {State | null} */ #drawn = null;
  /** Frames that were labelled in a lesson itself. */ #labelled = 0;
  /** What must have loaded before a link with ?lesson=… is opened. */
  #awaited = new Set(["lessons", "knobs"]);
  /** Whether the list of lessons, or one that a link names, is being fetched. */ #fetching = true;
  /** Whether a lesson was opened whose first picture is not drawn yet. */ #opening = false;
  #list;
  #reader;

  /** @param {import("./learn.js").Words} words @param {import("./glossary.js").Glossary} glossary @param {Handlers} handlers */
  constructor(words, glossary, handlers) {
    this.#words = words;
    this.#handlers = handlers;
    const text = words.learn.lesson;
    this.#list = new LessonList(words.learn, glossary, { ...handlers, onOpen: (id) => this.open(id) });
    this.#reader = new Reader(text, glossary, words.learn.answers, {
      onLeave: () => this.#leave(),
      onBack: () => this.#turn(this.#at - 1),
      onNext: () => this.#forward(),
      onHint: () => this.#lesson && this.#reader.hint(this.#lesson.task.hint),
      onLesson: (id) => this.open(id),
      onAnswer: (solved, why, answer) => this.#answered(solved, why, answer),
    });
    const { session, stored = false } = handlers;
    const onLabel = (/** @type {number} */ labelled) => {
      this.#labelled = labelled;
      const wanted = this.#lesson?.task.goal?.labelled;
      if (wanted && this.#lesson && this.#at === this.#lesson.steps.length) this.#countLabels(wanted, labelled);
    };
    this.showing = new Showing(words.shown, { session, stored, knobs: () => this.#knobs, onLabel });
    this.element = h(
      "section",
      { class: "lesson", "aria-label": text.label },
      this.#list.element,
      this.#reader.element,
    );
    fetchInto(this.#list.trouble, "/api/lessons", text, (/** @type {Told} */ told) => {
      glossary.set(told.terms, told.lessons);
      this.#list.set(told.lessons);
      this.#come("lessons");
    }).then(() => this.#fetch(false));
  }

  /** @param {boolean} under whether something is under way */
  #fetch(under) {
    this.#fetching = under;
    this.#handlers.onRead();
  }

  /** Whether the stage still shows something else than the lesson that the page names. */
  get waiting() {
    const named = this.#view?.mode === "learn" ? this.#view.lesson : null;
    return named !== null && (this.#opening || (this.#fetching && named !== this.#lesson?.id));
  }

  /** @param {string} what */
  #come(what) {
    if (!this.#awaited.delete(what) || this.#awaited.size) return;
    const wanted = new URL(location.href).searchParams.get("lesson");
    if (wanted) {
      const url = new URL(location.href);
      url.searchParams.delete("lesson");
      history.replaceState(null, "", url);
      this.#handlers.onChange({ mode: "learn" });
      this.open(wanted);
    } else if (this.#view) this.#adopt(this.#view);
  }

  /** Opens a lesson. @param {string} id @param {number} [page] */
  open(id, page = 0) {
    const chosen = this.#list.find(id);
    if (!chosen) return this.#miss(id);
    if (!this.#lesson && this.#view) this.#before = settingsOf(this.#view);
    this.#show(chosen);
    this.#turn(page);
    return this.#reader.focus();
  }

  /** A lesson that is not in the list. @param {string} id */
  #miss(id) {
    if (this.#handlers.onMissing) this.#handlers.onMissing(id);
    else this.#list.complain(this.#words.learn.lesson.unknown(id));
  }

  /** @param {Lesson} chosen */
  #show(chosen) {
    this.#lesson = chosen;
    this.#opening = true;
    this.#sliders = new Map(
      this.#knobs
        .filter(({ name }) => chosen.knobs.includes(name))
        .map((knob) => [knob.name, this.#createSlider(knob)]),
    );
    this.#reader.open(
      this.#list.count > 1 ? `${this.#list.numberOf(chosen)} · ${chosen.title}` : chosen.title,
      [...this.#sliders.values()].map((slider) => slider.element),
    );
    this.#handlers.onRead();
  }

  /** Shows the lesson and the page of a View that came from elsewhere: a link, or the presenter. @param {Readonly<View>} view */
  #adopt({ lesson, page, recording }) {
    if (this.#awaited.size || (lesson === (this.#lesson?.id ?? null) && (!lesson || page === this.#at))) return;
    const chosen = lesson ? this.#list.find(lesson) : null;
    if (lesson && !chosen) return this.#fetchDropped(lesson);
    if (!chosen) return this.#close();
    if (chosen !== this.#lesson) this.#show(chosen);
    // A link that names no more than the lesson.
    if (recording !== chosen.recording) return this.#turn(page);
    this.#at = Math.min(page, chosen.steps.length);
    this.#pending = null;
    this.#opening = false;
    this.#read(chosen);
  }

  /** One that was dropped on another page, which a link or the presenter names. @param {string} id */
  #fetchDropped(id) {
    if (this.#fetched.has(id)) return;
    this.#fetched.add(id);
    this.#fetch(true);
    fetchText(`/api/lessons/one?${new URLSearchParams({ id })}`).then(({ words, trouble }) => {
      this.#fetch(false);
      const found = trouble === null ? JSON.parse(words) : null;
      if (!found) return this.#list.complain(trouble ?? this.#words.learn.lesson.unknown(id));
      this.#list.add([found]);
      return this.#view && this.#adopt(this.#view);
    });
  }

  /** Offers lessons of the user, and opens the first. @param {Lesson[]} lessons */
  take(lessons) {
    this.#list.add(lessons);
    this.#handlers.onChange({ mode: "learn" });
    this.open(lessons[0].id);
  }

  /** @param {Knob} knob */
  #createSlider(knob) {
    return new Threshold(knob, this.#words.tune, (name, value) =>
      this.#handlers.onChange({ params: { [name]: value } }, `${name} ${gestureCount()}`),
    );
  }

  #leave() {
    // Whoever has gone elsewhere, by a link or the menu, stays there.
    const back = this.#before && this.#view?.recording === this.#lesson?.recording ? this.#before : {};
    this.#close();
    this.#handlers.onChange({ ...back, lesson: null });
    this.#handlers.onLeft();
  }

  /** The one that is being read. */
  get lesson() {
    return this.#lesson;
  }

  /** Where one is in the method. @param {import("./blocks.js").Block | null} block */
  light(block) {
    this.#list.light(block);
  }

  #close() {
    this.#lesson = null;
    this.#pending = null;
    this.#opening = false;
    this.#before = null;
    this.#reader.close();
    this.showing.turn(null);
    this.element.dataset.page = "";
    this.#list.show();
    this.#handlers.onRead();
  }

  #forward() {
    if (!this.#lesson) return;
    if (this.#at < this.#lesson.steps.length) return this.#turn(this.#at + 1);
    const following = this.#following(this.#lesson);
    if (following) this.open(following.id);
    else this.#leave();
  }

  /** @param {Lesson} lesson @returns {Lesson | undefined} */
  #following(lesson) {
    return this.#list.after(lesson);
  }

  /** @param {number} to */
  #turn(to) {
    if (!this.#lesson || !this.#view) return;
    const { steps } = this.#lesson;
    this.#at = Math.min(Math.max(to, 0), steps.length);
    const step = steps.at(this.#at) ?? null;
    this.#read(this.#lesson);
    this.#pending = { find: step?.find ?? null };
    // Without a change nothing is drawn, so nothing would be shown.
    this.#handlers.onChange(this.#patchFor(this.#lesson, step, this.#view));
  }

  /** Shows the text of the page. @param {Lesson} lesson */
  #read(lesson) {
    const { steps, task } = lesson;
    const step = steps.at(this.#at) ?? null;
    this.#solved = false;
    this.showing.turn((step ?? task).show);
    this.element.dataset.page = step ? "step" : "task";
    this.#reader.show({
      lesson: lesson.id,
      words: step?.text ?? task.text,
      task: step ? null : task,
      // On other pages the sliders would only take up space.
      sliders: !step || Object.keys(step.params).length > 0,
      at: this.#at,
      count: steps.length + 1,
      next: this.#nextWords(lesson),
    });
    // What a link opens may have been drawn before its lesson came.
    if (this.#drawn && isOf(lesson, this.#drawn)) this.showing.set(this.#drawn);
  }

  /** @param {Lesson} lesson @param {LessonStep | null} step @param {Readonly<View>} view @returns {Patch} */
  #patchFor({ id, recording, frame }, step, view) {
    const { method, params } = this.#wanted();
    const elsewhere =
      view.recording !== recording || view.frame !== frame || view.method !== method || !isIn(params, view.params);
    return {
      lesson: id,
      page: this.#at,
      method,
      selected: step?.selected ?? null,
      ...(method === METHOD ? { params } : {}),
      ...(view.recording !== recording ? { recording } : {}),
      ...(elsewhere ? { frame, step: null } : {}),
    };
  }

  /** @param {Lesson} lesson */
  #nextWords(lesson) {
    const text = this.#words.learn.lesson;
    if (this.#at < lesson.steps.length) return this.#at === lesson.steps.length - 1 ? text.toTask : text.next;
    return this.#following(lesson) ? text.nextLesson : text.finish;
  }

  /** Method and thresholds of the current text. @returns {{method: string, params: Params}} */
  #wanted() {
    const usual = Object.fromEntries(this.#knobs.map((knob) => [knob.name, knob.default]));
    const page = this.#lesson?.steps[this.#at] ?? this.#lesson?.task;
    const other = page && "method" in page ? page.method : null;
    return other
      ? { method: other, params: {} }
      : { method: METHOD, params: { ...usual, ...this.#lesson?.params, ...page?.params } };
  }

  /** @param {Knob[]} knobs */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#come("knobs");
  }

  /** @param {Readonly<View>} view */
  setView(view) {
    this.#view = view;
    this.#adopt(view);
    for (const [name, slider] of this.#sliders) if (view.params[name] !== undefined) slider.set(view.params[name]);
  }

  /** @param {State} state drawn, and nothing else under way @param {Trace} trace of it */
  settle(state, trace) {
    const lesson = this.#lesson;
    this.#drawn = state;
    const labelling = lesson?.task.goal?.labelled && this.#at === lesson.steps.length;
    if (lesson && labelling) this.#checkLabels(lesson);
    const opening = this.#opening;
    this.#opening = false;
    if (!lesson || !isOf(lesson, state)) return;
    this.showing.set(state);
    const { method, params } = this.#wanted();
    if (this.#pending && state.method === method && isIn(params, state.params)) {
      const target = this.#pending.find;
      this.#pending = null;
      const index = target ? find(trace, target) : -1;
      const step = index >= 0 ? index : null;
      this.#opening = opening && step !== state.step;
      this.#handlers.onGo(step);
    }
    if (!this.#pending && this.#at === lesson.steps.length && !this.#solved && lesson.task.goal && !labelling)
      this.#check(lesson, state, trace, params);
  }

  /** Whether the task is done; nothing is said before the first attempt. @param {Lesson} lesson @param {State} state @param {Trace} trace @param {Params} start */
  #check(lesson, state, trace, start) {
    const {
      task: { goal, done },
      accepted,
    } = lesson;
    if (!goal) return;
    const { lesson: text, goals } = this.#words.learn;
    const lacks = missing({ goal, accepted }, state, trace, start, this.#knobs, goals);
    this.#solved = lacks.length === 0;
    const untouched = state.step === null && state.selected === null && isIn(start, state.params);
    if (!this.#solved && untouched) return this.#reader.judge(false, "");
    this.#reader.judge(this.#solved, this.#solved ? `${text.right} ${done}` : lacks.slice(0, 2).join(" "));
    if (this.#solved) this.#list.note(lesson, this.#setBy(goal, state, start), true);
  }

  /** What solved a task. @param {import("../wire.js").Goal} goal @param {State} state @param {Params} start */
  #setBy(goal, state, start) {
    const { progress } = this.#words.learn;
    if (goal.changed.length) {
      const changed = this.#knobs.filter(
        ({ name }) => goal.changed.includes(name) && state.params[name] !== start[name],
      );
      return changed.map(({ name, symbol }) => `${symbol} = ${state.params[name]}`).join(", ");
    }
    if (goal.selected.length && state.selected !== null) return progress.beam(state.selected);
    return state.step !== null ? progress.decision(state.step) : "";
  }

  get done() {
    return this.#list.progress.done;
  }

  /** Saves what was answered as a file. */
  saveProgress() {
    this.#list.save();
  }

  /** @param {string} text of a file */
  readProgress(text) {
    this.#list.read(text);
  }

  /** Labels are made in other frames and another mode, so they are counted when someone comes back. @param {Lesson} lesson */
  async #checkLabels(lesson) {
    const wanted = lesson.task.goal?.labelled ?? 0;
    if (this.#handlers.stored) return this.#countLabels(wanted, this.#labelled);
    const query = new URLSearchParams({ recording: lesson.recording });
    const { words, trouble } = await fetchText(`/api/labels?${query}`);
    if (this.#lesson !== lesson || this.#at !== lesson.steps.length || this.#solved) return;
    if (trouble !== null) return this.#reader.judge(false, trouble);
    const told = /** @type {import("../wire.js").LabelsOverview} */ (JSON.parse(words));
    const inFile = Object.values(told.frames).filter(({ lines }) => lines !== null).length;
    return this.#countLabels(wanted, Math.max(inFile, this.#labelled));
  }

  /** @param {number} wanted @param {number} done */
  #countLabels(wanted, done) {
    if (this.#solved) return;
    if (done >= wanted) return this.#answered(true, "", this.#words.learn.progress.labelled(done));
    this.#reader.judge(false, done ? this.#words.learn.goals.labelled(done, wanted) : "");
  }

  /** What was chosen or typed. @param {boolean} solved @param {string} why it is not right, if anyone has said so @param {string} answer */
  #answered(solved, why, answer) {
    const text = this.#words.learn.lesson;
    const lesson = this.#lesson;
    if (!lesson) return;
    this.#solved = solved;
    this.#reader.judge(solved, solved ? `${text.right} ${lesson.task.done}` : why);
    if (answer) this.#list.note(lesson, answer, solved);
  }
}

/** Whether a state shows what a lesson is about. @param {Lesson} lesson @param {State} state */
function isOf({ recording, frame }, state) {
  return state.recording === recording && state.frame === frame;
}

/** What a lesson changes. @param {Readonly<View>} view @returns {Patch} */
function settingsOf({ recording, frame, method, params, step, selected }) {
  return { recording, frame, method, params, step, selected };
}
