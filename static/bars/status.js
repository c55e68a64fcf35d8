// @ts-check
import { h, setText } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";
import { createAsked } from "../inspect/asked.js";

/** @typedef {import("../wire.js").State} State */

const ANNOUNCE_MS = 800;

/**
 * @param {import("../page.js").Page} page
 * @param {HTMLElement} bar
 * @param {typeof import("../text/page.js").pageText.status} text
 * @param {HTMLElement} live how a live source fares
 */
export function mountStatus(page, bar, text, live) {
  const figures = {
    segments: figure("segments", ""),
    coverage: figure("coverage", text.coverage),
    extraction: figure("extraction", text.extraction),
    roundTrip: figure("round-trip", text.roundTrip),
  };
  const format = h("span", { class: "muted format" });
  const dot = h("span", { class: "dot", "aria-hidden": "true" });
  const connection = h("span", { class: "connection" }, dot, h("span"));
  const spoken = h("span", { class: "off-screen", role: "status" });
  const entries = Object.values(figures).map(({ element }) => element);
  bar.setAttribute("aria-label", text.label);
  const truth = createTruthFigures(text.truth, page);
  bar.append(...entries, truth.element, live, h("span", { class: "spacer" }), format, connection, spoken);
  tooltip(figures.extraction.element, text.extractionHelp);
  tooltip(figures.roundTrip.element, text.roundTripHelp);
  let coverageHelp = "";
  tooltip(figures.coverage.element, () => coverageHelp);
  let timer = 0;

  return {
    /** @param {State} state */
    setState(state) {
      const { segments, covered, valid, beams, extractionUs, latencyMs, frame } = state;
      figures.segments.set(String(segments.length), text.segments(segments.length));
      figures.coverage.set(valid ? `${((100 * covered) / valid).toFixed(1)} %` : "–", text.coverage);
      figures.extraction.set(
        extractionUs >= 10_000 ? `${(extractionUs / 1000).toFixed(0)} ms` : `${Math.round(extractionUs)} µs`,
        text.extraction,
      );
      if (latencyMs !== null) figures.roundTrip.set(`${Math.round(latencyMs)} ms`, text.roundTrip);
      coverageHelp = text.coverageHelp(covered, valid, beams);
      truth.setState(state);
      setText(format, [state.format, state.frameId, text.beams(beams)].filter(Boolean).join(" · "));
      clearTimeout(timer);
      timer = setTimeout(() => setText(spoken, text.announce(segments.length, frame)), ANNOUNCE_MS);
    },
    /** @param {"connecting" | "open" | "lost"} now */
    setConnection(now) {
      connection.dataset.now = now;
      setText(/** @type {Element} */ (connection.lastElementChild), text.connection[now]);
    },
  };
}

/** @param {string} name @param {string} label */
function figure(name, label) {
  const value = h("span", { class: "figure-value" }, "–");
  const words = h("span", { class: "muted" }, label);
  return {
    element: h("span", { class: `figure figure-${name}` }, value, words),
    /** @param {string} shown @param {string} what */
    set(shown, what) {
      setText(value, shown);
      setText(words, what);
    },
  };
}

/**
 * TR, FR and completeness of the frame, once nothing changes any more and if the truth is known.
 * @param {typeof import("../text/page.js").pageText.status.truth} text @param {import("../page.js").Page} page
 */
function createTruthFigures(text, page) {
  const words = h("span", {});
  const onclick = () => page.change({ layers: { verdicts: !page.view.layers.verdicts } });
  const props = { type: "button", class: "truth-figures", "aria-pressed": "false", hidden: true, onclick };
  const element = h("button", props, words);
  tooltip(element, text.help);
  const asked = createAsked({
    path: "/api/judged",
    parts: /** @type {const} */ (["frame", "method", "params"]),
    isAsked: (_, { live }) => live === null,
    session: page.sessionId,
    onAnswer(/** @type {import("../wire.js").Judgement | null} */ answer) {
      element.classList.toggle("stale", answer === null);
      if (!answer) return;
      element.hidden = answer.agreement === null;
      if (answer.agreement) setText(words, text.figures(answer.agreement, answer.byViews));
    },
  });
  return {
    element,
    /** @param {State} state */
    setState(state) {
      element.setAttribute("aria-pressed", String(state.layers.verdicts));
      asked.setState(state);
    },
  };
}
