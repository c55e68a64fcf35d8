// @ts-check
// Tags and a note of a frame.
import { h } from "../widgets/dom.js";
import { iconButton } from "../widgets/icon.js";

const REST_MS = 600;
const LONGEST_TAG = 60;

/**
 * @param {typeof import("../text/label.js").labelText} text
 * @param {{onTags: (tags: string[]) => void, onNote: (note: string, from: string, gesture: string) => void}} handlers
 *   from: the note that was typed in; gesture: what is typed while the field is in use is one
 */
export function createTags(text, { onTags, onNote }) {
  /** @type {string[]} */
  let tags = [];
  /** The note before what is being typed. */
  let from = "";
  let gesture = 0;
  let timer = 0;
  const known = h("datalist", { id: "known-tags" });
  const add = h("input", {
    type: "text",
    class: "labels-add",
    placeholder: text.addTag,
    "aria-label": text.addTag,
    maxLength: LONGEST_TAG,
    list: known.id,
    autocomplete: "off",
  });
  const chips = h("div", { class: "labels-tags" }, add, known);
  const note = h("textarea", {
    class: "labels-note",
    rows: 2,
    "aria-label": text.note,
    placeholder: text.notePlaceholder,
    maxLength: 20_000,
  });
  add.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Enter" || event.key === ",") {
      event.preventDefault();
      take();
    } else if (event.key === "Backspace" && !add.value && tags.length) onTags(tags.slice(0, -1));
    else if (event.key === "Escape") add.blur();
  });
  add.addEventListener("change", take);
  note.addEventListener("focus", () => (gesture += 1));
  note.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(commit, REST_MS);
  });
  note.addEventListener("blur", commit);
  note.addEventListener("keydown", (event) => event.key === "Escape" && note.blur());
  addEventListener("pagehide", commit);

  function take() {
    const tag = add.value.trim();
    add.value = "";
    if (tag && !tags.includes(tag)) onTags([...tags, tag]);
  }

  function commit() {
    clearTimeout(timer);
    if (note.value === from) return;
    const before = from;
    from = note.value;
    onNote(note.value, before, `note ${gesture}`);
  }

  return {
    elements: [chips, note],
    /** What is typed belongs to the frame that was shown then. */
    commit,
    /** @param {{tags: string[], note: string}} said @param {boolean} editable */
    set(said, editable) {
      add.disabled = note.disabled = !editable;
      if (tags.join("\n") !== said.tags.join("\n") || chips.children.length !== said.tags.length + 2) {
        tags = said.tags;
        for (const chip of chips.querySelectorAll(".labels-tag")) chip.remove();
        chips.prepend(
          ...tags.map((tag) =>
            h(
              "span",
              { class: "labels-tag" },
              tag,
              iconButton("close", text.removeTag(tag), () => onTags(tags.filter((other) => other !== tag))),
            ),
          ),
        );
      }
      if (note.value === from && from !== said.note) note.value = from = said.note;
    },
    /** Tags of other frames, to choose from. @param {string[]} names */
    suggest(names) {
      if (known.children.length !== names.length)
        known.replaceChildren(...names.map((value) => h("option", { value })));
    },
  };
}
