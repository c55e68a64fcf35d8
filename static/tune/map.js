// @ts-check
// A measure over two thresholds, with contours; a click sets both. Of the recording on the screen, or of a sweep that was opened.
import { h, setText } from "../widgets/dom.js";
import { placeOf, valueAt, withUnit } from "../widgets/scale.js";
import { chooseFile } from "../open/files.js";
import { contour } from "./contours.js";
import { readSweepTable } from "./sweep_table.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("./workbench.js").Answer} Answer */
/** @typedef {import("./workbench.js").Measure} Measure */

const LEVELS = 8;
// What is measured of the recording on the screen; a sweep may know more.
const LIVE = ["coverage", "segments", "true_rate", "false_rate", "completeness", "f_score"];
// Dark to light, as viridis: lightness alone tells heights apart.
const STOPS = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

/**
 * @param {typeof import("../text/tuning.js").tuningText.map} text
 * @param {{ask: (x: string, y: string, measure: string) => void, stop: () => void, onSet: (params: Params) => void}} handlers
 */
export function createMap(text, { ask, stop, onSet }) {
  /** @type {Knob[]} */
  let knobs = [];
  /** @type {Measure[]} */
  let measures = [];
  /** @type {import("./sweep_table.js").SweepTable | null} */
  let table = null;
  /** @type {ReturnType<import("./sweep_table.js").SweepTable["relief"]> | null} */
  let relief = null;
  /** @type {Params} */
  let params = {};
  /** @type {Answer | null} */
  let shown = null;
  let running = false;
  let asked = "";
  let measureChosen = false;

  const choice = (/** @type {string} */ label) =>
    h("select", { class: "select", "aria-label": label, onchange: begin });
  const [x, y, measure] = [choice(text.x), choice(text.y), choice(text.measure)];
  measure.addEventListener("change", () => (measureChosen = true));
  const file = choice(text.file);
  const files = field(text.file, file);
  files.hidden = true;
  const source = h("span", { class: "map-source muted" });
  const close = h(
    "button",
    { type: "button", class: "button", hidden: true, onclick: () => setTable(null) },
    text.close,
  );
  const canvas = h("canvas", { class: "map-canvas", role: "img" });
  const [up, across] = [h("span", { class: "map-up muted" }), h("span", { class: "map-across muted" })];
  const readout = h("p", { class: "map-readout" });
  const state = h("span", { class: "muted", role: "status" });
  const button = h(
    "button",
    { type: "button", class: "button", onclick: () => (running ? stop() : begin()) },
    text.again,
  );
  const opening = h(
    "button",
    {
      type: "button",
      class: "button",
      title: text.openHelp,
      onclick: () => chooseFile(([chosen]) => chosen && open(chosen)),
    },
    text.open,
  );
  const scale = h("div", { class: "map-scale muted" });
  const hint = h("p", { class: "hint" }, text.hint);
  const element = h(
    "div",
    { class: "map-page" },
    h("div", { class: "map-choices" }, field(text.measure, measure), field(text.x, x), field(text.y, y), files),
    source,
    h("div", { class: "map-frame" }, up, canvas),
    across,
    scale,
    readout,
    h("div", { class: "map-foot" }, button, close, opening, state),
    hint,
  );
  new ResizeObserver(paint).observe(canvas);
  new MutationObserver(() => (element.hidden ? running && stop() : wanted())).observe(element, {
    attributeFilter: ["hidden"],
  });

  const knobOf = (/** @type {string} */ name) => /** @type {Knob} */ (knobs.find((knob) => knob.name === name));
  /** What an axis spans: the slider, or the values that were swept. @param {string} name @returns {Knob} */
  const spanOf = (name) => {
    const values = table?.axes[name];
    return values
      ? { ...knobOf(name), low: values[0], high: values[values.length - 1], log: knobOf(name).log && values[0] > 0 }
      : knobOf(name);
  };

  /** What the map depends on: all but the two thresholds that it spans. */
  function key() {
    const rest = Object.entries(params).filter(([name]) => name !== x.value && name !== y.value);
    return JSON.stringify([x.value, y.value, measure.value, rest]);
  }

  function begin() {
    if (!knobs.length || !measures.length) return;
    if (x.value === y.value) y.value = [...y.options].find((option) => option.value !== x.value)?.value ?? "";
    if (table) return draw();
    asked = key();
    setRunning(true, text.starting);
    ask(x.value, y.value, measure.value);
  }

  function wanted() {
    if (!table && !element.hidden && key() !== asked) begin();
  }

  function draw() {
    const lower = measures.find(({ name }) => name === measure.value)?.better === "lower";
    relief = table?.relief(x.value, y.value, measure.value, lower, file.value ? Number(file.value) : null) ?? null;
    shown = relief && { type: "map", job: 0, x: x.value, y: y.value, measure: measure.value, ...relief };
    paint();
  }

  /** @param {File} chosen */
  async function open(chosen) {
    setText(state, text.reading(chosen.name));
    const { table: read, trouble } = await readSweepTable(chosen, text.broken);
    setText(state, trouble ?? "");
    state.classList.toggle("trouble", Boolean(trouble));
    if (read) setTable(read);
  }

  /** @param {import("./sweep_table.js").SweepTable | null} next null: back to the recording */
  function setTable(next) {
    if (running) stop();
    table = next;
    relief = shown = null;
    asked = "";
    button.hidden = table !== null;
    close.hidden = table === null;
    files.hidden = !table || table.files.length < 2;
    file.replaceChildren(
      h("option", { value: "" }, text.allFiles),
      ...(table?.files ?? []).map((name, k) => h("option", { value: String(k) }, name.split(/[\\/]/).pop())),
    );
    setText(source, table ? text.sweep(table.name, table.settings, table.files.length) : "");
    setText(hint, table ? text.hintOfSweep : text.hint);
    offer();
    begin();
  }

  /** The thresholds and measures that there are to choose from. */
  function offer() {
    const axes = knobs.filter(({ name }) => !table || table.axes[name]);
    [x, y].forEach((select, k) => {
      const chosen = select.value;
      select.replaceChildren(
        ...axes.map(({ name, symbol, label }) => h("option", { value: name }, `${symbol} ${label}`)),
      );
      select.value = axes.some(({ name }) => name === chosen) ? chosen : (axes[k]?.name ?? "");
    });
    const chosen = measure.value;
    const there = measures.filter(({ name }) => (table ? table.measures.includes(name) : LIVE.includes(name)));
    measure.replaceChildren(...there.map(({ name, label, help }) => h("option", { value: name, title: help }, label)));
    measure.value = there.some(({ name }) => name === chosen)
      ? chosen
      : ((there.find(({ name }) => name === "f_score") ?? there[0])?.name ?? "");
  }

  /** @param {boolean} on @param {string} words */
  function setRunning(on, words) {
    running = on;
    button.textContent = on ? text.stop : text.again;
    setText(state, words);
  }

  function paint() {
    const pen = canvas.getContext("2d");
    if (!pen || !shown?.heights?.length || !canvas.clientWidth) return;
    const ratio = devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    const { heights, xs = [], ys = [] } = shown;
    const known = heights.flat().filter((height) => height !== null);
    setText(readout, known.length ? "" : text.nothing);
    if (!known.length) return;
    const [low, high] = [Math.min(...known), Math.max(...known)];
    const [kx, ky] = [spanOf(shown.x ?? ""), spanOf(shown.y ?? "")];
    const px = xs.map((value) => placeOf(kx, value) * canvas.width);
    const py = ys.map((value) => (1 - placeOf(ky, value)) * canvas.height);
    heights.forEach((row, j) =>
      row.forEach((height, i) => {
        if (height === null) return;
        pen.fillStyle = shade(high > low ? (height - low) / (high - low) : 1);
        const [left, right] = edges(px, i, 0, canvas.width);
        const [bottom, top] = edges(py, j, canvas.height, 0);
        pen.fillRect(Math.floor(left), Math.floor(top), Math.ceil(right - left) + 1, Math.ceil(bottom - top) + 1);
      }),
    );
    pen.strokeStyle = "rgb(255 255 255 / 75%)";
    pen.lineWidth = ratio;
    pen.beginPath();
    for (let k = 1; k < LEVELS && high > low; k++) {
      for (const [x1, y1, x2, y2] of contour(heights, low + ((high - low) * k) / LEVELS)) {
        pen.moveTo(between(px, x1), between(py, y1));
        pen.lineTo(between(px, x2), between(py, y2));
      }
    }
    pen.stroke();
    if (within(kx) && within(ky))
      ring(pen, placeOf(kx, params[kx.name]) * canvas.width, (1 - placeOf(ky, params[ky.name])) * canvas.height, ratio);
    const words = measures.find(({ name }) => name === shown?.measure);
    setText(scale, `${words?.label ?? ""} ${low.toFixed(3)} – ${high.toFixed(3)} ${words?.unit ?? ""}`);
    setText(across, `${kx.symbol} ${withUnit(kx, kx.low)} – ${withUnit(kx, kx.high)}`);
    setText(up, `${ky.symbol} ${withUnit(ky, ky.low)} – ${withUnit(ky, ky.high)}`);
    canvas.setAttribute("aria-label", text.picture(words?.label ?? "", kx.symbol, ky.symbol));
  }

  /** Whether the present value of a threshold is on its axis. @param {Knob} knob */
  function within({ name, low, high }) {
    return params[name] >= low && params[name] <= high;
  }

  /** The setting under the pointer, of a sweep the whole of it, and the height there. @param {MouseEvent} event @returns {{params: Params, height: number | null}} */
  function under(event) {
    const box = canvas.getBoundingClientRect();
    const [kx, ky] = [spanOf(shown?.x ?? x.value), spanOf(shown?.y ?? y.value)];
    const values = {
      [kx.name]: valueAt(kx, (event.clientX - box.left) / box.width),
      [ky.name]: valueAt(ky, 1 - (event.clientY - box.top) / box.height),
    };
    const [i, j] = [nearest(kx, shown?.xs ?? [], values[kx.name]), nearest(ky, shown?.ys ?? [], values[ky.name])];
    return { params: relief?.cells[j]?.[i]?.params ?? values, height: shown?.heights?.[j]?.[i] ?? null };
  }
  canvas.addEventListener("click", (event) => shown && onSet(under(event).params));
  canvas.addEventListener("pointermove", (event) => {
    if (!shown?.heights?.length) return;
    const { params: values, height } = under(event);
    const words = Object.entries(values).map(
      ([name, value]) => `${knobOf(name).symbol} ${withUnit(knobOf(name), value)}`,
    );
    setText(readout, `${words.join(", ")}: ${height === null ? "–" : height.toFixed(3)}`);
  });

  return {
    element,
    /** @param {Knob[]} next */
    setKnobs(next) {
      knobs = next;
      offer();
    },
    /** @param {Measure[]} next */
    setMeasures(next) {
      measures = next;
      offer();
    },
    /** The measure that says most, until another is chosen. @param {boolean} truth */
    setTruth(truth) {
      if (table) return;
      if (!measureChosen && measures.length) measure.value = truth ? "f_score" : "coverage";
      for (const option of measure.options)
        option.disabled = !truth && Boolean(measures.find(({ name }) => name === option.value)?.truth);
    },
    /** @param {Params} next */
    setParams(next) {
      params = next;
      paint();
      wanted();
    },
    /** Shows the table of a sweep. */
    open,
    /** Another recording: all is to be computed anew. */
    forget() {
      if (table) return;
      asked = "";
      shown = null;
      wanted();
    },
    /** @param {Answer} answer */
    receive(answer) {
      if (table) return setRunning(false, "");
      if (answer.heights) {
        shown = answer;
        setText(state, text.working(answer.frames ?? 0));
        paint();
      }
      if (answer.done) setRunning(false, answer.message ?? (answer.stopped ? text.stopped : ""));
      return undefined;
    },
    get current() {
      return (
        shown && {
          x: shown.x,
          y: shown.y,
          measure: shown.measure,
          sweep: table?.name,
          side: shown.xs?.length,
          frames: shown.frames,
          heights: shown.heights,
          running,
        }
      );
    },
  };
}

