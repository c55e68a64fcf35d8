// @ts-check
// Auto-tuning: what is maximised, the trials as they come, what matters, and whether anything was gained.
import { h, setText, svg } from "../widgets/dom.js";
import { placeOf, withUnit } from "../widgets/scale.js";
import { toast } from "../widgets/toast.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("./workbench.js").Answer} Answer */
/** @typedef {import("./workbench.js").Trial} Trial */

const WIDTH = 300;
const HEIGHT = 90;
const QUALITY = ["epsilon", "delta", "seed_points"];
const TRIALS = [50, 100, 200, 500];

/**
 * @param {typeof import("../text/tuning.js").tuningText.auto} text
 * @param {{ask: (wish: object) => void, stop: () => void, onAdopt: (params: Params) => void}} handlers
 */
export function createAuto(text, { ask, stop, onAdopt }) {
  /** @type {Knob[]} */
  let knobs = [];
  /** @type {Trial[]} */
  let trials = [];
  /** @type {string[]} */
  let tuned = [];
  let running = false;
  /** @type {Params | null} */
  let best = null;
  let truth = false;
  let chosen = false;

  const objective = h(
    "select",
    { class: "select", "aria-label": text.objective, onchange: () => ((chosen = true), tickUsual(), clear()) },
    ...Object.entries(text.objectives).map(([value, label]) => h("option", { value }, label)),
  );
  const count = h(
    "select",
    { class: "select", "aria-label": text.trials },
    ...TRIALS.map((n) => h("option", { value: String(n), selected: n === 100 }, String(n))),
  );
  const boxes = h("div", { class: "auto-thresholds", role: "group", "aria-label": text.thresholds });
  const start = h(
    "button",
    { type: "button", class: "button primary", onclick: () => (running ? stop() : begin(false)) },
    text.start,
  );
  const anew = h(
    "button",
    { type: "button", class: "button quiet", hidden: true, onclick: () => begin(true) },
    text.anew,
  );
  tooltip(anew, text.anewHelp);
  const adopt = h(
    "button",
    { type: "button", class: "button", hidden: true, onclick: () => best && (onAdopt(best), toast(text.adopted)) },
    text.adopt,
  );
  const says = h("p", { class: "auto-text" }, text.intro);
  const caution = h("p", { class: "auto-caution muted" });
  const verdict = h("p", { class: "auto-verdict", role: "status", hidden: true });
  const trouble = h("p", { class: "panel-error", role: "alert", hidden: true });
  const progress = h("span", { class: "muted" });
  const history = picture("auto-history", text.history);
  const parallel = picture("auto-parallel", text.parallel);
  const axes = h("div", { class: "auto-axes muted" });
  const bars = h("div", { class: "auto-bars" });
  tooltip(bars, text.importanceHelp, "left");
  const pictures = h(
    "div",
    { class: "auto-pictures", hidden: true },
    history,
    parallel,
    axes,
    h("h3", {}, text.importance),
    bars,
  );
  const element = h(
    "div",
    { class: "auto-page" },
    h("div", { class: "auto-choices" }, objective, count, h("span", { class: "muted" }, text.trials)),
    boxes,
    h("div", { class: "auto-foot" }, start, anew, progress),
    trouble,
    says,
    caution,
    verdict,
    adopt,
    pictures,
  );

  /** @returns {HTMLInputElement[]} */
  const ticks = () => [...boxes.querySelectorAll("input")];

  function tickUsual() {
    for (const box of ticks()) {
      const knob = knobs.find(({ name }) => name === box.value);
      box.checked = objective.value === "truth" ? !knob?.extension : QUALITY.includes(box.value);
    }
  }

  function clear() {
    if (running) stop();
    trials = [];
    best = null;
    verdict.hidden = adopt.hidden = pictures.hidden = trouble.hidden = anew.hidden = true;
    setText(progress, "");
    setText(says, text.intro);
    setText(caution, "");
    start.textContent = text.start;
  }

  /** @param {boolean} afresh */
  function begin(afresh) {
    tuned = ticks()
      .filter(({ checked }) => checked)
      .map(({ value }) => value);
    clear();
    setRunning(true);
    ask({ objective: objective.value, thresholds: tuned, trials: Number(count.value), anew: afresh });
  }

  /** @param {boolean} on */
  function setRunning(on) {
    running = on;
    start.textContent = on ? text.stop : trials.length ? text.goOn : text.start;
    for (const control of [objective, count, ...ticks()]) control.disabled = on;
    anew.hidden = on || !trials.length;
  }

  function paint() {
    const scored = trials.filter(({ score }) => score !== null);
    pictures.hidden = !scored.length;
    setText(progress, text.progress(trials.length));
    if (!scored.length) return;
    paintHistory(history, scored);
    paintParallel(
      parallel,
      scored,
      tuned.map((name) => /** @type {Knob} */ (knobs.find((knob) => knob.name === name))),
    );
    const top = scored.reduce((one, other) => (Number(other.score) > Number(one.score) ? other : one));
    best = top.params;
    adopt.hidden = false;
    const values = tuned
      .map((name) => knobs.find((knob) => knob.name === name))
      .map((knob) => knob && `${knob.symbol} ${withUnit(knob, top.params[knob.name])}`);
    setText(progress, `${text.progress(trials.length)}, ${text.best(Number(top.score).toFixed(3))}`);
    adopt.textContent = `${text.adopt}: ${values.join(", ")}`;
    axes.replaceChildren(
      ...tuned.map((name) => h("span", {}, knobs.find((knob) => knob.name === name)?.symbol ?? name)),
    );
  }

  let painting = 0;
  const paintSoon = () => (painting ||= requestAnimationFrame(() => ((painting = 0), paint())));

  return {
    element,
    /** @param {Knob[]} next */
    setKnobs(next) {
      knobs = next;
      boxes.replaceChildren(
        ...next.map(({ name, symbol }) => h("label", {}, h("input", { type: "checkbox", value: name }), symbol)),
      );
      tickUsual();
    },
    /** @param {boolean} next */
    setTruth(next) {
      truth = next;
      for (const option of objective.options) option.disabled = option.value === "truth" && !truth;
      if (running || (chosen && (truth || objective.value !== "truth"))) return;
      const usual = truth ? "truth" : "label-free";
      if (objective.value === usual) return;
      objective.value = usual;
      tickUsual();
    },
    /** Another recording has other trials. */
    forget: clear,
    /** @param {Answer} answer */
    receive(answer) {
      if (answer.text) setText(says, answer.text);
      if (answer.caution) setText(caution, answer.caution);
      if (answer.trials) {
        trials.push(...answer.trials);
        paintSoon();
      }
      if (answer.importance) paintBars(bars, answer.importance, knobs);
      if (answer.verdict) {
        verdict.hidden = false;
        verdict.classList.toggle("gained", answer.verdict.gained);
        setText(verdict, answer.verdict.text);
      }
      if (!answer.done) return;
      setRunning(false);
      trouble.hidden = !answer.message;
      setText(trouble, answer.message ?? "");
    },
    get current() {
      return { trials: trials.length, running, best, verdict: verdict.textContent };
    },
  };
}

