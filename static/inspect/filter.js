// @ts-check
// Which frames are listed: those with a tag, and with some words in their tags, their note, or what looks wrong in them.
import { fetchText } from "../fetch.js";
import { h, setText } from "../widgets/dom.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {{revision: number, lines: number | null, tags: string[], note: string}} Brief */

const REST_MS = 200;
const ANY = "";
// A tag may have any name; these are no tags.
const KINDS = /** @type {const} */ (["kind:lines", "kind:note"]);

/**
 * @param {typeof import("../text/inspect.js").inspectText.filter} text
 * @param {{words: (frame: number) => string[] | undefined, onChange: () => void, onTags: (tags: string[]) => void}} handlers
 *   words: what looks wrong in a frame, undefined while it is not known; onTags: all that there are
 */
export function createFilter(text, { words, onChange, onTags }) {
  const field = h("input", {
    type: "search",
    class: "frames-search",
    placeholder: text.placeholder,
    "aria-label": text.label,
  });
  const select = h("select", { class: "select", "aria-label": text.tag });
  const searching = h("p", { class: "hint", role: "status", hidden: true });
  const element = h("div", {}, h("div", { class: "frames-head" }, field, select), searching);
  /** @type {Record<string, Brief>} */
  let said = {};
  let key = "";
  let frames = 0;
  let timer = 0;
  field.addEventListener("input", () => (clearTimeout(timer), (timer = setTimeout(onChange, REST_MS))));
  field.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key !== "Escape") return;
    field.value = "";
    field.blur();
    onChange();
  });
  select.addEventListener("change", onChange);
  offer();

  const wanted = () => field.value.trim().toLowerCase();

  /** @param {Brief | undefined} brief */
  function chosen(brief) {
    if (select.value === ANY) return true;
    if (select.value === KINDS[0]) return brief !== undefined && brief.lines !== null;
    if (select.value === KINDS[1]) return Boolean(brief?.note);
    return brief?.tags.includes(select.value.slice(1)) ?? false;
  }

  /** What people have said of a frame, in one line. @param {number} frame */
  function line(frame) {
    const { tags = [], note = "" } = said[frame] ?? {};
    return [...tags.map((tag) => `#${tag}`), note.replace(/\s+/g, " ")].filter(Boolean).join(" ");
  }

  /** Frames whose words are not known and could be looked for. */
  function unknown() {
    if (!wanted()) return [];
    return [...Array(frames).keys()].filter((frame) => words(frame) === undefined && chosen(said[frame]));
  }

  /** Tags and kinds of frames, with their number. */
  function offer() {
    const briefs = Object.values(said);
    const counts = new Map();
    for (const { tags } of briefs) for (const tag of tags) counts.set(tag, (counts.get(tag) ?? 0) + 1);
    const tags = [...counts.keys()].sort((one, other) => one.localeCompare(other));
    const before = select.value;
    select.replaceChildren(
      h("option", { value: ANY }, text.any),
      h("option", { value: KINDS[0] }, text.labelled(briefs.filter(({ lines }) => lines !== null).length)),
      h("option", { value: KINDS[1] }, text.noted(briefs.filter(({ note }) => note).length)),
      ...tags.map((tag) => h("option", { value: `#${tag}` }, text.tagged(tag, counts.get(tag)))),
    );
    select.value = [...select.options].some(({ value }) => value === before) ? before : ANY;
    onTags(tags);
  }

  /** @param {string} query */
  async function ask(query) {
    const asked = key;
    const { words: answer, trouble } = await fetchText(`/api/labels?${query}`);
    if (asked !== key) return;
    said = trouble ? {} : JSON.parse(answer).frames;
    offer();
    onChange();
  }

  return {
    element,
    line,
    unknown,
    /** Words are looked for. */
    get searching() {
      return wanted() !== "";
    },
    /** @param {number} frame */
    passes(frame) {
      const sought = wanted();
      return (
        chosen(said[frame]) &&
        (!sought || `${line(frame)} ${words(frame)?.join(" ") ?? ""}`.toLowerCase().includes(sought))
      );
    },
    /** Says how far the search has come. */
    tell() {
      const missing = unknown().length;
      searching.hidden = missing === 0;
      setText(searching, text.searching(frames - missing, frames));
    },
    /** @param {State} state */
    setState(state) {
      frames = state.frames;
      const { recording, topics, topic, labels } = state;
      const next = `${recording} ${topic} ${labels?.stamp}`;
      if (state.mode !== "inspect" || next === key) return;
      key = next;
      if (labels?.stamp)
        ask(String(new URLSearchParams({ recording, ...(topics.length > 1 && topic ? { topic } : {}) })));
      else {
        said = {};
        offer();
        onChange();
      }
    },
  };
}
