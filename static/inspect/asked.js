// @ts-check
// A question about what is selected, asked once nothing changes any more; an answer to an earlier one is dropped.
import { fetchText } from "../fetch.js";
import { keyOf } from "../view/key.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {{selected: number | null, beside: number | null}} Chosen beams of the View */

const REST_MS = 150;

/**
 * @template {object} Answer
 * @param {object} question
 * @param {string} question.path of the route
 * @param {readonly (keyof Answer & string)[]} question.parts what the answer repeats, in the state or among the chosen beams
 * @param {(chosen: Chosen, state: State) => boolean} question.isAsked
 * @param {() => string} question.session
 * @param {(answer: Answer | null) => void} question.onAnswer null: not known, or not asked
 */
export function createAsked({ path, parts, isAsked, session, onAnswer }) {
  let asked = "";
  let waiting = 0;

  async function ask() {
    const { words, trouble } = await fetchText(`${path}?${new URLSearchParams({ session: session() })}`);
    if (trouble) return;
    const answer = JSON.parse(words);
    // The answer may belong to an earlier state.
    if (asked.endsWith(keyOf(answer, ...parts))) onAnswer(answer);
  }

  return {
    /** @param {State} state */
    setState(state) {
      const { selected, beside } = state.view;
      const chosen = { selected: selected ?? null, beside: beside ?? null };
      const about = { ...state, ...chosen, beam: chosen.selected };
      const key = isAsked(chosen, state)
        ? `${state.place} ${state.first} ${keyOf(about, .../** @type {any} */ (parts))}`
        : "";
      if (key === asked) return;
      asked = key;
      clearTimeout(waiting);
      onAnswer(null);
      if (key) waiting = setTimeout(ask, REST_MS);
    },
  };
}
