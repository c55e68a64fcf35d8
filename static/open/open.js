// @ts-check
// Opens what a person chose or dropped: a recording, a table of a sweep, or parameters.
import { isSweepTable } from "../tune/sweep_table.js";
import { hasLesson, sendLessons } from "../learn/dropped.js";
import { progressIn } from "../learn/progress.js";
import { fetchText } from "../fetch.js";
import { toast } from "../widgets/toast.js";
import { chooseFile } from "../widgets/choose_file.js";
import { catchDrops, hasScans, nameOfAll, pick, uploadAll } from "./files.js";

/**
 * @param {import("../page.js").Page} page
 * @param {{work: ReturnType<typeof import("./work.js").createWork>, notices: ReturnType<typeof import("../stage/notices.js").mountNotices>,
 *   tune: ReturnType<typeof import("../tune/tune.js").createTune>, learn: ReturnType<typeof import("../learn/learn.js").mountLearn>}} shown
 * @param {typeof import("../text/page.js").pageText} text
 * @param {{rest: (name: string) => import("../view/store.js").Patch}} handlers
 *   rest: what else a link says about the file of this name
 */
export function createOpening(page, { work, notices, tune, learn }, text, { rest }) {
  /** @param {File[]} files */
  async function open(files) {
    if (await hasLesson(files)) return openLessons(files);
    const progress = await progressIn(files);
    if (progress) return learn.readProgress(progress);
    const picked = pick(files, known(page));
    if (!picked) return work.refuse(text.stage.nothingDropped);
    if (picked.kind === "recordings") {
      const [[file]] = picked.recordings;
      return (await isSweepTable(file)) ? tune.openSweep(file) : send(picked.recordings);
    }
    const [file] = picked.files;
    const words = await file.text();
    if (hasScans(words)) return send(picked.files.map((each) => [each]));
    const why = await importParams(words);
    if (why) work.refuse(`${file.name}: ${why}`);
    return undefined;
  }

  /** @param {File[]} files lessons and what belongs to them */
  function openLessons(files) {
    return work.run(text.stage.uploading(files[0].name), async (_, signal) => {
      const lessons = await sendLessons(files);
      if (!signal.aborted) learn.takeLessons(lessons);
    });
  }

  /** Sends recordings, and opens the first. @param {File[][]} recordings the files of each */
  function send(recordings) {
    const limit = page.welcome?.uploadLimit ?? Infinity;
    const large = recordings.flat().find(({ size }) => size > limit);
    if (large) {
      cancelWork();
      return work.refuse(text.stage.tooLarge(large.name, megabytes(large.size), megabytes(limit)));
    }
    const [first] = recordings;
    const name = first.length > 1 ? nameOfAll(first) : first[0].name;
    return work.run(text.stage.uploading(name), async (show, signal) => {
      const recording = await uploadAll(first, show, signal, text.stage.uploadFailed);
      if (signal.aborted) return;
      page.change({ ...rest(name), recording });
      for (const others of recordings.slice(1)) await uploadAll(others, show, signal, text.stage.uploadFailed);
      if (recordings.length > 1) toast(text.stage.othersInMenu(recordings.length - 1));
    });
  }

  /** @returns {boolean} whether there was something to cancel */
  function cancelWork() {
    notices.setLoaded();
    return work.cancel();
  }

  function cancel() {
    if (cancelWork()) return;
    page.link?.cancel();
    page.adoptDrawn();
  }

  /** Applies the text of a parameter file or says why it cannot. @param {string} file @returns {Promise<string | null>} */
  async function importParams(file) {
    const query = new URLSearchParams({ method: page.view.method });
    const { words, trouble } = await fetchText(`/api/params?${query}`, { method: "POST", body: file });
    if (trouble) return trouble;
    const { params } = JSON.parse(words);
    const changed = Object.entries(params).filter(([name, value]) => page.view.params[name] !== value);
    if (changed.length) page.change({ params: Object.fromEntries(changed) });
    toast(changed.length ? text.exchange.imported(changed.length) : text.exchange.importedNothing);
    return null;
  }

  return {
    importParams,
    /** Cancels what a person asked for, or else what the server opens. */
    cancel,
    choose: () => chooseFile(open),
    /** Opens what is dropped on a window. @param {Window} target */
    acceptDrops: (target) => catchDrops(target, { onHover: notices.setDropping, onFiles: open, suffixes: known(page) }),
  };
}

/** @param {number} bytes */
function megabytes(bytes) {
  return `${Math.ceil(bytes / 1e6).toLocaleString("en")} MB`;
}

/** Those of recordings; none before the server has named them. @param {import("../page.js").Page} page */
function known(page) {
  return () => page.welcome?.suffixes ?? [];
}
