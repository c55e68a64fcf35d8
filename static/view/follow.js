// @ts-check
// Mirroring another tab: the bar that says so, and the gate that keeps this tab from changing what it mirrors.
import { fetchText } from "../fetch.js";
import { keep, recall } from "../kept.js";
import { h, setText } from "../widgets/dom.js";
import { OWN } from "./fields.js";

/** @typedef {import("./fields.js").Patch} Patch */
/** @typedef {"here" | "away" | "gone"} Presence */

const HASH = /^#follow=([\w-]+)$/;
// The server accepts no longer id; a shortened id belongs to nobody.
const LONGEST_ID = 64;
const LONGEST_NAME = 40;
const NAME_KEY = "lineseg.name";

/** The presenter in a link. @param {string} hash @returns {string | null} */
export function presenterIn(hash) {
  return HASH.exec(hash)?.[1].slice(0, LONGEST_ID) ?? null;
}

/**
 * @param {typeof import("../text/page.js").pageText.follow} text
 * @param {{presenter: string | null, onFollow: (presenter: string | null) => void, session: () => string, done: () => number}} handlers
 *   onFollow: null to stop; done: number of lessons that are done
 */
export function createFollow(text, { presenter, onFollow, session, done }) {
  let active = presenter !== null;
  /** @type {Presence | null} */
  let presence = null;
  const words = h("span", { role: "status" });
  const button = h("button", { type: "button", class: "button", onclick: () => turn(!active) });
  const name = h("input", { type: "text", maxLength: LONGEST_NAME, "aria-label": text.name, placeholder: text.name });
  name.value = recall(NAME_KEY) ?? "";
  name.addEventListener("change", () => {
    keep(NAME_KEY, name.value);
    tellTeacher();
  });
  const element = h("div", { class: "follow", hidden: presenter === null }, words, name, button);
  /** What the teacher's tab knows. */
  let told = "";
  show();

  /** Says who is here, if that has changed. */
  async function tellTeacher() {
    const said = JSON.stringify({ name: name.value.trim(), done: done() });
    if (presence === null || presence === "gone" || `${session()} ${said}` === told) return;
    told = `${session()} ${said}`;
    await fetchText(`/api/class/me?${new URLSearchParams({ session: session() })}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: said,
    });
  }

  /** @param {boolean} on */
  function turn(on) {
    active = on;
    if (on) presence = null;
    show();
    onFollow(on ? presenter : null);
  }

  function show() {
    setText(
      words,
      presence === "gone" ? text.gone : !active ? text.left : presence === "away" ? text.away : text.following,
    );
    setText(button, active ? text.stop : text.again);
    button.hidden = presence === "gone";
    element.classList.toggle("active", active);
  }

  return {
    element,
    get active() {
      return active;
    },
    /** The presenter that this tab mirrors, for the server. */
    get presenter() {
      return active ? presenter : null;
    },
    /** Whether this tab may make this change. @param {Patch} patch */
    allows(patch) {
      const allowed = !active || Object.keys(patch).every((name) => OWN.has(name));
      if (!allowed)
        element.animate?.([{ scale: 1 }, { scale: 1.04 }, { scale: 1 }], {
          duration: matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 250,
        });
      return allowed;
    },
    /** @param {{following: Presence | null}} state */
    setState({ following: next }) {
      if (next === null && presence !== "gone") return void (told && tellTeacher());
      presence = next ?? presence;
      tellTeacher();
      if (presence === "gone") active = false;
      show();
    },
  };
}
