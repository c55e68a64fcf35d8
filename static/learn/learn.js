// @ts-check
// Mode Learn: one frame, decision by decision, in words, pseudocode, formulas and charts.
import { h, setText } from "../widgets/dom.js";
import { createCharts } from "./charts.js";
import { createFormulas } from "./formulas.js";
import { createLessons } from "./lesson.js";
import { fetchInto } from "./fetched.js";
import { termAt } from "./hit.js";
import { createLadder } from "./ladder.js";
import { createListing } from "./listing.js";
import { stretch } from "./geometry.js";
import { createOverlay, shapeOf } from "./overlay.js";
import { createPredict } from "./predict.js";
import { mountStepper } from "./stepper.js";
import { Trace } from "./trace.js";
import { compared, variables } from "./values.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").View} View */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../view/store.js").Patch} Patch */
/** @typedef {import("./listing.js").Algorithm} Algorithm */

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {{project: (x: number, y: number) => [number, number] | null, onMove: (listener: () => void) => void,
 *            onHover: (listener: (at: [number, number] | null) => void) => void, fit: (box: import("../wire.js").Box) => void}} PlanView */

/**
 * @param {{stage: HTMLElement, view: PlanView, dock: HTMLElement, panel: HTMLElement}} places
 * @param {{tune: typeof import("../text/page.js").pageText.tune, learn: typeof import("../text/learn.js").learnText}} words
 * @param {{onStep: (step: number | null) => void, onChange: (patch: Patch, gesture?: string | null) => void,
 *          onDraw: () => void, settled: () => boolean, session: () => string}} handlers
 */
