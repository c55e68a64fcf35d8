// @ts-check
import { h } from "../widgets/dom.js";
import { icon, iconButton } from "../widgets/icon.js";
import { createMenu } from "../widgets/menu.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").RecordingEntry} RecordingEntry */
/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").State} State */

const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** @typedef {(typeof THEMES)[number]} Theme */

/**
 * @param {HTMLElement} bar
 * @param {typeof import("../text/en.js").text} words
 * @param {{exchange: HTMLElement, ab: HTMLElement, modes: HTMLElement, theme: Theme, onRecording: (id: string) => void, onOpen: () => void,
 *          onTopic: (topic: string) => void, onMethod: (method: string) => void, onLink: () => void,
 *          onTheme: (theme: Theme) => void, onHelp: () => void}} handlers
 */
export function mountTopbar(bar, words, handlers) {
  const text = words.top;
  /** @type {RecordingEntry[]} */
  let recordings = [];
  /** @type {string | null} */
  let current = null;
  let theme = handlers.theme;

  const menu = createMenu({ label: text.noRecording, name: text.recording, className: "recording", groups });
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
  const themeButton = iconButton("auto", text.themeAuto, () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
    showTheme();
    handlers.onTheme(theme);
  });
  const help = h(
    "button",
    { type: "button", class: "icon-button", "aria-label": text.help, title: text.help, onclick: handlers.onHelp },
    "?",
  );
  bar.append(
    h("h1", { class: "app-name" }, words.appName),
    menu.element,
    topic,
    method,
    h("span", { class: "spacer" }),
    handlers.modes,
    h("span", { class: "spacer" }),
    handlers.ab,
    link,
    handlers.exchange,
    themeButton,
    help,
  );
  showTheme();

  function groups() {
    const names = [...new Set(recordings.map(({ group }) => group))];
    const open = { label: text.openFile, note: text.openHint, run: handlers.onOpen };
    return [
      { title: "", items: [open] },
      ...names.map((group) => ({
        title: words.groups[group] ?? group,
        items: recordings
          .filter((entry) => entry.group === group)
          .map(({ id, label, missing }) => ({
            label,
            note: missing ? text.missing : "",
            current: id === current,
            disabled: missing,
            run: () => handlers.onRecording(id),
          })),
      })),
    ];
  }

  function showTheme() {
    const shown = { auto: ["auto", text.themeAuto], light: ["sun", text.themeLight], dark: ["moon", text.themeDark] }[
      theme
    ];
    themeButton.show(/** @type {import("../widgets/icon.js").IconName} */ (shown[0]), shown[1]);
  }

  return {
    /** @param {RecordingEntry[]} next */
    setRecordings(next) {
      recordings = next;
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
      current = state.recording;
      menu.setLabel(state.label);
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
