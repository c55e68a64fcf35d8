// @ts-check
// What the page shows of a live source: live or paused beside the timeline, connection, rate and delay in the status line.
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").LiveStatus} LiveStatus */

/** @typedef {typeof import("../text/live.js").liveText} Text */

/** The state of the source, for the status line. @param {Text} text */
function createFigures(text) {
  /** @type {LiveStatus | null} */
  let status = null;
  const dot = h("span", { class: "dot", "aria-hidden": "true" });
  const words = h("span", { class: "live-words", role: "status" });
  const rate = h("span", { class: "live-rate" });
  const delay = h("span", { class: "live-delay" });
  const dropped = h("span", { class: "live-dropped" });
  const publishing = h("span", { class: "live-publishing" });
  const figures = [dot, words, rate, delay, dropped, publishing];
  const element = h("span", { class: "connection live-status", hidden: true }, ...figures);
  const help = () => (status ? text.help(status.most, status.total, status.refused, status.notDrawn) : "");
  tooltip(delay, text.delayHelp);
  tooltip(dropped, help);
  tooltip(rate, help);

  return {
    element,
    /** @param {LiveStatus | null} of null: of no live source */
    set(of) {
      status = of;
      element.hidden = of === null;
      if (!of) return;
      element.dataset.now = of.connection;
      const well = of.connection === "open" && of.rate > 0;
      setText(words, of.publishTrouble || of.message || (well ? "" : text.connection[of.connection]));
      words.hidden = words.textContent === "";
      setText(rate, of.rate > 0 ? text.rate(of.rate) : text.silent);
      rate.hidden = of.connection !== "open";
      delay.hidden = rate.hidden || of.delay === null || of.rate === 0;
      setText(delay, of.delay === null ? "" : text.delay(of.delay));
      setText(dropped, text.dropped(of.dropped));
      dropped.hidden = of.dropped === 0;
      publishing.hidden = of.publisher === "";
      setText(publishing, text.publishing(of.publishTopic, of.published));
    },
  };
}

/**
 * @param {Text} text
 * @param {{onFollow: (live: boolean) => void}} handlers
 */
export function createLive(text, { onFollow }) {
  /** @type {State | null} */
  let state = null;
  /** @type {LiveStatus | null} */
  let status = null;

  const newer = h("span", { class: "live-newer" });
  const button = h(
    "button",
    {
      type: "button",
      class: "live-pill",
      "aria-pressed": "false",
      hidden: true,
      onclick: () => onFollow(!state?.live),
    },
    h("span", { class: "live-dot", "aria-hidden": "true" }),
    text.live,
    newer,
  );
  tooltip(button, () => (state?.live ? text.following : text.follow));
  const figures = createFigures(text);

  function show() {
    const of = status && state && status.recording === state.recording ? status : null;
    button.hidden = state === null || state.live === null;
    button.setAttribute("aria-pressed", String(Boolean(state?.live)));
    button.dataset.now = of?.connection ?? "open";
    const waiting = of && state && !state.live ? of.total - state.first - state.frames : 0;
    setText(newer, waiting > 0 ? text.newer(waiting) : "");
    figures.set(of);
  }

  return {
    /** For the timeline. */
    button,
    /** For the status line. */
    element: figures.element,
    get status() {
      return status;
    },
    /** @param {State} next */
    setState(next) {
      state = next;
      show();
    },
    /** @param {LiveStatus} next */
    setLive(next) {
      status = next;
      show();
    },
  };
}
