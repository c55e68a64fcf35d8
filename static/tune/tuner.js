// @ts-check
// What fits the laser, sensitivity, map and auto-tuning, and the socket that serves them.
import { Auto } from "./auto.js";
import { Fit } from "./fit.js";
import { TuningMap } from "./map.js";
import { Sensitivity } from "./sensitivity.js";
import { Workbench } from "./workbench.js";

/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Answer} Answer */
/** Of a threshold; knob: with the range of its slider. @typedef {{element: HTMLElement, knob: import("../wire.js").Knob}} Row */
/** @typedef {{session: () => string | null, onParams: (params: Params) => void, onFits: (fits: Params, better: boolean) => void, row: (name: string) => Row | null}} Handlers */

// Pauses while a slider is being dragged are shorter than this.
const PAUSE_MS = 120;
// Only this method is run over whole recordings.
const METHOD = "region-growing";

/**
 * @param {typeof import("../text/tuning.js").tuningText} text
 * @param {Handlers} handlers
 */
export function createTuner(text, handlers) {
  return new Tuner(text, handlers);
}

class Tuner {
  #bench;
  #sensitivity;
  #map;
  #auto;
  #fit;
  /** @type {Params} */ #params = {};
  /** Identifies the drawn recording. */ #place = "";
  /** Whether more of the recording is being read. */
  #growing = false;
  /** What the last request for curves was for. */ #asked = "";
  #timer = 0;
  /** Whether the recording has truth. */ #truth = false;
  /** Whether the selected method can be run over whole recordings. */ #able = true;

  /** @param {typeof import("../text/tuning.js").tuningText} text @param {Handlers} handlers */
  constructor(text, { session, onParams, onFits, row }) {
    this.#bench = new Workbench(() => addressFor(session()), {
      onAnswer: (answer) => this.#receive(answer),
      onMeasures: (measures) => {
        this.#map.setMeasures(measures);
        this.#map.setTruth(this.#truth);
      },
    });
    this.#sensitivity = new Sensitivity(text.curves, {
      onSet: (name, value) => onParams({ [name]: value }),
      onShow: () => this.#ask(),
      row,
    });
    this.#map = new TuningMap(text.map, {
      ask: (x, y, measure) => this.#bench.ask("map", { params: this.#params, x, y, measure }),
      stop: () => this.#bench.stop("map"),
      onSet: onParams,
    });
    this.#auto = new Auto(text.auto, {
      ask: (wish) => this.#bench.ask("auto", { params: this.#params, ...wish }),
      stop: () => this.#bench.stop("auto"),
      onAdopt: onParams,
    });
    this.#fit = new Fit(text.fit, {
      ask: () => this.#bench.ask("fit", {}),
      stop: () => this.#bench.stop("fit"),
      onParams,
      onFits,
    });
    this.above = [this.#fit.element, this.#sensitivity.legend];
    new ResizeObserver(() => this.#ask()).observe(this.#sensitivity.legend);
    this.pages = [
      { name: "map", label: text.pages.map, content: this.#map.element },
      { name: "auto", label: text.pages.auto, content: this.#auto.element },
    ];
  }

  /** @param {Answer} answer */
  #receive(answer) {
    ({ curves: this.#sensitivity, map: this.#map, auto: this.#auto, fit: this.#fit })[answer.type].receive(answer);
  }

  /** @param {boolean} truth */
  #setTruth(truth) {
    this.#truth = truth;
    this.#sensitivity.setTruth(truth);
    this.#map.setTruth(truth);
    this.#auto.setTruth(truth);
  }

  /** What curves would be for. */
  get #wanted() {
    return JSON.stringify([this.#place, this.#growing, this.#params]);
  }

  /** Stops curves that are out of date, so that they do not slow down what is dragged. */
  #stopOld() {
    if (this.#wanted === this.#asked || !this.#bench.has("curves")) return;
    this.#bench.stop("curves");
    this.#asked = "";
  }

  /** Requests the curves if they are visible and out of date. */
  #ask() {
    const wanted = this.#wanted;
    if (!this.#place || wanted === this.#asked || !this.#sensitivity.visible) return;
    this.#asked = wanted;
    this.#sensitivity.pending();
    this.#bench.ask("curves", { params: this.#params });
  }

  /** Shows the table of a sweep in the map. @param {File} file */
  openSweep(file) {
    this.#map.open(file);
  }

  /** @param {Method} method */
  setMethod({ name, knobs }) {
    this.#able = name === METHOD;
    this.#fit.setKnobs(knobs);
    this.#sensitivity.legend.hidden = !this.#able;
    this.#sensitivity.setKnobs(this.#able ? knobs : []);
    this.#asked = "";
    if (!this.#able) return;
    this.#map.setKnobs(knobs);
    this.#auto.setKnobs(knobs);
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ params }) {
    this.#fit.setParams(params);
    if (this.#able) this.#sensitivity.setParams(params);
  }

  /** @param {State} state */
  setState(state) {
    // The map needs the measures also if nothing is asked for yet.
    this.#bench.connect();
    this.#fit.setState(state);
    if (!this.#able || state.method !== METHOD) return;
    const here = state.place;
    this.#params = state.params;
    this.#growing = state.growing;
    if (here !== this.#place) {
      this.#place = here;
      this.#setTruth(state.truth);
      this.#map.forget();
      this.#auto.forget();
    }
    this.#map.setParams(state.params);
    this.#stopOld();
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#ask(), PAUSE_MS);
  }

  /** For scripts and tests. */
  get current() {
    return { map: this.#map.current, auto: this.#auto.current, fit: this.#fit.current };
  }
}

/** @param {string | null} session @returns {string | null} */
function addressFor(session) {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  return session && `${scheme}://${location.host}/api/tuning?session=${encodeURIComponent(session)}`;
}
