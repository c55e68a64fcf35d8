// @ts-check
// Files of the user: chosen, dropped, sent to the server.
import { messageOf } from "../fetch.js";

const PARAMETERS = /\.(ya?ml|launch|xml|json|py)$|flags[^/]*\.txt$/i;
// In a folder these are mostly something else than a recording: parameters, settings, programs.
const MOSTLY_OTHERS = /\.(ya?ml|xml|json|m)$/i;
const PART_OF_BAG = /\.(db3|mcap)(\.zstd)?$/i;
const METADATA = "metadata.yaml";
const NUMBER_OF_PART = /(_\d+)?\.(db3|mcap)(\.zstd)?$/i;
const LARGEST_PARAMETERS = 1_000_000;
// Files with more numbers are no parameter files.
const MOST_PARAMETERS = 300;
// Thirty numbers in brackets, or in lines that begin with dashes.
const LONG_LIST = /\[(?:\s*[-+.\w]+\s*,){29}|(?:^ *(?:- +)+[-+.\d]\S*\s*\n){30}/m;

/** The folders that files were dropped in. @type {WeakMap<File, string>} */
const folders = new WeakMap();

/**
 * Reacts to files dropped anywhere in a window.
 * @param {Window} target the page, or the scene in it
 * @param {{onHover: (over: boolean) => void, onFiles: (files: File[]) => void, suffixes: () => string[]}} handlers
 *   suffixes: of recordings
 */
export function catchDrops(target, { onHover, onFiles, suffixes }) {
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
          filesIn(/** @type {DataTransfer} */ (event.dataTransfer), suffixes()).then(onFiles);
        } else onHover(kind !== "dragleave" || event.relatedTarget !== null);
      },
      true,
    );
  }
}

/**
 * The dropped files; for a folder (a ROS 2 bag), the files directly in it.
 * @param {DataTransfer} data @param {string[]} suffixes of recordings
 */
async function filesIn(data, suffixes) {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry?.());
  const plain = [...data.files];
  const found = await Promise.all(
    entries.map((entry, k) => (entry?.isDirectory ? filesInFolder(entry, suffixes) : [plain[k]])),
  );
  return found.flat().filter((file) => file instanceof File);
}

/**
 * The files in a folder, or in its folders if it has no recording itself.
 * @param {FileSystemEntry} folder @param {string[]} suffixes of recordings
 * @param {number} [depth] of further folders @returns {Promise<File[]>}
 */
async function filesInFolder(folder, suffixes, depth = 2) {
  const entries = await entriesOf(/** @type {FileSystemDirectoryEntry} */ (folder)).catch(() => []);
  const files = await Promise.all(entries.filter(({ isFile }) => isFile).map(fileOf));
  for (const file of files) folders.set(file, folder.fullPath);
  if (!depth || files.some((file) => isRecording(file, suffixes))) return files;
  const inner = entries
    .filter(({ isDirectory }) => isDirectory)
    .map((each) => filesInFolder(each, suffixes, depth - 1));
  return [...files, ...(await Promise.all(inner)).flat()];
}

/** Whether a file in a folder is a recording, by its name. @param {File} file @param {string[]} suffixes of recordings */
function isRecording({ name }, suffixes) {
  return suffixes.some((suffix) => name.toLowerCase().endsWith(suffix)) && !MOSTLY_OTHERS.test(name);
}

/** @param {FileSystemDirectoryEntry} folder @returns {Promise<FileSystemEntry[]>} */
async function entriesOf(folder) {
  const reader = folder.createReader();
  const all = [];
  // It gives a hundred at a time.
  for (;;) {
    const some = await /** @type {Promise<FileSystemEntry[]>} */ (
      new Promise((resolve, reject) => reader.readEntries(resolve, reject))
    );
    if (!some.length) return all;
    all.push(...some);
  }
}

/** @param {FileSystemEntry} entry @returns {Promise<File>} */
function fileOf(entry) {
  return new Promise((resolve, reject) => /** @type {FileSystemFileEntry} */ (entry).file(resolve, reject));
}

