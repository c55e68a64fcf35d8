// @ts-check
import { h } from "./dom.js";
import { tooltip } from "./tooltip.js";

const SPEEDS = [1, 2, 5, 10, 20, 40];

/**
 * The menu of playing speeds, in things per second.
 * @param {{speed: string, perSecond: (n: number) => string}} text
 * @param {number} usual
 * @param {(perSecond: number) => void} onSpeed
 */
export function createSpeed(text, usual, onSpeed) {
  const select = h(
    "select",
    { class: "select", "aria-label": text.speed, onchange: () => onSpeed(Number(select.value)) },
    ...SPEEDS.map((n) => h("option", { value: String(n), selected: n === usual }, text.perSecond(n))),
  );
  tooltip(select, text.speed);
  return select;
}
