// @ts-check
// Under each slider a small curve of what the recording gives over its range.
import { h, setText, svg } from "../widgets/dom.js";
import { placeOf, valueAt, withUnit } from "../widgets/scale.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("./workbench.js").Curve} Curve */

const WIDTH = 1000;
const HEIGHT = 100;
const LINES = ["coverage", "segments", "true_rate", "false_rate", "completeness"];
const KEY = "lineseg.curves";

/**
 * The legend, in which lines are switched, and a curve for each threshold.
 * @param {typeof import("../text/tuning.js").tuningText.curves} text
 * @param {{onSet: (name: string, value: number) => void, onShow: (shown: boolean) => void}} handlers
 */
export function createSensitivity(text, { onSet, onShow }) {
  const hidden = new Set(JSON.parse(localStorage.getItem(KEY) ?? "[]"));
  const note = h("span", { class: "curves-note muted", role: "status" });
  const all = h("button", { type: "button", class: "curve-key all", onclick: () => toggle("all") }, text.show);
  tooltip(all, text.help, "left");
  const keys = new Map(
    LINES.map((line) => [
      line,
      h(
        "button",
        { type: "button", class: "curve-key", "data-line": line, onclick: () => toggle(line) },
        h("span", { class: "swatch" }),
        text.short[line],
      ),
    ]),
  );
  const legend = h(
    "div",
    { class: "curves-legend", role: "group", "aria-label": text.label },
    all,
    ...keys.values(),
    note,
  );
  /** @type {Map<string, ReturnType<typeof createCurve>>} */
  let curves = new Map();
  let truth = false;

  /** @param {string} line */
  function toggle(line) {
    if (!hidden.delete(line)) hidden.add(line);
    localStorage.setItem(KEY, JSON.stringify([...hidden]));
    show();
    if (line === "all") onShow(shown());
  }

  const shown = () => !hidden.has("all");

  function show() {
    all.setAttribute("aria-pressed", String(shown()));
    for (const [line, key] of keys) {
      key.setAttribute("aria-pressed", String(!hidden.has(line)));
      key.hidden = !shown() || (!truth && LINES.indexOf(line) > 1);
    }
    note.hidden = !shown();
    for (const curve of curves.values()) {
      curve.element.hidden = !shown();
      curve.showOnly(hidden);
    }
  }
  show();

  return {
    legend,
    shown,
    /** @param {Knob[]} knobs @param {(name: string) => HTMLElement | null} holder */
    setKnobs(knobs, holder) {
      curves = new Map(knobs.map((knob) => [knob.name, createCurve(knob, text, (value) => onSet(knob.name, value))]));
      for (const [name, curve] of curves) holder(name)?.append(curve.element);
      show();
    },
    /** @param {import("../wire.js").Params} params */
    setParams(params) {
      for (const [name, value] of Object.entries(params)) curves.get(name)?.mark(value);
    },
    pending() {
      setText(note, text.pending);
    },
    /** @param {import("./workbench.js").Answer} answer */
    receive({ curves: found, frames, of, message, done }) {
      if (message) setText(note, message);
      if (done || !found) return;
      setText(note, text.sample(frames ?? 0, of ?? 0));
      truth = Object.values(found).some((curve) => "true_rate" in curve);
      for (const [name, curve] of Object.entries(found)) curves.get(name)?.set(curve);
      show();
    },
    get hasTruth() {
      return truth;
    },
  };
}

/**
 * @param {Knob} knob
 * @param {typeof import("../text/tuning.js").tuningText.curves} text
 * @param {(value: number) => void} onSet
 */
function createCurve(knob, text, onSet) {
  const picture = svg("svg", {
    class: "curve-picture",
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    preserveAspectRatio: "none",
    "aria-hidden": "true",
  });
  const paths = new Map(
    LINES.map((line) => [
      line,
      svg("path", { class: "curve-line", "data-line": line, "vector-effect": "non-scaling-stroke" }),
    ]),
  );
  const mark = svg("line", { class: "curve-mark", y1: 0, y2: HEIGHT, "vector-effect": "non-scaling-stroke" });
  picture.append(...paths.values(), mark);
  const element = h("div", { class: "curve", role: "img", "aria-label": text.picture(knob.symbol) });
  element.append(picture);
  /** @type {Curve | null} */
  let curve = null;
  const placeAt = (/** @type {MouseEvent} */ event) => {
    const { left, width } = picture.getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - left) / width));
  };
  element.addEventListener("click", (event) => onSet(valueAt(knob, placeAt(event))));
  element.addEventListener("pointermove", (event) => {
    element.title = curve ? words(knob, curve, placeAt(event), text) : "";
  });
  return {
    element,
    /** @param {Curve} next */
    set(next) {
      curve = next;
      const most = Math.max(1e-9, ...next.segments.map((value) => value ?? 0));
      for (const [line, path] of paths) {
        path.setAttribute("d", next[line] ? pathOf(knob, next.values, next[line], line === "segments" ? most : 1) : "");
      }
    },
    /** @param {Set<string>} hidden */
    showOnly(hidden) {
      for (const [line, path] of paths) path.style.display = hidden.has(line) ? "none" : "";
    },
    /** @param {number} value */
    mark(value) {
      const x = String(placeOf(knob, value) * WIDTH);
      mark.setAttribute("x1", x);
      mark.setAttribute("x2", x);
    },
  };
}

/** @param {Knob} knob @param {number[]} values @param {(number | null)[]} heights @param {number} most */
function pathOf(knob, values, heights, most) {
  let path = "";
  let pen = "M";
  heights.forEach((height, k) => {
    if (height === null) {
      pen = "M";
      return;
    }
    path += `${pen}${(placeOf(knob, values[k]) * WIDTH).toFixed(1)} ${((1 - (0.94 * height) / most) * HEIGHT - 3).toFixed(1)}`;
    pen = "L";
  });
  return path;
}

/** @param {Knob} knob @param {Curve} curve @param {number} place @param {typeof import("../text/tuning.js").tuningText.curves} text */
function words(knob, curve, place, text) {
  const distances = curve.values.map((value) => Math.abs(placeOf(knob, value) - place));
  const k = distances.indexOf(Math.min(...distances));
  const parts = LINES.filter((line) => curve[line] && curve[line][k] !== null).map(
    (line) => `${text.short[line]} ${Number(curve[line][k]).toFixed(2)}`,
  );
  return `${knob.symbol} ${withUnit(knob, curve.values[k])}: ${parts.join(", ")}`;
}
