// @ts-check
// The table of a sweep (`lineseg sweep`), read by the server: any two of its thresholds as a map.
import { messageOf } from "../fetch.js";

/** @typedef {import("../wire.js").Params} Params */
/** @typedef {(number | null)[]} Column */
/** @typedef {import("../wire.js").SweepTable} Columns */
/** @typedef {{height: number, params: Params}} Cell */

const HEAD = "file,epsilon,";

/** Whether a file is the table of a sweep, judged by its name or first words. @param {File} file */
export async function isSweepTable(file) {
  if (/\.parquet$/i.test(file.name)) return true;
  return (
    /\.csv$/i.test(file.name) && (await file.slice(0, HEAD.length + 3).text()).replace(/^\ufeff/, "").startsWith(HEAD)
  );
}

/** @param {File} file @param {string} broken what to say without an answer @returns {Promise<{table?: SweepTable, trouble?: string}>} */
export async function readSweepTable(file, broken) {
  try {
    const response = await fetch(`/api/sweep-table?name=${encodeURIComponent(file.name)}`, {
      method: "POST",
      body: file,
    });
    const words = await response.text();
    return response.ok ? { table: new SweepTable(file.name, JSON.parse(words)) } : { trouble: messageOf(words) };
  } catch {
    return { trouble: broken };
  }
}

export class SweepTable {
  #columns;

  /** @param {string} name @param {Columns} columns */
  constructor(name, columns) {
    this.#columns = columns;
    this.name = name;
  }

  get files() {
    return this.#columns.files;
  }

  get axes() {
    return this.#columns.axes;
  }

  get measures() {
    return this.#columns.measures;
  }

  get settings() {
    return Object.values(this.axes).reduce((product, values) => product * values.length, 1);
  }

  /**
   * A measure over two thresholds, with the best value over the others; one row for each value of y, null where there is none.
   * @param {string} x @param {string} y @param {string} measure @param {boolean} lower is better
   * @param {number | null} file null: the mean over the files, by their frames
   */
  relief(x, y, measure, lower, file) {
    const { [x]: xs, [y]: ys } = this.axes;
    /** @type {(Cell | null)[][]} */
    const cells = ys.map(() => xs.map(() => null));
    for (const { params, height } of this.#settings(measure, file)) {
      const [i, j] = [xs.indexOf(params[x]), ys.indexOf(params[y])];
      const best = cells[j][i];
      if (!best || (lower ? height < best.height : height > best.height)) cells[j][i] = { height, params };
    }
    return { xs, ys, cells, heights: cells.map((row) => row.map((cell) => cell?.height ?? null)) };
  }

  /** @param {string} measure @param {number | null} wanted @returns {Iterable<Cell>} */
  #settings(measure, wanted) {
    const { file, columns } = this.#columns;
    const names = Object.keys(this.axes);
    /** @type {Map<string, {sum: number, frames: number, params: Params}>} */
    const found = new Map();
    file.forEach((from, row) => {
      const value = columns[measure][row];
      if (value === null || (wanted !== null && from !== wanted)) return;
      const frames = columns.frames[row] ?? 0;
      const values = names.map((name) => /** @type {number} */ (columns[name][row]));
      const setting = found.get(values.join()) ?? {
        sum: 0,
        frames: 0,
        params: Object.fromEntries(names.map((name, k) => [name, values[k]])),
      };
      setting.sum += value * frames;
      setting.frames += frames;
      found.set(values.join(), setting);
    });
    return [...found.values()].map(({ sum, frames, params }) => ({ params, height: sum / frames }));
  }
}
