// @ts-check
// Without WebGL: the Picture of this tab on a 2D canvas, and a line that says so.
import { fetchText } from "../fetch.js";
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";

/**
 * @param {import("../page.js").Page} page
 * @param {import("./canvas_stage.js").CanvasStage} stage
 * @param {{noWebGL: string, dismiss: string}} text
 */
export function createFlatPicture(page, stage, text) {
  const dismiss = iconButton("close", text.dismiss, () => (notice.hidden = true));
  const row = h("div", { class: "notice-row" }, h("span", { class: "notice-words" }, text.noWebGL), dismiss);
  const notice = h("div", { class: "notice flat", role: "status" }, row);
  let [running, again] = [false, false];

  /** Fetches the newest picture; while one is on its way, the last request waits. */
  async function fetchNewest() {
    again = true;
    if (running) return;
    running = true;
    while (again) {
      again = false;
      const { words, trouble } = await fetchText(`/api/picture?${new URLSearchParams({ session: page.sessionId() })}`);
      if (!trouble) stage.show(JSON.parse(words));
    }
    running = false;
  }

  return { notice, setState: fetchNewest };
}
