// @ts-check
// The panel of mode Tune: thresholds with presets and undo, and the list of lines.
import { h, setText } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";
import { createMenu } from "../widgets/menu.js";
import { format } from "../widgets/scale.js";
import { gestureCount } from "../widgets/slider.js";
import { tooltip } from "../widgets/tooltip.js";
import { createLines } from "./lines.js";
import { PRESETS } from "./presets.js";
import { createThreshold, hasHistogram } from "./sliders.js";
import { createSwitch } from "./switch.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").State} State */

/**
 * @param {HTMLElement} panel
 * @param {typeof import("../text/page.js").pageText} text
 * @param {{onParams: (params: Params, gesture: string | null) => void, onSelect: (beam: number) => void,
 *          onUndo: () => void, onRedo: () => void}} handlers
 * @param {{name: string, label: string, content: HTMLElement}[]} inspecting further pages, first in the mode Inspect
 * @param {{legend: HTMLElement, pages: {name: string, label: string, content: HTMLElement}[]}} tuner below the thresholds, and its pages in the mode Tune
 */
export function mountPanel(panel, text, { onParams, onSelect, onUndo, onRedo }, inspecting, tuner) {
  /** @type {Knob[]} */
  let knobs = [];
  /** @type {Map<string, ReturnType<typeof createThreshold>>} */
  let thresholds = new Map();

  const undo = iconButton("undo", text.tune.undo, onUndo);
  const redo = iconButton("redo", text.tune.redo, onRedo);
  const presets = createMenu({ label: text.tune.presetChoose, name: text.tune.preset, groups: presetGroups });
  tooltip(presets.button, text.tune.presetHelp, "left");
  const resetAll = h(
    "button",
    { type: "button", class: "button", onclick: () => onParams(defaults(), null) },
    text.tune.resetAll,
  );
  tooltip(resetAll, text.tune.resetAllHelp);
  const toolbar = h(
    "div",
    { class: "panel-toolbar" },
    presets.element,
    h("span", { class: "spacer" }),
    undo,
    redo,
    resetAll,
  );
  const legend = h(
    "p",
    { class: "histogram-legend" },
    h("span", { class: "key passed" }),
    text.tune.passed,
    h("span", { class: "key failed" }),
    text.tune.failed,
  );
  const main = h("div", { class: "thresholds" });
  const message = h("p", { class: "panel-error", role: "alert", hidden: true });
  const more = h("div", { class: "thresholds" });
  const extensions = h(
    "details",
    { class: "extensions" },
    h(
      "summary",
      {},
      text.tune.extensions,
      h("span", { class: "tag" }, text.tune.extensionMark),
      h("span", { class: "changed-dot" }),
    ),
    more,
  );
  const lines = createLines(text.lines, onSelect);
  const tabs = createTabs([
    ...inspecting.map((page) => ({ ...page, mode: "inspect" })),
    {
      name: "thresholds",
      label: text.tune.tabs.thresholds,
      content: h("div", {}, toolbar, message, tuner.legend, main, legend, extensions),
    },
    { name: "lines", label: text.tune.tabs.lines, content: lines.element },
    ...tuner.pages.map((page) => ({ ...page, mode: "tune" })),
  ]);
  panel.setAttribute("aria-label", text.tune.label);
  panel.replaceChildren(tabs.bar, ...tabs.pages);

  function defaults() {
    return Object.fromEntries(knobs.map((knob) => [knob.name, knob.default]));
  }

  function presetGroups() {
    const epsilon = knobs.find((knob) => knob.name === "epsilon");
    const lasers = PRESETS.map(({ laser, range, params }) => ({
      label: laser,
      note: text.tune.presetHint(range, epsilon ? format(epsilon, params.epsilon) : String(params.epsilon)),
      run: () => onParams(params, null),
    }));
    const paper = { label: text.tune.presetPaper, note: "", run: () => onParams(defaults(), null) };
    return [
      { title: "", items: [paper] },
      { title: text.tune.presetHelp, items: lasers },
    ];
  }

  return {
    /** @param {Method} method the chosen one */
    setMethod(method) {
      const next = method.knobs;
      knobs = next;
      const changed = (/** @type {string} */ name, /** @type {number} */ value) =>
        onParams({ [name]: value }, `${name} ${gestureCount()}`);
      const create = (/** @type {Knob} */ knob) =>
        (knob.kind === "bool" ? createSwitch : createThreshold)(knob, text.tune, changed);
      thresholds = new Map(next.map((knob) => [knob.name, create(knob)]));
      const rows = (/** @type {boolean} */ extension) =>
        next.filter((knob) => knob.extension === extension).map((knob) => thresholds.get(knob.name)?.element ?? "");
      main.replaceChildren(...rows(false));
      more.replaceChildren(...rows(true));
      lines.setKnobs(next);
      extensions.hidden = !next.some((knob) => knob.extension);
      legend.hidden = !next.some(hasHistogram);
      // They are the authors' and set ε for lasers; others' thresholds are other numbers.
      presets.element.hidden = !["epsilon", "delta"].every((name) => next.some((knob) => knob.name === name));
    },
    /** @param {Readonly<import("../wire.js").View>} view @param {import("../parts.js").Change} change */
    setView({ params, mode }, { canUndo, canRedo }) {
      for (const [name, value] of Object.entries(params)) thresholds.get(name)?.set(value);
      const changed = knobs.some((knob) => knob.extension && params[knob.name] !== knob.default);
      extensions.classList.toggle("changed", changed);
      undo.disabled = !canUndo;
      redo.disabled = !canRedo;
      resetAll.disabled = knobs.every((knob) => params[knob.name] === knob.default);
      message.hidden = true;
      tabs.setMode(mode);
    },
    /** The row of a threshold, for what else stands there. @param {string} name */
    row: (name) => thresholds.get(name)?.element ?? null,
    /** Shows one of the pages. @param {string} name */
    open: (name) => tabs.open(name),
    /** @param {State} state */
    setState(state) {
      for (const [name, threshold] of thresholds) threshold.setHistogram(state.histograms?.[name]);
      tabs.setCount("lines", state.segments.length);
      lines.setState(state);
    },
    /** Marks on the sliders. @param {import("../wire.js").WhatIf[]} changes */
    setMarks(changes) {
      for (const [name, threshold] of thresholds) threshold.setMark(changes.find((change) => change.name === name));
    },
    /** Shows why the server refused thresholds: at the field it names, else above them. @param {string} why */
    refuse(why) {
      const [first] = why.split(" ");
      const threshold = thresholds.get(first);
      if (threshold) return threshold.refuse(why);
      message.hidden = false;
      return setText(message, why);
    },
  };
}

