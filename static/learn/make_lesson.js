// @ts-check
// A lesson made of what is shown: its author writes a text and a question; recording, frame, step and view are taken.
import { fetchText } from "../fetch.js";
import { download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { sendLessons } from "./dropped.js";

/** @typedef {typeof import("../text/learn.js").learnText.making} Text */
/** @typedef {import("../wire.js").NewLesson} NewLesson */

/**
 * @param {Text} text
 * @param {{session: () => string, box: () => import("../wire.js").Box | null, onMade: (lessons: import("./lessons.js").Lesson[]) => void}} handlers
 */
export function openMaking(text, { session, box, onMade }) {
  const shown = box();
  const title = h("input", { type: "text", maxLength: 60, required: true });
  const about = h("input", { type: "text", maxLength: 200, required: true });
  const words = h("textarea", { rows: 5, maxLength: 2000, required: true });
  const question = h("textarea", { rows: 2, maxLength: 2000, required: true });
  const right = h("input", { type: "text", maxLength: 300, required: true });
  const wrong = h("textarea", { rows: 3, required: true });
  const trouble = h("p", { class: "panel-error", role: "alert", hidden: true });
  const save = h("button", { type: "submit", class: "button primary" }, text.save);
  const field = (/** @type {string} */ label, /** @type {HTMLElement} */ input) =>
    h("label", { class: "making-field" }, h("span", {}, label), input);
  const form = h(
    "form",
    { class: "making" },
    h("p", { class: "hint" }, text.hint),
    field(text.title, title),
    field(text.about, about),
    field(text.words, words),
    field(text.question, question),
    field(text.right, right),
    field(text.wrong, wrong),
    trouble,
    h("div", { class: "dialog-buttons" }, save),
  );
  const dialog = openDialog(text.open, text.close, form);

  /** @param {string} why */
  function complain(why) {
    trouble.hidden = !why;
    trouble.textContent = why;
  }

  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    /** @type {NewLesson} */
    const said = {
      title: title.value,
      about: about.value,
      text: words.value,
      question: question.value,
      right: right.value,
      wrong: wrong.value.split("\n").filter((line) => line.trim()),
      box: shown,
    };
    const made = await fetchText(`/api/lessons/new?${new URLSearchParams({ session: session() })}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(said),
    });
    if (made.trouble !== null) return complain(made.trouble);
    const name = `${title.value.trim().replace(/[^\p{L}\p{N}]+/gu, "_")}.json`;
    try {
      const lessons = await sendLessons([new File([made.words], name)]);
      download(name, made.words);
      dialog.close();
      return onMade(lessons);
    } catch (error) {
      return complain(error instanceof Error ? error.message : String(error));
    }
  });
  title.focus();
}

/**
 * The part of the plan on the stage [m]; null unless it is seen from above.
 * @param {(x: number, y: number) => [number, number] | null} project @param {HTMLElement} stage @returns {import("../wire.js").Box | null}
 */
export function boxOnStage(project, stage) {
  const [origin, east, north] = [project(0, 0), project(1, 0), project(0, 1)];
  if (!origin || !east || !north) return null;
  const [scaleX, scaleY] = [east[0] - origin[0], north[1] - origin[1]];
  if (!scaleX || !scaleY) return null;
  const xs = [0, stage.clientWidth].map((px) => (px - origin[0]) / scaleX);
  const ys = [0, stage.clientHeight].map((px) => (px - origin[1]) / scaleY);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}