export function mountLearn(
  { stage, view: planView, dock, panel },
  words,
  { onStep, onChange, onDraw, settled, session },
) {
  const text = words.learn;
  /** @type {Trace | null} */
  let trace = null;
  /** @type {number | null} */
  let step = null;
  /** @type {ReturnType<typeof createListing> | null} */
  let listing = null;

  /** @type {import("../wire.js").Params} */
  let params = {};

  const overlay = createOverlay(stage, planView);
  const formulas = createFormulas(text.formulas, (term) => {
    const event = present();
    overlay.set("term", term && trace && event ? shapeOf(term, event, trace) : null);
  });
  planView.onHover((at) => {
    const event = own ? present() : null;
    formulas.light(at && trace && event ? termAt(at, formulas.names, event, trace, planView.project) : null);
  });
  const charts = createCharts(text.charts, showBeam, choose);
  const ladder = createLadder(text.ladder, {
    session,
    onGo: (wanted) => stepper.go(wanted),
    onParams: (next, gesture) => onChange({ params: next }, gesture),
  });
  const predict = createPredict(text.predict, { onAnswer: answered, onToggle: () => (stepper.say(null), show()) });
  const trail = switchButton(text.views.trail, () => show());
  trail.title = text.views.trailHelp;
  const views = /** @type {const} */ (["step", "all"]).map((name) =>
    switchButton(text.views[name], () => choosePage(name)),
  );
  const stepper = mountStepper(dock, text, {
    onStep,
    onBeam: choose,
    onZoom: zoom,
    settled,
    mayStep,
    answers: predict.buttons,
    extras: [
      h("span", { class: "chips", role: "group", "aria-label": text.views.label }, ...views),
      trail,
      predict.toggle,
      predict.score,
    ],
  });
  const lessons = createLessons(words, { onChange, onDraw, onGo: (wanted) => stepper.go(wanted) });
  const listingPlace = h("div", { class: "listing-place" });
  const other = h("p", { class: "hint other-method", hidden: true });
  /** Whether the method is the one that pseudocode, formulas and charts are of. */
  let own = true;
  panel.setAttribute("aria-label", text.panel);
  panel.append(lessons.element, h("div", { class: "method" }, other, listingPlace, formulas.element));
  dock.append(charts.element, ladder.element);
  choosePage("step");
  fetchInto(
    listingPlace,
    new URL("./listing.json", import.meta.url).href,
    text.listing,
    (/** @type {{algorithms: Algorithm[]}} */ { algorithms }) => {
      listing = createListing(algorithms, text.listing);
      listingPlace.append(listing.element);
      show();
    },
  );

  /** @param {string} words @param {() => void} onSwitch */
  function switchButton(words, onSwitch) {
    const button = h("button", { type: "button", class: "chip", "aria-pressed": "false" }, words);
    button.addEventListener("click", () => {
      button.setAttribute("aria-pressed", String(button.getAttribute("aria-pressed") !== "true"));
      onSwitch();
    });
    return button;
  }

  /** @param {"step" | "all"} name */
  function choosePage(name) {
    views.forEach((button, k) => button.setAttribute("aria-pressed", String((name === "all") === Boolean(k))));
    charts.element.hidden = !own || name === "all";
    ladder.show(own && name === "all");
  }

  /** Holds a step back while there is something to guess about it. @param {number} next */
  function mayStep(next) {
    if (!trace || !own || !predict.on) return true;
    if (predict.asked?.index === next) return false;
    const event = trace.at(next);
    const question = predict.ask(event);
    if (!question) return true;
    stepper.say(question);
    dock.classList.add("asking");
    const dots = (
      event.beam >= 0 && event.phase === "growth" ? [event.beam] : trace.span(event.first, event.last)
    ).flatMap((beam) => [trace?.point(beam)]);
    overlay.set("question", { dots: /** @type {[number, number][]} */ (dots.filter(Boolean)) });
    return false;
  }

  /** @param {Event} event @param {boolean} right */
  function answered(event, right) {
    stepper.go(event.index);
    stepper.say(`${right ? text.predict.right : text.predict.wrong} ${event.text}`);
  }

  /** Every fit of the growing line up to here. @param {Event | null} event */
  function trailOf(event) {
    if (
      !trace ||
      !own ||
      !event ||
      trail.getAttribute("aria-pressed") !== "true" ||
      (event.phase !== "growth" && event.kind !== "seed found")
    )
      return null;
    /** @type {[[number, number], [number, number]][]} */
    const lines = [];
    for (let k = event.index; k >= 0 && trace.columns.candidate[k] === event.candidate; k--) {
      const each = trace.at(k);
      const part =
        each.line && (each.kind === "seed found" || each.kind === "point added")
          ? stretch(trace, trace.span(each.first, each.last), each.line)
          : null;
      if (part) lines.push(longer(part));
    }
    // Beyond some hundred they could not be told apart.
    const every = Math.ceil(lines.length / 120);
    return { lines: lines.filter((_, k) => k % every === 0) };
  }

  const awaited = new Set(["lessons", "knobs"]);
  let opened = false;
  fetchInto(
    lessons.trouble,
    "/api/lessons",
    text.lesson,
    (/** @type {Parameters<typeof lessons.setLessons>[0]} */ told) => {
      lessons.setLessons(told);
      awaited.delete("lessons");
      openFromAddress();
    },
  );

  /** A link with ?lesson=… opens it, once thresholds and lessons are there. */
  function openFromAddress() {
    const wanted = new URL(location.href).searchParams.get("lesson");
    if (!wanted || opened || awaited.size) return;
    opened = true;
    onChange({ mode: "learn" });
    lessons.open(wanted);
  }

  /** @returns {Event | null} */
  function present() {
    return step !== null && trace && step < trace.length ? trace.at(step) : null;
  }

  /** @param {number | null} beam */
  function showBeam(beam) {
    const at = beam === null ? null : trace?.point(beam);
    overlay.set("beam", at ? { dots: [at], lines: [[[0, 0], at]] } : null);
  }

  /** To the next decision about a beam; behind the last one, to the first. @param {number} beam */
  function runTo(beam) {
    if (!trace) return;
    const next = trace.nextAbout(beam, step ?? -1);
    const there = next >= 0 ? next : trace.nextAbout(beam, -1);
    if (there < 0) return;
    stepper.stop();
    stepper.go(there);
  }

  /** The same as a click on its point in the scene. @param {number} beam */
  function choose(beam) {
    onChange({ selected: beam });
    runTo(beam);
  }

  /** Shows the points of the decision, with some room around them. */
  function zoom() {
    const event = present();
    if (!event || !trace) return;
    const inside = trace.span(event.first, event.last);
    const points = [...inside, event.beam]
      .flatMap((beam) => [trace?.point(beam) ?? []])
      .filter((point) => point.length === 2);
    const [xs, ys] = [0, 1].map((k) => points.map((point) => Number(point[k])));
    const room = 0.5 + 0.15 * Math.hypot(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
    planView.fit([Math.min(...xs) - room, Math.min(...ys) - room, Math.max(...xs) + room, Math.max(...ys) + room]);
  }

  function show() {
    const event = present();
    overlay.set("term", null);
    overlay.set("trail", trailOf(event));
    if (predict.asked && predict.asked.index !== (step ?? -2) + 1) predict.drop();
    if (!predict.asked) overlay.set("question", null);
    dock.classList.toggle("asking", predict.asked !== null);
    const explained = own ? event : null;
    formulas.set(explained, trace);
    charts.set(explained, trace, params);
    listing?.set(explained, event ? variables(event) : [], event ? compared(event) : "");
  }

  return {
    stepper,
    zoom,
    /** @param {boolean} yes */
    answer: (yes) => predict.answer(yes),
    /** @param {import("./trace.js").Columns} columns */
    setTrace(columns) {
      trace = new Trace(columns);
      predict.drop();
      stepper.setTrace(trace);
      ladder.setTrace(trace);
      show();
    },
    /** @param {Readonly<View>} view */
    setView(view) {
      step = view.step;
      params = view.params;
      lessons.setView(view);
      if (view.mode !== "learn") return stepper.stop();
      stepper.setStep(step);
      return show();
    },
    /** @param {import("../wire.js").Method} method the chosen one @param {import("../wire.js").Method[]} methods the lessons are about the first */
    setMethod(method, [{ knobs }]) {
      own = method.knobs === knobs;
      listingPlace.hidden = formulas.element.hidden = !own;
      other.hidden = own;
      setText(other, text.otherMethod(method.label, method.citation));
      for (const part of [...views, trail, predict.toggle, predict.score]) part.hidden = !own;
      stepper.setMethod(method);
      choosePage("step");
      lessons.setKnobs(knobs);
      ladder.setKnobs(knobs);
      awaited.delete("knobs");
      openFromAddress();
    },
    /** @param {State} state @param {"page" | "scene"} origin */
    setState(state, origin) {
      stepper.setLines(state.segments.length);
      if (state.mode === "learn") ladder.setState(state);
      if (state.mode === "learn" && origin === "scene" && state.selected !== null) runTo(state.selected);
      if (state.mode === "learn" && settled() && trace) lessons.settle(state, trace);
    },
  };
}

/** The part, somewhat longer at both ends, so that its direction shows. @param {[[number, number], [number, number]]} part @returns {[[number, number], [number, number]]} */
function longer([[x1, y1], [x2, y2]]) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const reach = Math.max(0.25 * length, 0.2) / length;
  return [
    [x1 - reach * (x2 - x1), y1 - reach * (y2 - y1)],
    [x2 + reach * (x2 - x1), y2 + reach * (y2 - y1)],
  ];
}
