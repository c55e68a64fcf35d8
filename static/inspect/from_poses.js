// @ts-check
// Makes a truth from the poses of a recording, and says how far to trust it, or why there is none.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */

/** @param {typeof import("../text/inspect.js").inspectText.truth.fromPoses} text @param {(made: boolean) => void} onWalls */
export function createFromPoses(text, onWalls) {
  const make = h("button", { type: "button", class: "button", onclick: () => onWalls(true) }, text.make);
  tooltip(make, text.makeHelp, "left");
  const forget = h("button", { type: "button", class: "button", onclick: () => onWalls(false) }, text.forget);
  const said = h("p", { class: "hint", role: "status" });
  const element = h("div", { class: "from-poses" }, said, h("div", { class: "from-poses-row" }, make, forget));
  /** Why no truth could be made, of one recording. */
  let refused = { recording: "", why: "" };

  return {
    element,
    /** @param {import("../wire.js").Refused} subject @param {string} why */
    setRefused({ recording, reading }, why) {
      if (!reading.walls) return;
      refused = { recording, why };
      setText(said, why);
      said.classList.add("warning");
    },
    /** @param {State} state */
    setState({ recording, truth, judgedBy, references, byViews, mayHavePoses, frames, live, readAs }) {
      const why = refused.recording === recording ? refused.why : "";
      const possible = mayHavePoses && frames > 1 && live === null;
      const known = references.includes("wall") || truth;
      make.hidden = known || !possible;
      forget.hidden = !byViews || !readAs.walls;
      const shown = byViews ? judgedBy === "wall" : !known;
      element.hidden = !shown && forget.hidden;
      setText(said, byViews || why || (possible ? text.possible : text.without));
      said.classList.toggle("warning", Boolean(why) && !byViews);
    },
  };
}
