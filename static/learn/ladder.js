// @ts-check
// From one step to all steps: every window tried, and one threshold over its whole range.
import { h, setText } from "../widgets/dom.js";
import { format, placeOf, valueAt, withUnit } from "../widgets/scale.js";
import { createSlider, gestureCount } from "../widgets/slider.js";
import { createWalk } from "../widgets/walk.js";
import { colour, onTheme } from "./colours.js";
import { fetchInto } from "./fetched.js";

/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {{name: string, beams: number, values: number[], lines: number[], runs: [number, number, string][][]}} Sweep */

const TONES = /** @type {Record<string, string>} */ ({
  "": "--accent",
  delta: "--failed",
  epsilon: "--trouble",
  max_dropout: "--muted",
  max_gap: "--muted",
});

/**
 * @param {typeof import("../text/learn.js").learnText.ladder} text
 * @param {{session: () => string, onGo: (step: number) => void, onParams: (params: Params, gesture: string | null) => void}} handlers
 */
export function createLadder(text, { session, onGo, onParams }) {
  /** @type {Trace | null} */
  let trace = null;
  /** Decisions about windows. @type {number[]} */
  let tried = [];
  /** @type {Knob[]} */
  let knobs = [];
  /** @type {Params} */
  let params = {};
  /** @type {Sweep | null} */
  let swept = null;
  let name = "epsilon";
  /** What the picture was made from; it is made anew when that changes. */
  let made = "";
  let frame = "";
  let busy = false;

  const seeds = h("canvas", { class: "chart-canvas" });
  const seedsSaid = h("span", { class: "off-screen" });
  const seedsNow = h("span", { class: "muted", "aria-hidden": "true" });
  const legend = h(
    "span",
    { class: "ladder-legend" },
    ...Object.entries(text.tones).map(([check, words]) =>
      h("span", {}, h("i", { class: `key key-${check || "found"}` }), words),
    ),
  );
  const picture = h("canvas", { class: "sweep-canvas", role: "img" });
  const trouble = h("div", { class: "sweep-trouble" });
  const choice = h("select", {
    class: "select",
    "aria-label": text.threshold,
    onchange: () => ((name = choice.value), refresh()),
  });
  const value = h("span", { class: "muted sweep-value" });
  const slider = createSlider({
    label: text.threshold,
    onPlace: (place) => set(valueAt(knob(), place)),
    onSteps: (steps) => set(Number.isFinite(steps) ? step(steps) : steps < 0 ? knob().low : knob().high),
    fill: false,
  });
  const element = h(
    "div",
    { class: "ladder", hidden: true },
    h("figure", { class: "chart" }, h("figcaption", {}, text.seeds, legend, seedsNow), seeds, seedsSaid),
    h(
      "figure",
      { class: "chart sweep" },
      h("figcaption", {}, choice, h("span", {}, text.sweep), value),
      picture,
      slider.element,
      trouble,
    ),
  );

  function knob() {
    return /** @type {Knob} */ (knobs.find((each) => each.name === name) ?? knobs[0]);
  }

  /** @param {number} steps */
  function step(steps) {
    const { step: by, low, high } = knob();
    return Math.min(Math.max(Number((params[name] + steps * by).toPrecision(6)), low), high);
  }

  /** @param {number} next */
  function set(next) {
    onParams({ [name]: next }, `sweep ${name} ${gestureCount()}`);
  }

  picture.addEventListener("click", (event) => {
    if (swept)
      set(
        swept.values[
          Math.min(Math.floor((event.offsetX / picture.clientWidth) * swept.values.length), swept.values.length - 1)
        ],
      );
  });
  const walk = createWalk(seeds, text.seeds, {
    count: () => tried.length,
    start: () => 0,
    say: (at) => sayWindow(tried[at]),
    onAt(at) {
      tell(at === null ? null : tried[at]);
      drawSeeds();
    },
    onTake: (at) => onGo(tried[at]),
  });
  seeds.addEventListener("pointermove", (event) => tell(windowAt(event.offsetX)));
  seeds.addEventListener("pointerleave", () => tell(null));
  seeds.addEventListener("click", (event) => {
    const at = windowAt(event.offsetX);
    if (at !== null) onGo(at);
  });

  /** The decision about the window that begins nearest to a place of the band. @param {number} x */
  function windowAt(x) {
    if (!trace) return null;
    const beam = (x / seeds.clientWidth) * trace.beams;
    let best = null;
    for (const index of tried)
      if (best === null || Math.abs(trace.columns.first[index] - beam) < Math.abs(trace.columns.first[best] - beam))
        best = index;
    return best;
  }

  /** Names a window instead of the legend. @param {number | null} index of a decision about it */
  function tell(index) {
    setText(seedsNow, index === null ? "" : sayWindow(index));
  }

  /** @param {number} index of a decision about a window */
  function sayWindow(index) {
    const { columns: c } = /** @type {Trace} */ (trace);
    const check = c.checks[c.check[index]];
    return text.window(c.first[index], c.last[index], text.tones[check] ?? text.tones.max_dropout);
  }

  /** @param {HTMLCanvasElement} canvas */
  function fresh(canvas) {
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    const { clientWidth: width, clientHeight: height } = canvas;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    pen.scale(devicePixelRatio, devicePixelRatio);
    return { pen, width, height };
  }

  function drawSeeds() {
    if (!trace || !seeds.clientWidth) return;
    const { pen, width, height } = fresh(seeds);
    const { columns: c, beams } = trace;
    const counts = /** @type {Record<string, number>} */ ({});
    // Windows lie in four lanes, one a fate, each as wide as its beams.
    const lanes = Object.keys(text.tones);
    /** @type {[number, number, number, number] | null} */
    let marked = null;
    pen.strokeStyle = colour("--ink");
    const tall = height / lanes.length;
    for (const index of tried) {
      const check = c.checks[c.check[index]];
      const lane = Math.max(0, lanes.indexOf(check === "max_gap" ? "max_dropout" : check));
      counts[lanes[lane]] = (counts[lanes[lane]] ?? 0) + 1;
      pen.fillStyle = colour(TONES[check] ?? "--muted");
      pen.globalAlpha = index === tried[walk.at ?? -1] ? 1 : 0.55;
      const from = (c.first[index] / beams) * width;
      const wide = ((((c.last[index] - c.first[index] + beams) % beams) + 1) / beams) * width;
      pen.fillRect(from, lane * tall + 2, Math.max(wide, 1), tall - 4);
      if (index === tried[walk.at ?? -1]) marked = [from, lane * tall, Math.max(wide, 1), tall];
    }
    if (marked) pen.strokeRect(...marked);
    pen.globalAlpha = 1;
    setText(
      seedsSaid,
      Object.entries(counts)
        .map(([check, n]) => `${text.tones[check]}: ${n}`)
        .join(", "),
    );
  }

  function drawSweep() {
    if (!swept || !picture.clientWidth) return;
    const { pen, width, height } = fresh(picture);
    const { beams, values, runs } = swept;
    runs.forEach((row, k) => {
      const from = (k / values.length) * width;
      for (const [first, last, tone] of row) {
        pen.fillStyle = tone;
        pen.fillRect(
          from,
          (first / beams) * height,
          width / values.length + 0.5,
          Math.max(((last - first + 1) / beams) * height, 0.7),
        );
      }
    });
    const at = placeOf(knob(), params[name]) * width;
    pen.fillStyle = colour("--ink");
    pen.fillRect(at - 0.8, 0, 1.6, height);
    let nearest = 0;
    values.forEach(
      (each, k) => (nearest = Math.abs(each - params[name]) < Math.abs(values[nearest] - params[name]) ? k : nearest),
    );
    const words = text.at(knob().symbol.replace("_", " "), withUnit(knob(), params[name]), swept.lines[nearest]);
    setText(value, words);
    picture.setAttribute("aria-label", `${text.sweepHelp} ${words}`);
  }

  function draw() {
    drawSeeds();
    drawSweep();
  }
  onTheme(draw);
  new ResizeObserver(draw).observe(element);

  async function refresh() {
    if (element.hidden || !knobs.length) return;
    slider.set(placeOf(knob(), params[name]), format(knob(), params[name]));
    const others = Object.entries(params).filter(([each]) => each !== name);
    const wanted = JSON.stringify([frame, name, others]);
    if (wanted === made || busy) return drawSweep();
    busy = true;
    made = wanted;
    await fetchInto(
      trouble,
      `/api/sweep?session=${encodeURIComponent(session())}&name=${name}`,
      text,
      (/** @type {Sweep} */ told) => {
        swept = told;
        drawSweep();
      },
    );
    busy = false;
    // What changed meanwhile.
    return refresh();
  }

  return {
    element,
    /** @param {boolean} on */
    show(on) {
      element.hidden = !on;
      draw();
      refresh();
    },
    /** @param {Knob[]} next */
    setKnobs(next) {
      knobs = next;
      choice.replaceChildren(
        ...next.map((each) =>
          h("option", { value: each.name, selected: each.name === name }, each.symbol.replace("_", " ")),
        ),
      );
    },
    /** @param {Trace} next */
    setTrace(next) {
      trace = next;
      tried = windows(trace);
      walk.renew(null);
      drawSeeds();
    },
    /** @param {import("../wire.js").State} state drawn, so that the server knows it too */
    setState(state) {
      params = state.params;
      frame = JSON.stringify([state.recording, state.topic, state.frame, state.method]);
      refresh();
    },
  };
}

/** @param {Trace} trace */
function windows({ columns: c }) {
  const wanted = ["seed rejected", "seed found"].map((kind) => c.kinds.indexOf(kind));
  return c.kind.flatMap((kind, k) => (wanted.includes(kind) ? [k] : []));
}
