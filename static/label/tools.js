// @ts-check
// The buttons that edit the true lines of a frame.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { tooltip } from "../widgets/tooltip.js";

/**
 * @typedef {object} Runs
 * @property {() => void} undo
 * @property {() => void} redo
 * @property {() => void} draw starts or stops drawing a line
 * @property {() => void} split
 * @property {() => void} merge
 * @property {() => void} remove
 * @property {() => void} accept saves the proposed lines as the true ones
 * @property {() => void} restart starts over from the proposed lines
 * @property {() => void} forget removes the true lines of the frame
 */

export class Tools {
  #undo;
  #redo;
  #draw;
  #onLine;
  #accept;
  #restart;
  #forget;

  /** @param {typeof import("../text/label.js").labelText} text @param {Runs} runs */
  constructor(text, runs) {
    this.#undo = iconButton("undo", text.undo, runs.undo);
    this.#redo = iconButton("redo", text.redo, runs.redo);
    this.#draw = button(text.draw, text.drawHelp, runs.draw);
    this.#onLine = [
      button(text.split, text.splitHelp, runs.split),
      button(text.merge, text.mergeHelp, runs.merge),
      button(text.remove, text.removeHelp, runs.remove),
    ];
    this.#accept = button(text.accept, text.acceptHelp, runs.accept);
    this.#restart = button(text.restart, text.restartHelp, runs.restart);
    this.#forget = button(text.forget, text.forgetHelp, runs.forget);
    const spacer = h("span", { class: "spacer" });
    this.head = h("div", { class: "labels-head" }, h("h3", {}, text.lines), spacer, this.#undo, this.#redo);
    this.lines = h("div", { class: "labels-actions" }, this.#draw, ...this.#onLine);
    this.whole = h("div", { class: "labels-actions" }, this.#accept, this.#restart, this.#forget);
  }

  /** @param {boolean} canUndo @param {boolean} canRedo */
  setPast(canUndo, canRedo) {
    this.#undo.disabled = !canUndo;
    this.#redo.disabled = !canRedo;
  }

  /**
   * @param {boolean} editable @param {boolean} onLine whether a line is chosen that can be edited
   * @param {boolean} proposed whether nobody has said which lines are true @param {boolean} drawing
   */
  set(editable, onLine, proposed, drawing) {
    for (const each of [this.#draw, this.#accept, this.#restart, this.#forget]) each.disabled = !editable;
    for (const each of this.#onLine) each.disabled = !editable || !onLine;
    this.#draw.setAttribute("aria-pressed", String(drawing));
    this.#accept.hidden = !proposed;
    this.#restart.hidden = this.#forget.hidden = proposed;
  }
}

/** @param {string} label @param {string} help @param {() => void} run */
function button(label, help, run) {
  const made = h("button", { type: "button", class: "button", onclick: run }, label);
  tooltip(made, help);
  return made;
}