/** @param {string} className @param {string} label */
function picture(className, label) {
  const element = svg("svg", {
    class: className,
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    preserveAspectRatio: "none",
    role: "img",
    "aria-label": label,
  });
  const title = svg("title");
  title.textContent = label;
  element.append(title);
  return element;
}

/** @param {Element} element @param {Element[]} marks */
function show(element, marks) {
  element.replaceChildren(/** @type {Element} */ (element.firstElementChild), ...marks);
}

/** @param {Element} element @param {Trial[]} scored */
function paintHistory(element, scored) {
  const scores = scored.map(({ score }) => Number(score));
  const [low, high] = [Math.min(...scores), Math.max(...scores)];
  const x = (/** @type {number} */ k) => 4 + (k / Math.max(1, scores.length - 1)) * (WIDTH - 8);
  const y = (/** @type {number} */ score) => 6 + (1 - (high > low ? (score - low) / (high - low) : 1)) * (HEIGHT - 12);
  let top = -Infinity;
  const steps = scores
    .map((score, k) => ((top = Math.max(top, score)), `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(top).toFixed(1)}`))
    .join("");
  const dots = scores.map((score, k) => `M${x(k).toFixed(1)} ${y(score).toFixed(1)}h0`).join("");
  const stay = { "vector-effect": "non-scaling-stroke" };
  show(element, [
    svg("path", { class: "dots", d: dots, ...stay }),
    svg("path", { class: "default", d: `M0 ${y(scores[0])}H${WIDTH}`, ...stay }),
    svg("path", { class: "best", d: steps, ...stay }),
  ]);
}

/** The better a trial, the stronger its line, and the later it is drawn. @param {Element} element @param {Trial[]} scored @param {Knob[]} axes */
function paintParallel(element, scored, axes) {
  const sorted = [...scored].sort((one, other) => Number(one.score) - Number(other.score));
  const x = (/** @type {number} */ k) => ((k + 0.5) / axes.length) * WIDTH;
  const y = (/** @type {Knob} */ knob, /** @type {Trial} */ trial) =>
    4 + (1 - placeOf(knob, trial.params[knob.name])) * (HEIGHT - 8);
  const stay = { "vector-effect": "non-scaling-stroke" };
  show(element, [
    ...axes.map((_, k) => svg("path", { class: "axis", d: `M${x(k)} 0V${HEIGHT}`, ...stay })),
    ...sorted.map((trial, rank) =>
      svg("path", {
        class: rank === sorted.length - 1 ? "trial best" : "trial",
        d: axes.map((knob, k) => `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(knob, trial).toFixed(1)}`).join(""),
        opacity: (0.06 + 0.5 * (rank / sorted.length) ** 3).toFixed(2),
        ...stay,
      }),
    ),
  ]);
}

/** @param {HTMLElement} element @param {Record<string, number>} importance @param {Knob[]} knobs */
function paintBars(element, importance, knobs) {
  element.replaceChildren(
    ...Object.entries(importance).map(([name, share]) => {
      const bar = h("span", { class: "auto-bar" });
      bar.style.width = `${Math.round(100 * share)}%`;
      const symbol = knobs.find((knob) => knob.name === name)?.symbol ?? name;
      return h(
        "div",
        { class: "auto-row" },
        h("span", {}, symbol),
        h("span", { class: "auto-track" }, bar),
        h("span", { class: "muted" }, `${Math.round(100 * share)} %`),
      );
    }),
  );
}
