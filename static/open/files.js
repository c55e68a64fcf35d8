// @ts-check
// Files of the user: chosen, dropped, sent to the server.
import { h } from "../widgets/dom.js";
import { messageOf } from "../fetch.js";

const PARAMETERS = /\.(ya?ml|launch|xml|json|py)$|flags[^/]*\.txt$/i;
const RECORDING_INSIDE = /\.(db3|mcap|bag|log|gz|npz|csv|txt|dat)$/i;
const PART_OF_BAG = /\.(db3|mcap)(\.zstd)?$/i;
const METADATA = "metadata.yaml";
const LARGEST_PARAMETERS = 1_000_000;

/**
 * Reacts to files dropped anywhere in a window.
 * @param {Window} target the page, or the scene in it
 * @param {{onHover: (over: boolean) => void, onFiles: (files: File[]) => void}} handlers
 */
export function catchDrops(target, { onHover, onFiles }) {
  const carriesFiles = (/** @type {DragEvent} */ event) => event.dataTransfer?.types.includes("Files") ?? false;
  for (const kind of /** @type {const} */ (["dragenter", "dragover", "dragleave", "drop"])) {
    target.addEventListener(
      kind,
      (event) => {
        if (!carriesFiles(event)) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        if (kind === "drop") {
          onHover(false);
          filesIn(/** @type {DataTransfer} */ (event.dataTransfer)).then(onFiles);
        } else onHover(kind !== "dragleave" || event.relatedTarget !== null);
      },
      true,
    );
  }
}

/**
 * The dropped files; for a folder (a ROS 2 bag), the files directly in it.
 * @param {DataTransfer} data
 */
async function filesIn(data) {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry?.());
  const plain = [...data.files];
  const found = await Promise.all(entries.map((entry, k) => (entry?.isDirectory ? filesInFolder(entry) : [plain[k]])));
  return found.flat().filter((file) => file instanceof File);
}

/** @param {FileSystemEntry} folder @returns {Promise<File[]>} */
async function filesInFolder(folder) {
  const reader = /** @type {FileSystemDirectoryEntry} */ (folder).createReader();
  const entries = await new Promise((resolve, reject) => reader.readEntries(resolve, reject)).catch(() => []);
  const files = entries.filter((/** @type {FileSystemEntry} */ entry) => entry.isFile);
  return Promise.all(
    files.map(
      (/** @type {FileSystemFileEntry} */ entry) => new Promise((resolve, reject) => entry.file(resolve, reject)),
    ),
  );
}

/**
 * What several files are: recordings, each of one file or more, or parameters. The metadata.yaml beside a bag is not a
 * parameter file.
 * @param {File[]} files
 * @returns {{kind: "recordings", recordings: File[][]} | {kind: "parameters", file: File} | null}
 */
export function pick(files) {
  const parts = files.filter(({ name }) => PART_OF_BAG.test(name));
  if (parts.length > 1) {
    const about = files.filter(({ name }) => name === METADATA);
    const rest = files.filter((file) => !parts.includes(file) && !about.includes(file));
    const others = pick(rest);
    return {
      kind: "recordings",
      recordings: [[...parts, ...about], ...(others?.kind === "recordings" ? others.recordings : [])],
    };
  }
  const parameters = files.filter(({ name, size }) => PARAMETERS.test(name) && size < LARGEST_PARAMETERS);
  const others = files.filter((file) => !parameters.includes(file));
  const recordings = others.filter(({ name }) => RECORDING_INSIDE.test(name));
  const chosen = recordings.length ? recordings : others.slice(0, 1);
  if (chosen.length) return { kind: "recordings", recordings: chosen.map((file) => [file]) };
  return parameters[0] ? { kind: "parameters", file: parameters[0] } : null;
}

/** The name of a recording of several files: what their names have in common. @param {File[]} files */
export function nameOfAll(files) {
  const names = files.filter(({ name }) => name !== METADATA).map(({ name }) => name);
  let length = 0;
  while (length < names[0].length && names.every((name) => name[length] === names[0][length])) length++;
  return names[0].slice(0, length).replace(/[\W_]+$/, "") || "bag";
}

/**
 * @param {(files: File[]) => void} onFiles
 */
export function chooseFile(onFiles) {
  const input = h("input", { type: "file", multiple: true });
  input.addEventListener("change", () => onFiles([...(input.files ?? [])]));
  input.click();
}

/**
 * Sends a recording or, with `whole`, one of its files.
 * @param {File} file
 * @param {(done: number, total: number) => void} onProgress
 * @param {AbortSignal} signal
 * @param {string} broken what to say if the connection breaks
 * @param {{bundle?: string, into?: string}} [whole] bundle: the name of the recording that it is the first file of; into: its id
 * @returns {Promise<string>} its id; rejected with a sentence
 */
export function upload(file, onProgress, signal, broken, whole = {}) {
  const request = new XMLHttpRequest();
  request.open("POST", `/api/upload?${new URLSearchParams({ name: file.name, ...whole })}`);
  request.setRequestHeader("Content-Type", "application/octet-stream");
  request.upload.onprogress = ({ loaded, total }) => onProgress(loaded, total);
  signal.addEventListener("abort", () => request.abort());
  return new Promise((resolve, reject) => {
    request.onerror = request.onabort = () => reject(new Error(broken));
    request.onload = () => {
      if (request.status === 200) resolve(JSON.parse(request.responseText).recording);
      else reject(new Error(messageOf(request.responseText)));
    };
    request.send(file);
  });
}
