// @ts-check
// Opens what a person chose or dropped: a recording, a table of a sweep, or parameters.
import { isSweepTable } from "../tune/sweep_table.js";
import { fetchText } from "../fetch.js";
import { toast } from "../widgets/toast.js";
import { catchDrops, chooseFile, pick, upload } from "./files.js";

/**
 * @param {import("../page.js").Page} page
 * @param {{work: ReturnType<typeof import("./work.js").createWork>, notices: ReturnType<typeof import("../stage/notices.js").mountNotices>}} shown
 * @param {typeof import("../text/page.js").pageText} text
 * @param {{onSweep: (file: File) => void, rest: (name: string) => import("../view/store.js").Patch}} handlers
 *   rest: what else a link says about the file of this name
 */
export function createOpening(page, { work, notices }, text, { onSweep, rest }) {
  /** @param {File[]} files */
  async function open(files) {
    const picked = pick(files);
    if (!picked) return work.refuse(text.stage.nothingDropped);
    if (picked.kind === "recording" && (await isSweepTable(picked.file))) return onSweep(picked.file);
    if (picked.kind === "recording") return send(picked.file);
    const why = await importParams(await picked.file.text());
    if (why) work.refuse(`${picked.file.name}: ${why}`);
    return undefined;
  }

  /** @param {File} file */
  function send(file) {
    const limit = page.welcome?.uploadLimit ?? Infinity;
    if (file.size > limit) {
      cancelWork();
      return work.refuse(text.stage.tooLarge(file.name, megabytes(file.size), megabytes(limit)));
    }
    return work.run(text.stage.uploading(file.name), async (show, signal) => {
      const recording = await upload(file, show, signal, text.stage.uploadFailed(file.name));
      if (!signal.aborted) page.change({ ...rest(file.name), recording });
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
    acceptDrops: (target) => catchDrops(target, { onHover: notices.setDropping, onFiles: open }),
  };
}

/** @param {number} bytes */
function megabytes(bytes) {
  return `${Math.ceil(bytes / 1e6).toLocaleString("en")} MB`;
}
