// @ts-check
// A lesson: texts that drive the page, and one task that the page checks. Lessons are data, from /api/lessons.
import { createThreshold } from "../tune/sliders.js";
import { drawText } from "../text/draw.js";
import { h, setText } from "../widgets/dom.js";
import { icon, iconButton } from "../widgets/icon.js";
import { gestureCount } from "../widgets/slider.js";
import { find, missing } from "./goals.js";
import { symbols } from "./symbols.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../view/store.js").Patch} Patch */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./goals.js").Find} Find */
/** @typedef {{text: string, find: Find | null, method: string | null, params: Params, selected: number | null}} LessonStep */
/** @typedef {{text: string, hint: string, done: string, goal: import("./goals.js").Goal, params: Params}} Task */
/**
 * @typedef {object} Lesson
 * @property {string} id
 * @property {string} title
 * @property {string} about
 * @property {string} recording
 * @property {number} frame
 * @property {Params} params
 * @property {string[]} knobs
 * @property {LessonStep[]} steps
 * @property {Task} task
 */

// Every lesson is about this one; a step may show another beside it.
const METHOD = "region-growing";
const DONE_KEY = "lineseg.lessons";

/**
 * @param {{tune: typeof import("../text/page.js").pageText.tune, learn: typeof import("../text/learn.js").learnText}} words
 * @param {{onChange: (patch: Patch, gesture?: string | null) => void, onGo: (step: number | null) => void, onDraw: () => void}} handlers
 */
