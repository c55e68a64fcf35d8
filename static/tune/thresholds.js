// @ts-check
// The page of thresholds: presets, undo, and a row for each threshold, with the extensions folded.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { gestureCount } from "../widgets/slider.js";
import { tooltip } from "../widgets/tooltip.js";
import { createPresetMenu, defaultsOf } from "./preset_menu.js";
import { createSwitch } from "./switch.js";
import { hasHistogram, Threshold } from "./threshold.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {typeof import("../text/page.js").pageText.tune} Text */
/** @typedef {{onParams: (params: Params, gesture: string | null) => void, onUndo: () => void, onRedo: () => void, profiles: import("./profiles.js").Profiles}} Handlers */

export class Thresholds {
  #text;
  #onParams;
  /** @type {Knob[]} */ #knobs = [];
  /** @type {Map<string, Threshold | ReturnType<typeof createSwitch>>} */ #rows = new Map();
  #undo;
  #redo;
  #resetAll;
  #presets;
  #legend;
  #main = h("div", { class: "thresholds" });
  #more = h("div", { class: "thresholds" });
  #extensions;
  #message = h("p", { class: "panel-error", role: "alert", hidden: true });

  /** @param {Text} text @param {Handlers} handlers @param {HTMLElement[]} above what stands above the rows */
  constructor(text, { onParams, onUndo, onRedo, profiles }, above) {
    this.#text = text;
    this.#onParams = onParams;
    this.#undo = iconButton("undo", text.undo, onUndo);
    this.#redo = iconButton("redo", text.redo, onRedo);
    this.#presets = createPresetMenu(text, {
      knobs: () => this.#knobs,
      onParams: (params) => onParams(params, null),
      profiles,
    });
    this.#resetAll = h(
      "button",
      { type: "button", class: "button", onclick: () => onParams(defaultsOf(this.#knobs), null) },
      text.resetAll,
    );
    tooltip(this.#resetAll, text.resetAllHelp);
    this.#legend = h(
      "p",
      { class: "histogram-legend" },
      h("span", { class: "key passed" }),
      text.passed,
      h("span", { class: "key failed" }),
      text.failed,
      h("span", { class: "histogram-heights" }, text.heights),
    );
    const [mark, dot] = [h("span", { class: "tag" }, text.extensionMark), h("span", { class: "changed-dot" })];
    this.#extensions = h("details", { class: "extensions" }, h("summary", {}, text.extensions, mark, dot), this.#more);
    const spacer = h("span", { class: "spacer" });
    this.element = h(
      "div",
      {},
      h("div", { class: "panel-toolbar" }, this.#presets.element, spacer, this.#undo, this.#redo, this.#resetAll),
      this.#message,
      ...above,
      this.#main,
      this.#legend,
      this.#extensions,
    );
  }

  /** @param {Knob[]} knobs of the chosen method */
  setKnobs(knobs) {
    this.#knobs = knobs;
    this.#rows = new Map(knobs.map((knob) => [knob.name, this.#createRow(knob)]));
    const rows = (/** @type {boolean} */ extension) =>
      knobs.filter((knob) => knob.extension === extension).map((knob) => this.#rows.get(knob.name)?.element ?? "");
    this.#main.replaceChildren(...rows(false));
    this.#more.replaceChildren(...rows(true));
    this.#extensions.hidden = !knobs.some((knob) => knob.extension);
    this.#legend.hidden = !knobs.some(hasHistogram);
  }

  /** @param {Knob} knob */
  #createRow(knob) {
    const onChange = (/** @type {string} */ name, /** @type {number} */ value) =>
      this.#onParams({ [name]: value }, `${name} ${gestureCount()}`);
    return knob.kind === "bool" ? createSwitch(knob, this.#text, onChange) : new Threshold(knob, this.#text, onChange);
  }

  /** @param {Params} params of the View @param {boolean} canUndo @param {boolean} canRedo */
  setParams(params, canUndo, canRedo) {
    const changed = this.#knobs.filter((knob) => params[knob.name] !== knob.default);
    for (const [name, value] of Object.entries(params)) this.#rows.get(name)?.set(value);
    this.#extensions.classList.toggle(
      "changed",
      changed.some((knob) => knob.extension),
    );
    this.#presets.show(params);
    this.#undo.disabled = !canUndo;
    this.#redo.disabled = !canRedo;
    this.#resetAll.disabled = !changed.length;
    this.#message.hidden = true;
  }

  /** The row of a threshold, so that others can add to it. @param {string} name */
  row(name) {
    return this.#rows.get(name) ?? null;
  }

  /** Goes to a slider. @param {string} name */
  show(name) {
    const row = this.row(name)?.element;
    row?.closest("details")?.setAttribute("open", "");
    row?.scrollIntoView({ block: "nearest" });
    row?.querySelector("input")?.focus({ preventScroll: true });
  }

  /** Another recording was opened. */
  forget() {
    for (const row of this.#rows.values()) row.shrink();
  }

  /** @param {import("../wire.js").State["histograms"]} histograms */
  setHistograms(histograms) {
    for (const [name, row] of this.#rows) row.setHistogram(histograms?.[name]);
  }

  /** Marks on the sliders. @param {import("../wire.js").WhatIf[]} changes */
  setMarks(changes) {
    for (const [name, row] of this.#rows) row.setMark(changes.find((change) => change.name === name));
  }

  /** Ticks on the sliders. @param {Params} fits the values that fit the laser @param {boolean} better than the present ones */
  setFits(fits, better) {
    for (const [name, row] of this.#rows) row.setFit(fits[name], better);
  }

  /** Shows why the server refused thresholds: at the field that it names, or else above all fields. @param {string} why */
  refuse(why) {
    const row = this.#rows.get(why.split(" ")[0]);
    if (row) return row.refuse(why);
    this.#message.hidden = false;
    return setText(this.#message, why);
  }
}
