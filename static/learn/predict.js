// @ts-check
// "In or out?" before a decision is shown, and a score.
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {typeof import("../text/learn.js").learnText.predict} Text */

const YES = new Set(["seed found", "point added", "line kept", "lines merged"]);
const NO = new Set(["seed rejected", "growth stopped", "line dropped", "lines kept apart"]);

/** The question about a decision that is not shown yet; null if there is nothing to guess. @param {Event} event @param {Text} text */
export function questionOf(event, text) {
  const { kind, check, phase } = event;
  if (check === "end" || check === "nearer" || (phase === "overlap" && kind === "line dropped")) return null;
  if (!YES.has(kind) && !NO.has(kind)) return null;
  if (phase === "seed") return { words: text.seed(event), answers: text.seedAnswers };
  if (kind === "point added" || kind === "growth stopped")
    return { words: text.point(event), answers: text.pointAnswers };
  if (phase === "growth") return { words: text.line(event), answers: text.lineAnswers };
  return { words: text.pair, answers: text.pairAnswers };
}

/**
 * @param {Text} text
 * @param {{onAnswer: (event: Event, right: boolean) => void, onToggle: (on: boolean) => void}} handlers
 */
export function createPredict(text, { onAnswer, onToggle }) {
  /** @type {Event | null} */
  let asked = null;
  let on = false;
  let right = 0;
  let all = 0;
  const score = h("span", { class: "predict-score", role: "status" });
  const yes = h("button", {
    type: "button",
    class: "button primary",
    "data-answer": "yes",
    onclick: () => answer(true),
  });
  const no = h("button", {
    type: "button",
    class: "button primary",
    "data-answer": "no",
    onclick: () => answer(false),
  });
  const buttons = h("span", { class: "predict-answers", hidden: true }, yes, no);
  const toggle = h(
    "button",
    { type: "button", class: "button", "aria-pressed": "false", onclick: () => turn(!on) },
    text.toggle,
  );
  toggle.title = text.help;

  /** @param {boolean} next */
  function turn(next) {
    on = next;
    right = all = 0;
    toggle.setAttribute("aria-pressed", String(on));
    setText(score, on ? text.score(right, all) : "");
    drop();
    onToggle(on);
  }

  function drop() {
    asked = null;
    buttons.hidden = true;
  }

  /** @param {boolean} guess */
  function answer(guess) {
    if (!asked) return;
    const event = asked;
    const hit = guess === YES.has(event.kind);
    all += 1;
    right += Number(hit);
    setText(score, text.score(right, all));
    drop();
    onAnswer(event, hit);
  }

  return {
    toggle,
    buttons,
    score,
    answer,
    drop,
    get on() {
      return on;
    },
    get asked() {
      return asked;
    },
    /** Asks about the decision; the sentence to ask, or null if there is nothing to guess. @param {Event} event */
    ask(event) {
      const question = questionOf(event, text);
      if (!on || !question) return null;
      asked = event;
      setText(yes, question.answers[0]);
      setText(no, question.answers[1]);
      buttons.hidden = false;
      if (!all) setText(score, "");
      return question.words;
    },
  };
}
