// @ts-check
// Sensitivity, map and auto-tuning, and the socket that serves them.
import { createAuto } from "./auto.js";
import { createMap } from "./map.js";
import { createSensitivity } from "./sensitivity.js";
import { Workbench } from "./workbench.js";

/** @typedef {import("../wire.js").Method} Method */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("../wire.js").State} State */

// A hand that moves a slider pauses for less.
const PAUSE_MS = 120;
// Whole recordings are measured by this method only.
const METHOD = "region-growing";

/**
 * @param {typeof import("../text/tuning.js").tuningText} text
 * @param {{session: () => string | null, onParams: (params: Params) => void, row: (name: string) => HTMLElement | null}} handlers row: of a threshold's slider
 */
export function createTuner(text, { session, onParams, row }) {
  const address = () => {
    const id = session();
    return (
      id &&
      `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/tuning?session=${encodeURIComponent(id)}`
    );
  };
  const bench = new Workbench(address, {
    onAnswer(answer) {
      ({ curves: sensitivity, map, auto })[answer.type].receive(answer);
      if (answer.type === "curves" && answer.curves) setTruth();
    },
    onMeasures: (measures) => (map.setMeasures(measures), setTruth()),
  });
  const sensitivity = createSensitivity(text.curves, {
    onSet: (name, value) => onParams({ [name]: value }),
    onShow: () => ask(),
  });
  const map = createMap(text.map, {
    ask: (x, y, measure) => bench.ask("map", { params, x, y, measure }),
    stop: () => bench.stop("map"),
    onSet: onParams,
  });
  const auto = createAuto(text.auto, {
    ask: (wish) => bench.ask("auto", { params, ...wish }),
    stop: () => bench.stop("auto"),
    onAdopt: onParams,
  });
  /** @type {Params} */
  let params = {};
  let place = "";
  let asked = "";
  let timer = 0;
  let able = true;

  function setTruth() {
    map.setTruth(sensitivity.hasTruth);
    auto.setTruth(sensitivity.hasTruth);
  }

  function ask() {
    timer = 0;
    const wanted = JSON.stringify([place, params]);
    if (!place || wanted === asked || !sensitivity.shown()) return;
    asked = wanted;
    sensitivity.pending();
    bench.ask("curves", { params });
  }

  return {
    legend: sensitivity.legend,
    pages: [
      { name: "map", label: text.pages.map, content: map.element },
      { name: "auto", label: text.pages.auto, content: auto.element },
    ],
    /** Shows the table of a sweep in the map. @param {File} file */
    openSweep: (file) => map.open(file),
    /** @param {Method} method */
    setMethod({ name, knobs }) {
      able = name === METHOD;
      sensitivity.legend.hidden = !able;
      sensitivity.setKnobs(able ? knobs : [], row);
      asked = "";
      if (!able) return;
      map.setKnobs(knobs);
      auto.setKnobs(knobs);
    },
    /** @param {Readonly<import("../wire.js").View>} view */
    setView: (view) => able && sensitivity.setParams(view.params),
    /** @param {State} state */
    setState(state) {
      if (!able || state.method !== METHOD) return;
      const here = `${state.recording} ${state.topic}`;
      params = state.params;
      if (here !== place) {
        place = here;
        map.forget();
        auto.forget();
      }
      map.setParams(params);
      clearTimeout(timer);
      timer = setTimeout(ask, PAUSE_MS);
    },
    /** For scripts and tests. */
    get current() {
      return { map: map.current, auto: auto.current };
    },
  };
}
