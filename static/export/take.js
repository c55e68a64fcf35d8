// @ts-check
// Exports of the frame, the lesson and the recording: pictures, pages, failure packs, segments.
import { download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { fetchMap } from "./line_map.js";
import { pngOf } from "./picture.js";
import { fetchFile } from "./save.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {(done: number, total: number) => void} Progress */
/** @typedef {(words: string, run: (show: Progress, signal: AbortSignal) => Promise<void>) => void} Work */

/**
 * @param {typeof import("../text/export.js").exportText} text
 * @param {{session: () => string, state: () => State | null, note: () => string, work: Work}} handlers
 *   note: of the frame; work: runs something long, with progress and a way to cancel it
 */
export function createTake(text, { session, state, note, work }) {
  /** @param {string} what @param {Record<string, string>} [more] */
  const address = (what, more) => `/api/${what}?${new URLSearchParams({ session: session(), ...more })}`;

  /** @param {"svg" | "png"} kind */
  function savePicture(kind) {
    work(text.drawing, async (_show, signal) => {
      const { name, content } = await fetchFile(address("figure"), text.broken, { signal });
      download(name.replace(/svg$/, kind), kind === "svg" ? content : await pngOf(content, text.noPicture));
    });
  }

  /** @param {string} to */
  function saveSegments(to) {
    const { label, frames } = state() ?? { label: "", frames: 0 };
    work(text.making(label), async (show, signal) => {
      const { name, content } = await fetchFile(address("segments", { to }), text.broken, { signal }, (frame) =>
        show(frame + 1, frames),
      );
      download(name, content);
    });
  }

  function askNote() {
    const known = note() || (state()?.pack?.note ?? "");
    const words = h("textarea", {
      rows: 5,
      class: "note",
      value: known,
      placeholder: text.note.placeholder,
    });
    const error = h("p", { class: "panel-error", role: "alert", hidden: true });
    const save = h("button", { type: "button", class: "button primary" }, text.note.save);
    const dialog = openDialog(
      text.note.title,
      text.note.close,
      h("p", { class: "hint" }, text.note.hint),
      h("label", { class: "note-label" }, text.note.label(known !== ""), words),
      error,
      h("div", { class: "dialog-buttons" }, save),
    );
    save.addEventListener("click", async () => {
      save.disabled = true;
      try {
        const { name, content } = await fetchFile(address("pack"), text.broken, {
          method: "POST",
          body: words.value.trim(),
        });
        download(name, content);
        dialog.close();
      } catch (trouble) {
        error.textContent = trouble instanceof Error ? trouble.message : String(trouble);
        error.hidden = save.disabled = false;
      }
    });
    words.focus();
  }

  return {
    /** @returns {import("../widgets/menu.js").Group[]} */
    groups: () => [
      {
        title: text.frame,
        items: [
          { label: text.png, run: () => savePicture("png") },
          { label: text.svg, run: () => savePicture("svg") },
          ...pages(text, state()?.view.lesson ?? null, (what) => savePage(work, text, address("handout", { what }))),
          { label: text.pack, run: askNote },
        ],
      },
      {
        title: text.all,
        items: Object.entries(text.formats).map(([to, label]) => ({ label, run: () => saveSegments(to) })),
      },
      ...(state()?.mayHavePoses ? [maps(work, text, (to) => address("line-map", { to }))] : []),
    ],
  };
}

/** @param {Work} work @param {typeof import("../text/export.js").exportText} text @param {(to: string) => string} url @returns {import("../widgets/menu.js").Group} */
function maps(work, text, url) {
  const save = (/** @type {string} */ to) =>
    work(text.mapping, async (show, signal) => {
      const { name, content } = await fetchMap(url(to), text.broken, show, signal);
      download(name, content);
    });
  const items = Object.entries(text.maps).map(([to, label]) => ({ label, run: () => save(to) }));
  return { title: text.map, items };
}

/**
 * Pages that stand alone: of the frame, and of the lesson, if one is open.
 * @param {typeof import("../text/export.js").exportText} text @param {string | null} lesson @param {(what: "frame" | "lesson") => void} save
 * @returns {import("../widgets/menu.js").Item[]}
 */
function pages(text, lesson, save) {
  const frame = { label: text.page, run: () => save("frame") };
  if (!lesson) return [frame];
  const print = () => void open(`/lessons/${encodeURIComponent(lesson)}/print`, "_blank", "noopener");
  return [frame, { label: text.lessonPage, run: () => save("lesson") }, { label: text.sheet, run: print }];
}

/** @param {Work} work @param {typeof import("../text/export.js").exportText} text @param {string} url */
function savePage(work, text, url) {
  work(text.storing, async (_show, signal) => {
    const { name, content } = await fetchFile(url, text.broken, { signal });
    download(name, content);
  });
}