/** @param {string} label @param {HTMLElement} control */
function field(label, control) {
  return h("label", { class: "map-field" }, h("span", { class: "muted" }, label), control);
}

/** @param {number} place 0 to 1 */
function shade(place) {
  const at = place * (STOPS.length - 1);
  const from = Math.min(Math.floor(at), STOPS.length - 2);
  return `rgb(${STOPS[from].map((one, k) => Math.round(one + (at - from) * (STOPS[from + 1][k] - one))).join(" ")})`;
}

/** The borders of a cell, half way to its neighbours. @param {number[]} places @param {number} k @param {number} first @param {number} last */
function edges(places, k, first, last) {
  return [
    k === 0 ? first : (places[k - 1] + places[k]) / 2,
    k === places.length - 1 ? last : (places[k] + places[k + 1]) / 2,
  ];
}

/** @param {number[]} places @param {number} at */
function between(places, at) {
  const k = Math.min(Math.floor(at), places.length - 2);
  return places[k] + (at - k) * (places[k + 1] - places[k]);
}

/** @param {Knob} knob @param {number[]} values @param {number} value */
function nearest(knob, values, value) {
  const distances = values.map((each) => Math.abs(placeOf(knob, each) - placeOf(knob, value)));
  return distances.indexOf(Math.min(...distances));
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} ratio */
function ring(pen, x, y, ratio) {
  for (const [colour, width] of /** @type {const} */ ([
    ["#000", 4],
    ["#fff", 2],
  ])) {
    pen.strokeStyle = colour;
    pen.lineWidth = width * ratio;
    pen.beginPath();
    pen.arc(x, y, 6 * ratio, 0, 2 * Math.PI);
    pen.stroke();
  }
}
