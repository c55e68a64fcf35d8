// @ts-check
// Mode Inspect: frames by how doubtful they are, what is wrong in them, and the comparison of two results.
import { toast } from "../widgets/toast.js";
import { createAb } from "./ab.js";
import { createFilter } from "./filter.js";
import { createFrames } from "./frames.js";
import { createSaid } from "./said.js";
import { createTruth } from "./truth.js";
import { createWeights } from "./weights.js";
import { createWords } from "./words.js";

/**
 * @param {import("../page.js").Page} page
 * @param {typeof import("../text/inspect.js").inspectText} text
 * @param {{pointing: import("../widgets/words.js").Pointing & {show: (finding: import("../wire.js").Finding | null) => void},
 *          timeline: () => import("../bars/timeline.js").Timeline, onTags: (tags: string[]) => void,
 *          onMend: (values: import("../open/reread_fields.js").Values) => void}} handlers
 *   onTags: all existing tags; onMend: reads the recording in another way
 */
export function createInspect(page, text, { pointing, timeline, onTags, onMend }) {
  const inspecting = () => page.view.mode === "inspect";
  const weights = createWeights(text.weights, (weights) => page.change({ weights }));
  const words = createWords({
    session: page.sessionId,
    wanted: () => [...(page.drawn ? [page.drawn.frame] : []), ...frames.inView, ...filter.unknown()],
    onWords: () => (filter.searching ? listFrames() : frames.paint(), showSaid()),
  });
  const said = createSaid(text.said, pointing);
  const filter = createFilter(text.filter, { words: words.texts, onChange: listFrames, onTags });
  const frames = createFrames(text.frames, {
    onFrame: page.goToFrame,
    onScore: (score) => page.change({ score }),
    number: (place) => timeline().scored.number(place),
    value: (frame) => timeline().scored.words(frame),
    words: inOneLine,
    said: said.element,
    passes: (frame) => filter.passes(frame),
    filter: filter.element,
    onRows: () => inspecting() && words.need(),
    extra: weights.element,
  });
  const ab = createAb(text.ab, {
    onToggle: togglePin,
    onSwap: () => page.view.against && page.change({ ...page.view.against, against: presentOf(page), step: null }),
    onAdopt: () => page.view.against && page.change({ ...page.view.against, against: null, step: null }),
    onNext: nextDifference,
  });
  const truth = createTruth(text.truth, page, {
    onShow: (verdicts) => page.change({ layers: { verdicts } }),
    onReference: (reference) => page.change({ reference }),
    onWalls: (made) => readWalls(page, onMend, made),
  });

  /** Tags, note and remarks of a frame. @param {number} frame */
  function inOneLine(frame) {
    const wrong = words.texts(frame);
    const looks = wrong?.join(" · ") || (wrong ? text.said.nothing : timeline().scored.summary(frame));
    return [filter.line(frame), looks].filter(Boolean).join(" · ");
  }

  function showSaid() {
    const drawn = page.drawn;
    if (drawn && inspecting()) said.set(filter.line(drawn.frame), words.of(drawn.frame));
    else said.set("", []);
  }

  function listFrames() {
    frames.sort();
    filter.tell();
    showSaid();
    if (inspecting()) words.need();
  }

  function togglePin() {
    page.change({ against: page.view.against ? null : presentOf(page) });
  }

  function nextDifference() {
    if (!page.view.against) return;
    const next = timeline().different();
    if (next === null) toast(text.ab.nowhere);
    else page.goToFrame(next);
  }

  return {
    parts: [ab, frames, truth, words, filter, weights, { setState: showSaid }],
    pages: {
      frames: { name: "frames", label: text.tabs.frames, content: frames.element },
      truth: { name: "truth", label: text.tabs.truth, content: truth.element },
    },
    ab,
    frames,
    togglePin,
    nextDifference,
    /** The values of the strip changed, or the mode was entered. */
    showScored: () => inspecting() && frames.setScored(timeline().scored.current),
  };
}

/** The current result, in the form in which it would be pinned as A. @param {import("../page.js").Page} page */
function presentOf({ view: { method, params } }) {
  return { method, params };
}

/** Reads the recording with the walls that many scans agree on, and draws them, or without. @param {import("../page.js").Page} page @param {(values: import("../open/reread_fields.js").Values) => void} onMend @param {boolean} made */
function readWalls(page, onMend, made) {
  onMend({ walls: made ? "by-views" : null });
  if (made) page.change({ layers: { truth: true } });
}
