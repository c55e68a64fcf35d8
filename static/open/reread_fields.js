// @ts-check
// The fields of a Reading as a form, made from the server's declaration.
import { h } from "../widgets/dom.js";
import { tooltip } from "../widgets/tooltip.js";

/** @typedef {import("../wire.js").ReadingEntry} Entry */
/** @typedef {import("../wire.js").Reading} Reading */
/** @typedef {import("../wire.js").Previewed} Previewed */
/** @typedef {Record<string, string | number | null>} Values null: not given */
/** @typedef {typeof import("../text/reading.js").readingText} Text */

/** Fields that choose one of what the file has. */
const CHOOSING = ["topic", "frame_id", "geometry"];
const GROUPS = /** @type {const} */ (["numbers", "left out", "scans"]);

/** A value as it can be typed; angles in degrees. @param {Entry} entry @param {string | number} value */
function wordsOf({ unit }, value) {
  const angle = unit === "rad" && typeof value === "number";
  return angle ? `${+((value * 180) / Math.PI).toFixed(6)}°` : String(value);
}

/** A field with a control for its value. @param {Entry} entry @param {Text} text @param {() => void} onInput */
function createRow(entry, text, onInput) {
  const choosing = CHOOSING.includes(entry.name);
  const listed = entry.choices.length > 0 || choosing;
  const common = { class: "reread-input", oninput: onInput };
  const input = listed
    ? h("select", { ...common, class: "reread-input select" })
    : h("input", { ...common, type: "text", autocomplete: "off", spellcheck: false });
  const label = h("span", { class: "reread-label" }, entry.label);
  const help = entry.unit === "rad" ? `${entry.help}. ${text.degrees}` : entry.help;
  const unit = h("span", { class: "muted" }, entry.unit);
  const hint = h("span", { class: "reread-help hint", "aria-hidden": "true" }, help);
  const element = h("label", { class: "reread-row" }, label, input, unit, hint);
  element.dataset.field = entry.name;
  tooltip(label, help);
  input.setAttribute("aria-description", help);

  /** @param {string[]} choices @param {string} unset */
  function offer(choices, unset) {
    const now = input.value;
    const missing = now && !choices.includes(now) ? [now] : [];
    input.replaceChildren(
      h("option", { value: "" }, unset),
      ...[...choices, ...missing].map((choice) => h("option", { value: choice }, choice)),
    );
    input.value = now;
  }

  if (listed) offer(entry.choices, text.unset);
  return {
    entry,
    element,
    get value() {
      return valueIn(entry, input.value.trim());
    },
    /** @param {string | number | null | undefined} value */
    set(value) {
      const words = value === null || value === undefined ? "" : wordsOf(entry, value);
      if (listed && words && ![...input.children].some((option) => option.textContent === words))
        input.append(h("option", { value: words }, words));
      input.value = words;
    },
    /** What the file says, and whether the field makes sense for it. @param {Previewed} seen */
    show({ format, choices: offered, account, named }) {
      const used = account?.used[entry.name];
      const choices = choosing ? (offered[entry.name] ?? []) : entry.choices;
      if (listed) offer(choices, used === undefined ? text.unset : text.found(String(used)));
      else Reflect.set(input, "placeholder", used === undefined ? entry.form : wordsOf(entry, used));
      const fits = !entry.only.length || !format || entry.only.includes(format);
      element.hidden = input.value === "" && (!fits || (choosing && choices.length < 2));
      element.classList.toggle("named", named.includes(entry.name));
    },
    focus: () => input.focus(),
  };
}

/** @param {Entry} entry @param {string} words @returns {string | number | null} a text that is no number goes to the server, which says why */
function valueIn({ kind, unit }, words) {
  if (words === "" || kind === "str") return words || null;
  const degrees = unit === "rad" && words.endsWith("°");
  const number = Number(words.replace("°", "").replace("−", "-").replace(",", "."));
  if (!Number.isFinite(number)) return words;
  return degrees ? (number * Math.PI) / 180 : number;
}

/** A change in words, such as "unit of ranges: mm, angle_min: −90°". @param {Entry[]} entries @param {Reading} change */
export function changeWords(entries, change) {
  const parts = Object.entries(change).map(([name, value]) => {
    const entry = entries.find((each) => each.name === name);
    const shown = entry?.unit === "rad" ? `${+((Number(value) * 180) / Math.PI).toFixed(3)}°` : String(value);
    return `${entry?.label ?? name}: ${shown.replace(/^-/, "−")}`;
  });
  return parts.join(", ");
}

/**
 * @param {Entry[]} entries
 * @param {Text} text
 * @param {() => void} onInput
 */
export function createFields(entries, text, onInput) {
  const order = (/** @type {Entry} */ { group }) => GROUPS.indexOf(group);
  const sorted = [...entries].sort((one, other) => order(one) - order(other));
  const rows = sorted.map((entry) => createRow(entry, text, onInput));
  const groups = GROUPS.map((group) => {
    const own = rows.filter(({ entry }) => entry.group === group).map(({ element }) => element);
    return h("fieldset", { class: "reread-group" }, h("legend", {}, text.groups[group]), ...own);
  });

  return {
    element: h("div", { class: "reread-fields" }, ...groups),
    /** @returns {Values} */
    get values() {
      return Object.fromEntries(rows.map(({ entry, value }) => [entry.name, value]));
    },
    /** Changes these fields only. @param {Values} values */
    set(values) {
      for (const row of rows) if (row.entry.name in values) row.set(values[row.entry.name]);
    },
    /** @param {Previewed} seen */
    show(seen) {
      for (const row of rows) row.show(seen);
    },
    /** Goes to the first of these fields. @param {string[]} names */
    focus(names) {
      const row = rows.find(({ entry }) => names.includes(entry.name));
      row?.element.scrollIntoView({ block: "center" });
      row?.focus();
    },
  };
}
