// @ts-check
// Files of the user: chosen, dropped, sent to the server.
import { h } from "../widgets/dom.js";
import { messageOf } from "../fetch.js";

const PARAMETERS = /\.(ya?ml|launch|xml|json|py)$|flags[^/]*\.txt$/i;
const RECORDING_INSIDE = /\.(db3|mcap|bag|log|gz|npz|csv|txt|dat)$/i;
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
 * Which of several files to open. The metadata.yaml beside a bag is not a parameter file.
 * @param {File[]} files
 * @returns {{kind: "recording" | "parameters", file: File} | null}
 */
export function pick(files) {
  const parameters = files.filter(({ name, size }) => PARAMETERS.test(name) && size < LARGEST_PARAMETERS);
  const others = files.filter((file) => !parameters.includes(file));
  const recording = others.find(({ name }) => RECORDING_INSIDE.test(name)) ?? others[0];
  if (recording) return { kind: "recording", file: recording };
  return parameters[0] ? { kind: "parameters", file: parameters[0] } : null;
}

/**
 * @param {(files: File[]) => void} onFiles
 */
export function chooseFile(onFiles) {
  const input = h("input", { type: "file" });
  input.addEventListener("change", () => onFiles([...(input.files ?? [])]));
  input.click();
}

/**
 * Sends a recording.
 * @param {File} file
 * @param {(done: number, total: number) => void} onProgress
 * @param {AbortSignal} signal
 * @param {string} broken what to say if the connection breaks
 * @returns {Promise<string>} its id; rejected with a sentence
 */
export function upload(file, onProgress, signal, broken) {
  const request = new XMLHttpRequest();
  request.open("POST", `/api/upload?name=${encodeURIComponent(file.name)}`);
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
