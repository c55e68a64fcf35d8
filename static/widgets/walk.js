// @ts-check
// The keyboard on a picture of many things: arrow keys go from one to the next, Enter acts like a click.
import { clamp } from "./scale.js";

const FAR = 10;

/**
 * @param {HTMLElement} element
 * @param {string} label
 * @param {object} things
 * @param {() => number} things.count
 * @param {() => number} things.start where the first key begins
 * @param {(at: number) => string} things.say
 * @param {(at: number | null) => void} things.onAt null when the picture is left
 * @param {(at: number) => void} things.onTake
 */
export function createWalk(element, label, { count, start, say, onAt, onTake }) {
  /** @type {number | null} */
  let at = null;
  element.tabIndex = 0;
  element.setAttribute("role", "slider");
  element.setAttribute("aria-label", label);

  const here = () => at ?? clamp(start(), 0, count() - 1);
  function tell() {
    element.setAttribute("aria-valuemin", "0");
    element.setAttribute("aria-valuemax", String(Math.max(0, count() - 1)));
    element.setAttribute("aria-valuenow", String(count() ? here() : 0));
    element.setAttribute("aria-valuetext", count() ? say(here()) : "");
  }
  /** @param {number | null} next */
  function go(next) {
    at = next === null || !count() ? null : clamp(next, 0, count() - 1);
    tell();
    onAt(at);
  }

  element.addEventListener("focus", () => element.matches(":focus-visible") && go(here()));
  element.addEventListener("blur", () => go(null));
  element.addEventListener("keydown", (event) => {
    const by = {
      ArrowRight: 1,
      ArrowUp: 1,
      ArrowLeft: -1,
      ArrowDown: -1,
      PageUp: FAR,
      PageDown: -FAR,
      Home: -Infinity,
      End: Infinity,
    }[event.key];
    const takes = event.key === "Enter" || event.key === " ";
    if (!count() || event.ctrlKey || event.metaKey || event.altKey || (by === undefined && !takes)) return;
    event.preventDefault();
    event.stopPropagation();
    if (by === undefined) onTake(here());
    else go(here() + by);
  });

  return {
    get at() {
      return at;
    },
    /** The things changed. @param {number | null} next where the walk goes on, if it is under way */
    renew(next) {
      at = at === null || next === null || next < 0 ? null : next;
      tell();
    },
  };
}
