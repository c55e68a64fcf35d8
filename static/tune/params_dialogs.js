// @ts-check
// Dialogs that show parameters as text in a format, or take pasted text.
import { copy, download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { fetchText } from "../fetch.js";

/** @typedef {typeof import("../text/page.js").pageText.exchange} Text */

/** @param {Text} text @param {string} to the format @param {{session: string, method: string}} of the tab @param {import("../wire.js").Params} params */
export async function showParams(text, to, of, params) {
  const { label, file } = text.formats[to];
  const values = Object.entries(params).map(([name, value]) => [name, String(value)]);
  const query = new URLSearchParams({ to, ...of, ...Object.fromEntries(values) });
  const { words, trouble } = await fetchText(`/api/params?${query}`);
  const copyButton = h("button", { type: "button", class: "button primary" }, text.copy);
  copyButton.addEventListener("click", async () => {
    await copy(words);
    copyButton.textContent = text.copied;
  });
  const save = h("button", { type: "button", class: "button", onclick: () => download(file, words) }, text.download);
  openDialog(
    text.title(label),
    text.close,
    h("pre", { class: trouble ? "code trouble" : "code", tabIndex: 0 }, trouble ?? words),
    h("div", { class: "dialog-buttons" }, ...(trouble ? [] : [save, copyButton])),
  );
}

/** @param {Text} text @param {(file: string) => Promise<string | null>} onImport applies the text, or says why not */
export function showImport(text, onImport) {
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
