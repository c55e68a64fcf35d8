// @ts-check
// The noise of the recording over the range, with ε: the same picture as in Tune.
import { createNoisePicture, reachOf, sigmaAt } from "../../tune/noise_picture.js";
import { h, setText } from "../../widgets/dom.js";
import { fetchText } from "../../fetch.js";
import { tuningText } from "../../text/tuning.js";

/** @param {typeof import("../../text/shown.js").shownText.noise} text @param {() => string} session @param {() => import("../../wire.js").Knob[]} knobs */
export function createNoise(text, session, knobs) {
  const picture = createNoisePicture(tuningText.fit);
  const says = h("p", { role: "status" }, text.measuring);
  const element = h("div", { class: "shown-noise" }, says);
  element.prepend(picture.element);
  let place = "";
  /** @type {import("../../wire.js").Noise | null} */
  let noise = null;
  /** @type {import("../../wire.js").Params} */
  let params = {};

  async function measure() {
    const { words, trouble } = await fetchText(`/api/lessons/noise?${new URLSearchParams({ session: session() })}`);
    noise = trouble === null ? JSON.parse(words).noise : null;
    if (!noise) return setText(says, trouble ?? text.unknown);
    return draw();
  }

  function draw() {
    const knob = knobs().find(({ name }) => name === "epsilon");
    if (!noise || !knob) return;
    const sigma = sigmaAt(noise, reachOf(noise));
    const words = text.says(1000 * sigma, 1000 * params.epsilon, params.epsilon / sigma);
    setText(says, words);
    picture.set({ noise, knob, params, fits: null }, words);
  }

  return {
    element,
    /** @param {import("../../wire.js").State} state */
    set(state) {
      params = state.params;
      if (state.place !== place) {
        place = state.place;
        measure();
      } else draw();
    },
  };
}