/** @param {{name: string, label: string, content: HTMLElement, mode?: string}[]} tabs those with a mode are there in that one only */
function createTabs(tabs) {
  const counts = new Map(tabs.map(({ name }) => [name, h("span", { class: "count" })]));
  const pages = tabs.map(({ name, content }) => {
    content.classList.add("panel-page");
    content.id = `page-${name}`;
    content.setAttribute("role", "tabpanel");
    content.setAttribute("aria-labelledby", `tab-${name}`);
    return content;
  });
  const buttons = tabs.map(({ name, label }, k) =>
    h(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${name}`,
        "aria-controls": `page-${name}`,
        class: "tab",
        onclick: () => choose(k),
      },
      label,
      counts.get(name),
    ),
  );
  const bar = h("div", { class: "tabs", role: "tablist" }, ...buttons);
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const there = buttons.filter((button) => !button.hidden);
    const at = there.findIndex((button) => button.ariaSelected === "true");
    const next = there[(at + step + there.length) % there.length];
    choose(buttons.indexOf(next));
    next.focus();
  });
  let mode = "";

  /** @param {number} chosen */
  function choose(chosen) {
    buttons.forEach((button, k) => {
      button.setAttribute("aria-selected", String(k === chosen));
      button.tabIndex = k === chosen ? 0 : -1;
      pages[k].hidden = k !== chosen;
    });
  }

  return {
    bar,
    pages,
    /** @param {string} next */
    setMode(next) {
      if (next === mode) return;
      mode = next;
      buttons.forEach((button, k) => (button.hidden = tabs[k].mode !== undefined && tabs[k].mode !== mode));
      choose(buttons.findIndex((button) => !button.hidden));
    },
    /** @param {string} name */
    open: (name) => choose(tabs.findIndex((tab) => tab.name === name)),
    /** @param {string} name @param {number} count */
    setCount(name, count) {
      const badge = counts.get(name);
      if (badge) setText(badge, String(count));
    },
  };
}
