// @ts-check
// The Export menu: the frame, segments, parameters, and what is sent to a robot, to rerun or to a class.
import { showPublish, showSend, stopPublishing } from "../live/robot.js";
import { addressOf, record } from "../rerun/run.js";
import { createExchange } from "../tune/exchange.js";
import { openClass } from "../view/class_list.js";
import { h } from "../widgets/dom.js";
import { createTake } from "./take.js";

/** @typedef {import("../widgets/menu.js").Group} Group */

/**
 * @param {import("../page.js").Page} page
 * @param {typeof import("../text/words.js").words} text
 * @param {{status: () => import("../wire.js").LiveStatus | null, work: ReturnType<typeof import("../open/work.js").createWork>,
 *          note: () => string, onImport: (file: string) => Promise<string | null>, onFollowLink: () => void}} handlers
 *   status: of the live source; note: of the frame; onImport: applies the text of a parameter file or says why it cannot
 */
export function createExportMenu(page, text, { status, work, note, onImport, onFollowLink }) {
  /** @returns {Group} */
  function robot() {
    const now = status()?.recording === page.drawn?.recording ? status() : null;
    const publish =
      now?.publisher === "this"
        ? { label: text.live.publish.stop, run: () => stopPublishing(page.sessionId()) }
        : { label: text.live.publish.item, run: () => showPublish(text.live, page.sessionId()) };
    const send = { label: text.live.send.item, run: () => showSend(text.live, page.view.method, page.view.params) };
    return { title: text.live.group, items: now?.publishable ? [send, publish] : [send] };
  }

  /** @returns {Group} */
  function rerun() {
    const { title, all, steps } = text.rerun.export;
    return {
      title,
      items: [
        { label: all, run: () => exportRun(false) },
        { label: steps, run: () => exportRun(true) },
      ],
    };
  }

  /** @param {boolean} steps every decision of this frame, instead of all frames */
  function exportRun(steps) {
    const label = page.drawn?.label ?? "";
    work.run(text.rerun.recording(label), async (show, signal) => {
      const { recording } = await record(page.sessionId(), steps, show, signal);
      h("a", { href: addressOf(recording, label), download: "" }).click();
    });
  }

  /** @returns {Group} */
  function follow() {
    const { title, copy, list } = text.page.follow;
    const show = () => openClass(list, page.sessionId);
    return {
      title,
      items: [
        { label: copy, run: onFollowLink },
        { label: list.open, run: show },
      ],
    };
  }

  const { groups } = createTake(text.export, {
    session: page.sessionId,
    state: () => page.drawn,
    note,
    work: work.run,
  });
  return createExchange(text.page, {
    session: page.sessionId,
    params: () => page.view.params,
    method: () => page.methodOf(page.view.method),
    onImport,
    first: groups,
    more: () => [robot(), rerun(), follow()],
  }).element;
}
