// @ts-check
// Profiles: thresholds, Reading, layers and layout under a name, in this browser and as small files.
import { keep, recalled } from "../kept.js";
import { sizesIn } from "../layout/layout.js";
import { chooseFile } from "../widgets/choose_file.js";
import { fieldOf } from "../view/fields.js";
import { isIn } from "../view/key.js";
import { download } from "../widgets/clipboard.js";
import { openDialog } from "../widgets/dialog.js";
import { h, setText } from "../widgets/dom.js";
import { toast } from "../widgets/toast.js";

/** @typedef {{format: string, name: string, view: import("../view/fields.js").Patch, layout: import("../layout/layout.js").Sizes}} Profile */

const KEY = "lineseg.profiles";
const FORMAT = "lineseg profile 1";
const LONGEST_NAME = 60;
const LARGEST = 100_000;

/** @typedef {ReturnType<typeof createProfiles>} Profiles */

/**
 * @param {import("../page.js").Page} page
 * @param {{get: () => import("../layout/layout.js").Sizes, set: (sizes: import("../layout/layout.js").Sizes) => void}} layout
 * @param {typeof import("../text/tuning.js").tuningText.profiles} text
 */
export function createProfiles(page, layout, text) {
  /** @param {Profile} profile */
  function use({ name, view, layout: sizes }) {
    if (!page.methods.some((method) => method.name === view.method)) return toast(text.unknown(view.method ?? ""));
    page.change({ ...view, step: page.learning ? 0 : null, selected: null });
    layout.set(sizes);
    return toast(text.used(name));
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
          button(text.remove, () => change(profile.name, null)),
        ),
      ),
    );
  }

  /** @param {string} words @param {Profile | null} profile */
  function change(words, profile) {
    const kept = keepAs(words, profile);
    trouble.hidden = kept;
    if (!kept) setText(trouble, text.full(words));
    refresh();
    return kept;
  }

  function add() {
    const words = name.value.trim();
    if (!words) return name.focus();
    if (change(words, taken(words))) name.value = "";
  }

  /** @param {File[]} files */
  async function read(files) {
    const found = await profileIn(files[0]);
    trouble.hidden = found !== null;
    if (!found) return setText(trouble, text.notOne(files[0].name));
    return change(found.name, found);
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
function keepAs(name, profile) {
  const { [name]: _, ...others } = kept();
  return keep(KEY, JSON.stringify(profile ? { ...others, [name]: profile } : others));
}

/** The profiles of this browser. @returns {Record<string, Profile>} */
function kept() {
  const profiles = Object.entries(recalled(KEY) ?? {}).map(([name, said]) => [name, profileOf(said)]);
  return Object.fromEntries(profiles.filter(([, profile]) => profile));
}

/** The profile in a file; null if it is none. @param {File} file */
async function profileIn(file) {
  if (file.size > LARGEST) return null;
  try {
    return profileOf(JSON.parse(await file.text()));
  } catch {
    return null;
  }
}

/** What is of the right kind in a profile that anybody may have written; the server checks the values. @param {any} said @returns {Profile | null} */
function profileOf(said) {
  const { format, name, view, layout } = said ?? {};
  if (format !== FORMAT || typeof name !== "string" || !name.trim() || typeof view?.method !== "string") return null;
  const { method, params, reading = {}, layers = {} } = view;
  const usual = fieldOf("layers").default;
  const sound =
    consistsOf(params, (value) => Number.isFinite(value)) &&
    consistsOf(reading, (value) => ["string", "number"].includes(typeof value) || value === null) &&
    consistsOf(layers, (value, layer) => typeof value === "boolean" && Object.hasOwn(usual, layer));
  if (!sound) return null;
  return {
    format,
    name: name.trim().slice(0, LONGEST_NAME),
    view: { method, params, reading, layers },
    layout: sizesIn(layout),
  };
}

/** @param {any} values @param {(value: any, name: string) => boolean} fits */
function consistsOf(values, fits) {
  const named = typeof values === "object" && values !== null && !Array.isArray(values);
  return named && Object.entries(values).every(([name, value]) => fits(value, name));
}
