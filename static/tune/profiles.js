// @ts-check
// Profiles: thresholds, Reading, layers and layout under a name, in this browser and as small files.
import { chooseFile } from "../open/files.js";
import { isIn } from "../view/key.js";
import { download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h, setText } from "../widgets/dom.js";
import { toast } from "../widgets/toast.js";

/** @typedef {{format: string, name: string, view: import("../view/fields.js").Patch, layout: import("../layout/layout.js").Sizes}} Profile */

const KEY = "lineseg.profiles";
const FORMAT = "lineseg profile 1";
const LONGEST_NAME = 60;

/** @typedef {ReturnType<typeof createProfiles>} Profiles */

/**
 * @param {import("../page.js").Page} page
 * @param {{get: () => import("../layout/layout.js").Sizes, set: (sizes: import("../layout/layout.js").Sizes) => void}} layout
 * @param {typeof import("../text/tuning.js").tuningText.profiles} text
 */
export function createProfiles(page, layout, text) {
  /** @param {Profile} profile */
  function use({ name, view, layout: sizes }) {
    page.change({ ...view, step: page.learning ? 0 : null, selected: null });
    layout.set(sizes);
    toast(text.used(name));
  }

  /** What is on the screen, without which recording and which frame. @param {string} name @returns {Profile} */
  function taken(name) {
    const { method, params, reading, layers } = page.view;
    return { format: FORMAT, name, view: { method, params, reading, layers }, layout: layout.get() };
  }

  return {
    /** The names of those that set these thresholds. @param {import("../wire.js").Params} params */
    named: (params) =>
      Object.values(kept())
        .filter(({ view }) => view.method === page.view.method && isIn(view.params ?? {}, params))
        .map(({ name }) => name),
    /** For the menu of presets. @returns {import("../widgets/menu.js").Group} */
    group: () => ({
      title: text.title,
      items: [
        ...Object.values(kept()).map((profile) => ({ label: profile.name, run: () => use(profile) })),
        { label: text.manage, run: () => showProfiles(text, { use, taken }) },
      ],
    }),
  };
}

/**
 * The dialog in which profiles are kept, used, saved, removed and opened.
 * @param {typeof import("../text/tuning.js").tuningText.profiles} text
 * @param {{use: (profile: Profile) => void, taken: (name: string) => Profile}} handlers taken: what is on the screen, as a profile
 */
function showProfiles(text, { use, taken }) {
  const name = h("input", { class: "profile-name", maxLength: LONGEST_NAME, placeholder: text.placeholder });
  const trouble = h("p", { class: "panel-error", role: "alert", hidden: true });
  const list = h("ul", { class: "profiles" });
  const button = (/** @type {string} */ label, /** @type {() => void} */ onclick) =>
    h("button", { type: "button", class: "button", onclick }, label);

  function refresh() {
    list.replaceChildren(
      ...Object.values(kept()).map((profile) =>
        h(
          "li",
          {},
          h("span", {}, profile.name),
          button(text.use, () => (dialog.close(), use(profile))),
          button(text.save, () => download(`${profile.name}.lineseg-profile.json`, JSON.stringify(profile, null, 2))),
          button(text.remove, () => (keep(profile.name, null), refresh())),
        ),
      ),
    );
  }

  function add() {
    const words = name.value.trim();
    if (!words) return name.focus();
    keep(words, taken(words));
    name.value = "";
    return refresh();
  }

  /** @param {File[]} files */
  async function read(files) {
    const found = profileIn(await files[0].text());
    trouble.hidden = found !== null;
    if (!found) return setText(trouble, text.notOne(files[0].name));
    keep(found.name, found);
    return refresh();
  }

  const dialog = openDialog(
    text.title,
    text.close,
    h("p", { class: "hint" }, text.hint),
    h("div", { class: "profile-new" }, h("label", {}, text.name, name), button(text.keep, add)),
    list,
    trouble,
    h(
      "div",
      { class: "dialog-buttons" },
      button(text.open, () => chooseFile(read)),
    ),
  );
  name.addEventListener("keydown", ({ key }) => key === "Enter" && add());
  refresh();
  name.focus();
}

/** @param {string} name @param {Profile | null} profile null: no longer */
function keep(name, profile) {
  const { [name]: _, ...others } = kept();
  localStorage.setItem(KEY, JSON.stringify(profile ? { ...others, [name]: profile } : others));
}

/** The profiles of this browser. @returns {Record<string, Profile>} */
function kept() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "{}") ?? {};
  } catch {
    return {};
  }
}

/** The profile in the text of a file; null if it is none. The server checks what it says of the View. @param {string} words @returns {Profile | null} */
function profileIn(words) {
  try {
    const { format, name, view, layout } = JSON.parse(words);
    const { method, params, reading, layers } = view;
    const sound = format === FORMAT && typeof name === "string" && name !== "" && typeof params === "object";
    const sizes = typeof layout === "object" && layout ? layout : {};
    return sound
      ? { format, name: name.slice(0, LONGEST_NAME), view: { method, params, reading, layers }, layout: sizes }
      : null;
  } catch {
    return null;
  }
}
