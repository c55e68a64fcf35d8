// @ts-check
// The panel of the modes Tune and Inspect: tabs, each with its page.
import { createLines } from "./lines.js";
import { Tabs } from "./tabs.js";
import { Thresholds } from "./thresholds.js";

/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").State} State */
/** @typedef {{name: string, label: string, content: HTMLElement}} Page */
/** @typedef {import("./thresholds.js").Handlers & import("./lines.js").Handlers} Handlers */

/**
 * @param {HTMLElement} panel
 * @param {typeof import("../text/page.js").pageText} text
 * @param {Handlers} handlers
 * @param {Page[]} inspecting further pages, first in the mode Inspect
 * @param {{above: HTMLElement[], pages: Page[]}} tuner above the thresholds, and its pages in the mode Tune
 */
export function mountPanel(panel, text, handlers, inspecting, tuner) {
  return new Panel(panel, text, handlers, inspecting, tuner);
}

class Panel {
  #thresholds;
  #lines;
  #tabs;
  /** Identifies the drawn recording. */ #place = "";
  /** The row that a sentence names. @type {HTMLElement | null | undefined} */ #lit = null;

  /**
   * @param {HTMLElement} panel
   * @param {typeof import("../text/page.js").pageText} text
   * @param {Handlers} handlers
   * @param {Page[]} inspecting
   * @param {{above: HTMLElement[], pages: Page[]}} tuner
   */
  constructor(panel, text, handlers, inspecting, tuner) {
    const { tabs } = text.tune;
    this.#thresholds = new Thresholds(text.tune, handlers, tuner.above);
    this.#lines = createLines(text.lines, handlers);
    this.#tabs = new Tabs([
      ...inspecting.map((page) => ({ ...page, mode: "inspect" })),
      { name: "thresholds", label: tabs.thresholds, content: this.#thresholds.element },
      { name: "lines", label: tabs.lines, content: this.#lines.element },
      ...tuner.pages.map((page) => ({ ...page, mode: "tune" })),
    ]);
    panel.setAttribute("aria-label", text.tune.label);
    panel.replaceChildren(this.#tabs.bar, ...this.#tabs.contents);
  }

  /** @param {Method} method the chosen one */
  setMethod({ knobs }) {
    this.#thresholds.setKnobs(knobs);
    this.#lines.setKnobs(knobs);
  }

  /** @param {Readonly<import("../wire.js").View>} view @param {import("../parts.js").Change} change */
  setView({ params, mode }, { canUndo, canRedo }) {
    this.#thresholds.setParams(params, canUndo, canRedo);
    this.#tabs.setMode(mode);
  }

  /** The row of a threshold, so that others can add to it. @param {string} name */
  row(name) {
    return this.#thresholds.row(name);
  }

  /** Marks the row of the threshold that a sentence names; null: none. @param {string | null} name */
  light(name) {
    this.#lit?.classList.remove("lit");
    this.#lit = name ? this.row(name)?.element : null;
    this.#lit?.classList.add("lit");
    this.#lit?.scrollIntoView({ block: "nearest" });
  }

  /** Goes to the slider of a threshold. @param {string} name */
  show(name) {
    this.open("thresholds");
    this.#thresholds.show(name);
  }

  /** Shows one of the pages. @param {string} name */
  open(name) {
    this.#tabs.open(name);
  }

  /** @param {State} state */
  setState(state) {
    if (state.place !== this.#place) this.#thresholds.forget();
    this.#place = state.place;
    this.#thresholds.setHistograms(state.histograms);
    this.#tabs.setCount("lines", state.segments.length);
    this.#lines.setState(state);
  }

  /** Marks on the sliders. @param {import("../wire.js").WhatIf[]} changes */
  setMarks(changes) {
    this.#thresholds.setMarks(changes);
  }

  /** Ticks on the sliders. @param {import("../wire.js").Params} fits the values that fit the laser @param {boolean} better than the present ones */
  setFits(fits, better) {
    this.#thresholds.setFits(fits, better);
  }

  /** Shows why the server refused thresholds. @param {string} why */
  refuse(why) {
    this.#thresholds.refuse(why);
  }
}
