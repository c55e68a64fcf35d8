// @ts-check
// The menu of what is taken along; parameters as text, out and in.
import { pageText } from "../text/page.js";
import { copy, download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { createMenu } from "../widgets/menu.js";

/** @typedef {import("../wire.js").Params} Params */

/**
 * @param {typeof import("../text/page.js").pageText} words
 * @param {{params: () => Params, method: () => import("../wire.js").Method, onImport: (file: string) => Promise<string | null>,
 *          first: () => import("../widgets/menu.js").Group[], more: () => import("../widgets/menu.js").Group[]}} handlers
 *   onImport: applies the text of a parameter file, or says why not; first, more: what the menu holds before and after
 */
export function createExchange(words, { params, method, onImport, first, more }) {
  const text = words.exchange;
  const menu = createMenu({
    label: words.top.export,
    atEnd: true,
    groups: () => [
      ...first(),
      {
        title: text.parameters,
        items: [
          ...Object.keys(text.formats)
            .filter((to) => method().ros || !to.startsWith("ros"))
            .map((to) => ({ label: text.formats[to].label, run: () => showParams(to) })),
          { label: text.import, run: showImport },
        ],
      },
      ...more(),
    ],
  });

  /** @param {string} to */
  async function showParams(to) {
    const { label, file } = text.formats[to];
    const query = new URLSearchParams({
      to,
      method: method().name,
      ...Object.fromEntries(Object.entries(params()).map(([k, v]) => [k, String(v)])),
    });
    const { words: content, trouble } = await fetchText(`/api/params?${query}`);
    const copyButton = h("button", { type: "button", class: "button primary" }, text.copy);
    copyButton.addEventListener("click", async () => {
      await copy(content);
      copyButton.textContent = text.copied;
    });
    const save = h(
      "button",
      { type: "button", class: "button", onclick: () => download(file, content) },
      text.download,
    );
    openDialog(
      text.title(label),
      text.close,
      h("pre", { class: trouble ? "code trouble" : "code", tabIndex: 0 }, trouble ?? content),
      h("div", { class: "dialog-buttons" }, trouble ? null : save, trouble ? null : copyButton),
    );
  }

  function showImport() {
    const area = h("textarea", { class: "code", rows: 10, spellcheck: false, "aria-label": text.importLabel });
    const error = h("p", { class: "panel-error", role: "alert", hidden: true });
    const file = h("input", {
      type: "file",
      class: "off-screen",
      accept: ".yaml,.yml,.launch,.xml,.json,.py,.txt",
      tabIndex: -1,
    });
    file.addEventListener("change", async () => {
      const [chosen] = file.files ?? [];
      if (chosen) area.value = await chosen.text();
    });
    const apply = h("button", { type: "button", class: "button primary" }, text.importApply);
    const choose = h("button", { type: "button", class: "button", onclick: () => file.click() }, text.importFile);
    const dialog = openDialog(
      text.importTitle,
      text.close,
      h("p", { class: "hint" }, text.importHint),
      area,
      error,
      file,
      h("div", { class: "dialog-buttons" }, choose, apply),
    );
    apply.addEventListener("click", async () => {
      apply.disabled = true;
      const why = await onImport(area.value);
      apply.disabled = false;
      error.hidden = !why;
      error.textContent = why;
      if (!why) dialog.close();
    });
    area.focus();
  }

  return { element: menu.element };
}

/** @param {string} url @param {RequestInit} [options] @returns {Promise<{words: string, trouble: string | null}>} */
export async function fetchText(url, options) {
  try {
    const response = await fetch(url, options);
    const words = await response.text();
    return { words, trouble: response.ok ? null : messageOf(words) };
  } catch (error) {
    return { words: "", trouble: String(error) };
  }
}

/** The sentence in an error of the server. @param {string} body */
export function messageOf(body) {
  try {
    return String(JSON.parse(body).message);
  } catch {
    return body.slice(0, 300) || pageText.noAnswer;
  }
}
