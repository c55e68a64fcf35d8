// @ts-check
import { h } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { createMenu } from "../widgets/menu.js";
import { tooltip } from "../widgets/tooltip.js";
import { createThemeButton } from "./theme_button.js";

/** @typedef {import("../wire.js").RecordingEntry} RecordingEntry */
/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").State} State */
/** @typedef {typeof import("../text/words.js").words} Words */

/** @typedef {import("../theme.js").Theme} Theme */

/**
 * The menu of recordings that can be opened.
 * @param {Words} words
 * @param {{onOpen: () => void, onRecording: (entry: RecordingEntry) => void, onReread: () => void}} handlers
 */
function createRecordings(words, { onOpen, onRecording, onReread }) {
  const text = words.page.top;
  /** @type {RecordingEntry[]} */
  let recordings = [];
  /** @type {string | null} */
  let current = null;
  /** What the file was taken for. */
  let line = "";
  const menu = createMenu({
    label: text.noRecording,
    name: text.recording,
    className: "recording",
    leaves: true,
    groups,
  });

  /** @param {RecordingEntry} entry */
  function item(entry) {
    const { id, label, missing } = entry;
    return {
      label,
      note: missing ? text.missing : "",
      current: id === current,
      disabled: missing,
      run: () => onRecording(entry),
    };
  }

  function groups() {
    const names = [...new Set(recordings.map(({ group }) => group))];
    const open = { label: text.openFile, note: text.openHint, run: onOpen };
    const taken = line ? [{ title: line, items: [{ label: words.reading.change, run: onReread }] }] : [];
    return [
      ...taken,
      { title: "", items: [open] },
      ...names.map((name) => ({
        title: words.page.groups[name] ?? name,
        items: recordings.filter(({ group }) => group === name).map(item),
      })),
    ];
  }

  return {
    element: menu.element,
    /** @param {RecordingEntry[]} next */
    offer(next) {
      recordings = next;
    },
    /** @param {State} state */
    set({ recording, label, account }) {
      current = recording;
      line = account?.line ?? "";
      menu.setLabel(label);
    },
  };
}

/**
 * @param {HTMLElement} bar
 * @param {Words} words
 * @param {{exchange: HTMLElement, ab: HTMLElement, modes: HTMLElement, theme: Theme, onRecording: (entry: RecordingEntry) => void, onReread: () => void, onOpen: () => void,
 *          onTopic: (topic: string) => void, onMethod: (method: string) => void, onLink: () => void,
 *          onTheme: (theme: Theme) => void, onHelp: () => void}} handlers
 */
export function mountTopbar(bar, words, handlers) {
  const text = words.page.top;
  const recordings = createRecordings(words, handlers);
  const topic = h("select", { class: "select", "aria-label": text.topic, hidden: true });
  topic.addEventListener("change", () => handlers.onTopic(topic.value));
  const method = h("select", { class: "select", "aria-label": text.method, hidden: true });
  method.addEventListener("change", () => handlers.onMethod(method.value));
  const link = h(
    "button",
    { type: "button", class: "button quiet", "aria-label": text.copyLink, onclick: handlers.onLink },
    icon("link"),
    h("span", { class: "label" }, text.copyLink),
  );
  tooltip(link, text.copyLink);
  const help = h(
    "button",
    { type: "button", class: "icon-button", "aria-label": text.help, title: text.help, onclick: handlers.onHelp },
    "?",
  );
  bar.append(
    h("h1", { class: "app-name" }, words.page.appName),
    recordings.element,
    topic,
    method,
    h("span", { class: "spacer" }),
    handlers.modes,
    h("span", { class: "spacer" }),
    handlers.ab,
    link,
    handlers.exchange,
    createThemeButton(text, handlers.theme, handlers.onTheme),
    help,
  );

  return {
    /** @param {RecordingEntry[]} next */
    setRecordings(next) {
      recordings.offer(next);
    },
    /** @param {Method[]} methods */
    setMethods(methods) {
      method.hidden = methods.length < 2;
      method.replaceChildren(
        ...methods.map(({ name, label, citation }) => h("option", { value: name, title: citation }, label)),
      );
    },
    /** @param {Method} chosen */
    setMethod(chosen) {
      method.value = chosen.name;
      method.title = `${chosen.label} (${chosen.citation})`;
    },
    /** @param {State} state */
    setState(state) {
      recordings.set(state);
      const { topics } = state;
      topic.hidden = topics.length < 2;
      const key = topics.map(({ name }) => name).join("\n");
      if (topic.dataset.key !== key) {
        topic.dataset.key = key;
        topic.replaceChildren(
          ...topics.map(({ name, scans }) => h("option", { value: name }, text.topicScans(name, scans))),
        );
      }
      if (state.topic !== null) topic.value = state.topic;
    },
  };
}