export function createLessons(words, { onChange, onGo, onDraw }) {
  const text = words.learn.lesson;
  /** @type {Lesson[]} */
  let lessons = [];
  /** @type {Lesson | null} */
  let lesson = null;
  /** Which text is shown; lesson.steps.length: the task. */
  let at = 0;
  /** What is to be shown once the lesson's frame and thresholds are drawn. @type {{find: Find | null} | null} */
  let pending = null;
  let solved = false;
  /** @type {Readonly<View> | null} */
  let view = null;
  /** @type {Knob[]} */
  let knobs = [];
  /** @type {Map<string, ReturnType<typeof createThreshold>>} */
  let sliders = new Map();
  const done = new Set(load());

  const list = h("ol", { class: "lesson-list" });
  const broken = h("div", { class: "panel-error", role: "alert" });
  const trouble = h("div");
  const drawing = h(
    "button",
    { type: "button", class: "lesson-item", onclick: onDraw },
    h("span", { class: "lesson-item-title" }, drawText.open),
    h("span", { class: "muted" }, drawText.openHint),
  );
  const overview = h(
    "div",
    { class: "lesson-overview" },
    h("h2", {}, text.overview),
    h("p", { class: "hint" }, text.overviewHint),
    trouble,
    broken,
    list,
    drawing,
  );
  const title = h("h2", { class: "lesson-title", tabIndex: -1 });
  const close = iconButton("close", text.close, () => leave());
  const body = h("div", { class: "lesson-body", "aria-live": "polite" });
  const places = h("div", { class: "thresholds lesson-knobs" });
  const hint = h("button", { type: "button", class: "button quiet", onclick: () => showHint() }, text.hint);
  const hintWords = h("p", { class: "lesson-hint", role: "status", hidden: true });
  const verdict = h("p", { class: "lesson-verdict", role: "status" });
  const task = h("div", { class: "lesson-task" }, verdict, hintWords);
  const back = h("button", { type: "button", class: "button", onclick: () => turn(at - 1) }, text.back);
  const next = h("button", { type: "button", class: "button primary", onclick: () => forward() }, text.next);
  const count = h("span", { class: "muted" });
  const foot = h("div", { class: "lesson-foot" }, back, count, h("span", { class: "spacer" }), hint, next);
  const reader = h(
    "div",
    { class: "lesson-reader", hidden: true },
    h("div", { class: "lesson-head" }, title, close),
    h("div", { class: "lesson-scroll" }, body, places, task),
    foot,
  );
  const element = h("section", { class: "lesson", "aria-label": text.label }, overview, reader);

  /** @returns {string[]} */
  function load() {
    try {
      return JSON.parse(localStorage.getItem(DONE_KEY) ?? "[]");
    } catch {
      return [];
    }
  }

  function showList() {
    list.replaceChildren(
      ...lessons.map((each) =>
        h(
          "li",
          {},
          h(
            "button",
            { type: "button", class: "lesson-item", "data-lesson": each.id, onclick: () => open(each.id) },
            h(
              "span",
              { class: "lesson-item-title" },
              ...symbols(each.title),
              done.has(each.id) ? icon("check") : null,
              done.has(each.id) ? h("span", { class: "off-screen" }, text.doneMark) : null,
            ),
            h("span", { class: "muted" }, ...symbols(each.about)),
          ),
        ),
      ),
    );
  }

  /** @param {string} id */
  function open(id) {
    const chosen = lessons.find((each) => each.id === id);
    if (!chosen) return broken.append(h("p", {}, text.unknown(id)));
    lesson = chosen;
    overview.hidden = true;
    reader.hidden = false;
    const number = lessons.indexOf(chosen) + 1;
    title.replaceChildren(`${number} · `, ...symbols(chosen.title));
    sliders = new Map(
      knobs
        .filter(({ name }) => chosen.knobs.includes(name))
        .map((knob) => [
          knob.name,
          createThreshold(knob, words.tune, (name, value) =>
            onChange({ params: { [name]: value } }, `${name} ${gestureCount()}`),
          ),
        ]),
    );
    places.replaceChildren(...[...sliders.values()].map((slider) => slider.element));
    address(id);
    turn(0);
    return title.focus();
  }

  function leave() {
    lesson = null;
    pending = null;
    overview.hidden = false;
    reader.hidden = true;
    element.dataset.page = "";
    address(null);
    showList();
  }

  /** The lesson in the address, so that a link opens it. @param {string | null} id */
  function address(id) {
    const url = new URL(location.href);
    if (id) url.searchParams.set("lesson", id);
    else url.searchParams.delete("lesson");
    history.replaceState(null, "", url);
  }

  function forward() {
    if (!lesson) return;
    if (at < lesson.steps.length) return turn(at + 1);
    const following = lessons[lessons.indexOf(lesson) + 1];
    if (following) open(following.id);
    else leave();
  }

  /** @param {number} to */
  function turn(to) {
    if (!lesson || !view) return;
    at = Math.min(Math.max(to, 0), lesson.steps.length);
    const onTask = at === lesson.steps.length;
    const step = onTask ? null : lesson.steps[at];
    const shown = step?.text ?? lesson.task.text;
    body.replaceChildren(
      ...(onTask ? [h("h3", {}, text.task)] : []),
      ...shown.split("\n\n").map((paragraph) => h("p", {}, ...symbols(paragraph))),
    );
    solved = false;
    task.hidden = hint.hidden = !onTask;
    // Elsewhere the sliders would only take room.
    places.hidden = !onTask && !Object.keys(step?.params ?? {}).length;
    element.dataset.page = onTask ? "task" : "step";
    hintWords.hidden = true;
    verdict.className = "lesson-verdict";
    setText(verdict, "");
    setText(count, text.place(at + 1, lesson.steps.length + 1));
    back.disabled = at === 0;
    setText(next, nextWords());
    next.classList.toggle("primary", !onTask);
    reader.querySelector(".lesson-scroll")?.scrollTo(0, 0);
    pending = { find: step?.find ?? null };
    const { method, params } = wanted();
    const elsewhere =
      view.recording !== lesson.recording ||
      view.frame !== lesson.frame ||
      view.method !== method ||
      !same(params, view.params);
    /** @type {Patch} */
    const patch = { method, selected: step?.selected ?? null };
    if (method === METHOD) patch.params = params;
    if (view.recording !== lesson.recording) patch.recording = lesson.recording;
    if (elsewhere) Object.assign(patch, { frame: lesson.frame, step: null });
    // Without a change nothing would be drawn, and so nothing be shown.
    onChange(patch);
  }

  function nextWords() {
    if (!lesson) return text.next;
    if (at < lesson.steps.length) return at === lesson.steps.length - 1 ? text.toTask : text.next;
    return lessons.at(-1) === lesson ? text.finish : text.nextLesson;
  }

  /** Method and thresholds of the present text. @returns {{method: string, params: Params}} */
  function wanted() {
    const usual = Object.fromEntries(knobs.map((knob) => [knob.name, knob.default]));
    const page = lesson?.steps[at] ?? lesson?.task;
    const other = page && "method" in page ? page.method : null;
    return other
      ? { method: other, params: {} }
      : { method: METHOD, params: { ...usual, ...lesson?.params, ...page?.params } };
  }

  function showHint() {
    if (!lesson) return;
    hintWords.replaceChildren(...symbols(lesson.task.hint));
    hintWords.hidden = false;
    hintWords.scrollIntoView({ block: "nearest" });
  }

  return {
    element,
    open,
    /** Where it says that there are no lessons. */
    trouble,
    get current() {
      return lesson?.id ?? null;
    },
    /** @param {{lessons: Lesson[], broken: string[]}} told */
    setLessons(told) {
      lessons = told.lessons;
      broken.replaceChildren(...told.broken.map((why) => h("p", {}, why)));
      showList();
    },
    /** @param {Knob[]} next */
    setKnobs(next) {
      knobs = next;
    },
    /** @param {Readonly<View>} next */
    setView(next) {
      view = next;
      for (const [name, slider] of sliders) if (next.params[name] !== undefined) slider.set(next.params[name]);
    },
    /** @param {State} state drawn, and nothing else under way @param {Trace} trace of it */
    settle(state, trace) {
      if (!lesson || state.recording !== lesson.recording || state.frame !== lesson.frame) return;
      const { method, params } = wanted();
      if (pending && state.method === method && same(params, state.params)) {
        const target = pending.find;
        pending = null;
        const index = target ? find(trace, target) : -1;
        onGo(index >= 0 ? index : null);
      }
      if (pending || at < lesson.steps.length || solved) return;
      const lacks = missing(lesson.task.goal, state, trace, params, state.step, words.learn.goals);
      solved = lacks.length === 0;
      verdict.classList.toggle("solved", solved);
      verdict.replaceChildren(...symbols(solved ? `${text.right} ${lesson.task.done}` : `${text.notYet} ${lacks[0]}`));
      next.classList.toggle("primary", solved);
      if (!solved) return;
      done.add(lesson.id);
      localStorage.setItem(DONE_KEY, JSON.stringify([...done]));
    },
  };
}

/** @param {Params} one @param {Params} other */
function same(one, other) {
  return Object.entries(one).every(([name, value]) => other[name] === value);
}