/**
 * What several files are: recordings, each of one file or more, or files that look like parameters by their names. The
 * metadata.yaml beside a bag is none of these.
 * @param {File[]} files @param {() => string[]} suffixes of recordings
 * @returns {{kind: "recordings", recordings: File[][]} | {kind: "parameters", files: File[]} | null}
 */
export function pick(files, suffixes) {
  const about = files.filter(({ name }) => name === METADATA);
  const bags = bagsOf(files.filter(({ name }) => PART_OF_BAG.test(name)));
  const rest = files.filter((file) => !PART_OF_BAG.test(file.name) && !(bags.length && about.includes(file)));
  const parameters = rest.filter(({ name, size }) => PARAMETERS.test(name) && size < LARGEST_PARAMETERS);
  const others = rest.filter((file) => !parameters.includes(file));
  // What else lies in a folder was not meant; what was dropped by itself was.
  const single = others.filter((file) => !folders.has(file) || isRecording(file, suffixes()));
  const chosen = bags.length || single.length ? single : others.slice(0, 1);
  const recordings = [
    ...bags.map((parts) => (parts.length > 1 ? [...parts, ...metadataOf(parts, about, bags.length)] : parts)),
    ...chosen.map((file) => [file]),
  ];
  if (recordings.length) return { kind: "recordings", recordings };
  return parameters.length ? { kind: "parameters", files: parameters } : null;
}

/** Parts of one bag are in one folder and differ in the number at the end: run_0.db3, run_1.db3. @param {File[]} parts @returns {File[][]} */
function bagsOf(parts) {
  /** @type {Map<string, File[]>} */
  const bags = new Map();
  for (const part of parts) {
    const key = `${folders.get(part) ?? ""}/${part.name.replace(NUMBER_OF_PART, "")}`;
    bags.set(key, [...(bags.get(key) ?? []), part]);
  }
  return [...bags.values()];
}

/** The metadata.yaml beside these parts, if it is known which one that is. @param {File[]} parts @param {File[]} about @param {number} bags how many there are */
function metadataOf(parts, about, bags) {
  const beside = about.filter((file) => folders.get(file) === folders.get(parts[0]));
  return beside.length === 1 && (bags === 1 || folders.has(parts[0])) ? beside : [];
}

/** Whether a file that may be parameters has scans: a long list, ranges, or many numbers. @param {string} text */
export function hasScans(text) {
  return (
    /^\s*\[/.test(text) ||
    LONG_LIST.test(text) ||
    /\branges\b/.test(text) ||
    (text.match(/\d+(\.\d+)?/g) ?? []).length > MOST_PARAMETERS
  );
}

/** The name of a recording of several files: what their names have in common. @param {File[]} files */
export function nameOfAll(files) {
  const names = files.filter(({ name }) => name !== METADATA).map(({ name }) => name);
  let length = 0;
  while (length < names[0].length && names.every((name) => name[length] === names[0][length])) length++;
  return names[0].slice(0, length).replace(/[\W_]+$/, "") || "bag";
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
function upload(file, onProgress, signal, broken, whole = {}) {
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

/**
 * Sends the files of a recording one after the other.
 * @param {File[]} files
 * @param {(done: number, total: number) => void} onProgress
 * @param {AbortSignal} signal
 * @param {(name: string) => string} broken what to say if the connection breaks
 * @returns {Promise<string>} its id; rejected with a sentence
 */
export async function uploadAll(files, onProgress, signal, broken) {
  const total = files.reduce((sum, { size }) => sum + size, 0);
  let [id, before] = ["", 0];
  for (const file of files) {
    const whole = files.length < 2 ? {} : id ? { into: id } : { bundle: nameOfAll(files) };
    id = await upload(file, (done) => onProgress(before + done, total), signal, broken(file.name), whole);
    before += file.size;
  }
  return id;
}
