// @ts-check
// What would change the answer for the selected beam; requested once nothing changes any more.
import { keyOf } from "../view/key.js";
import { fetchText } from "../fetch.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").WhatIf} WhatIf */

const REST_MS = 150;
const PARTS = /** @type {const} */ (["frame", "beam", "method", "params"]);

/**
 * @param {{session: () => string, onChanges: (changes: WhatIf[]) => void}} handlers onChanges: none while they are not known
 */
export function createWhatIf({ session, onChanges }) {
  let asked = "";
  let waiting = 0;

  async function ask() {
    const { words, trouble } = await fetchText(`/api/what-if?${new URLSearchParams({ session: session() })}`);
    if (trouble) return;
    const answer = /** @type {import("../wire.js").WhatIfs} */ (JSON.parse(words));
    // The answer may belong to an earlier state.
    if (asked.endsWith(keyOf(answer, ...PARTS))) onChanges(answer.changes);
  }

  return {
    /** @param {State} state */
    setState(state) {
      const beam = state.explanation?.beam;
      const key = beam === undefined ? "" : `${state.place} ${state.first} ${keyOf({ ...state, beam }, ...PARTS)}`;
      if (key === asked) return;
      asked = key;
      clearTimeout(waiting);
      onChanges([]);
      if (key) waiting = setTimeout(ask, REST_MS);
    },
  };
}
