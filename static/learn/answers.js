// @ts-check
// Tasks that are answered in the text: an answer to choose, or a number.
import { h } from "../widgets/dom.js";

/** @typedef {import("../wire.js").Task} Task */
/** @typedef {typeof import("../text/learn.js").learnText.answers} Text */
/** words: why it is not right; answer: what was chosen or typed. @typedef {(solved: boolean, words: string, answer: string) => void} OnAnswer */

// Of what was typed and what is right, so much may differ by rounding.
const ROUNDING = 1e-9;

/**
 * The ways to answer a task; none if it asks for something to do.
 * @param {Task} task @param {Text} text @param {(words: string) => (Node | string)[]} rich @param {OnAnswer} onAnswer
 * @returns {HTMLElement[]}
 */
export function answersOf({ choice, number }, text, rich, onAnswer) {
  if (choice.length) return [choiceOf(choice, text, rich, onAnswer)];
  return number ? [numberField(number, text, onAnswer)] : [];
}

/** @param {Task["choice"]} choice @param {Text} text @param {(words: string) => (Node | string)[]} rich @param {OnAnswer} onAnswer */
function choiceOf(choice, text, rich, onAnswer) {
  const buttons = choice.map((option) => {
    const button = h("button", { type: "button", class: "answer", "aria-pressed": "false" }, ...rich(option.text));
    button.addEventListener("click", () => {
      for (const each of buttons) each.setAttribute("aria-pressed", String(each === button));
      onAnswer(option.right, option.right ? "" : `${text.wrong} ${option.why}`.trim(), option.text);
    });
    return button;
  });
  return h("div", { class: "answers", role: "group", "aria-label": text.choose }, ...buttons);
}

/** @param {import("../wire.js").Quantity} quantity @param {Text} text @param {OnAnswer} onAnswer */
function numberField({ answer, within }, text, onAnswer) {
  const wanted = Number.parseFloat(answer.replace("−", "-"));
  const unit = answer.replace(/^[-−]?[\d.]+\s*/u, "");
  const field = h("input", { type: "text", class: "number", inputMode: "decimal", "aria-label": text.number(unit) });
  const form = h(
    "form",
    { class: "answers-number" },
    field,
    h("span", { class: "unit" }, unit),
    h("button", { type: "submit", class: "button" }, text.check),
  );
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const typed = field.value.trim().replace(",", ".").replace("−", "-");
    const value = typed === "" ? Number.NaN : Number(typed);
    if (!Number.isFinite(value)) return onAnswer(false, text.noNumber, "");
    const off = value - wanted;
    const said = `${typed} ${unit}`.trim();
    if (Math.abs(off) <= within + ROUNDING * Math.max(1, Math.abs(wanted))) return onAnswer(true, "", said);
    return onAnswer(false, off < 0 ? text.tooSmall : text.tooLarge, said);
  });
  return form;
}
