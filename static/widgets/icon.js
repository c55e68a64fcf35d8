// @ts-check
// Icons on a grid of 16, drawn with strokes of the text's colour.
import { h, svg } from "./dom.js";
import { tooltip } from "./tooltip.js";

const PATHS = {
  play: "M5 3.2v9.6l7.6-4.8z",
  pause: "M5.5 3.5v9M10.5 3.5v9",
  first: "M4 3.5v9M12 3.8 7 8l5 4.2z",
  back: "M10.5 3.5 5.5 8l5 4.5",
  forward: "M5.5 3.5l5 4.5-5 4.5",
  last: "M12 3.5v9M4 3.8 9 8l-5 4.2z",
  fit: "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
  cube: "M8 1.8 13.5 5v6L8 14.2 2.5 11V5zM2.5 5 8 8l5.5-3M8 8v6.2",
  layers: "M8 2 14 5.5 8 9 2 5.5zM2.5 8.5 8 11.7l5.5-3.2M2.5 11 8 14.2l5.5-3.2",
  world: "M2 3.5l4-1.5 4 1.5L14 2v10.5L10 14l-4-1.5L2 14zM6 2v10.5M10 3.5V14",
  plus: "M8 3v10M3 8h10",
  minus: "M3 8h10",
  close: "M4 4l8 8M12 4l-8 8",
  chevron: "M4.5 6.5 8 10l3.5-3.5",
  undo: "M5.5 3 2.5 6l3 3M2.8 6H10a3.5 3.5 0 0 1 0 7H6",
  redo: "M10.5 3l3 3-3 3M13.2 6H6a3.5 3.5 0 0 0 0 7h4",
  link: "M6.8 9.2a2.6 2.6 0 0 0 3.7 0l2.2-2.2A2.6 2.6 0 0 0 9 3.3l-.8.8M9.2 6.8a2.6 2.6 0 0 0-3.7 0L3.3 9A2.6 2.6 0 0 0 7 12.7l.8-.8",
  sun: "M8 5.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6zM8 1.5v1.2M8 13.3v1.2M1.5 8h1.2M13.3 8h1.2M3.4 3.4l.9.9M11.7 11.7l.9.9M12.6 3.4l-.9.9M4.3 11.7l-.9.9",
  moon: "M13 9.6A5.6 5.6 0 1 1 6.4 3a4.6 4.6 0 0 0 6.6 6.6z",
  auto: "M8 2.2a5.8 5.8 0 1 0 0 11.6A5.8 5.8 0 0 0 8 2.2zM8 2.2v11.6M8 5h3.8M8 8h5.6M8 11h3.8",
  warning: "M8 2.2 14.2 13H1.8zM8 6.5v3M8 11.2v.1",
  zoom: "M7 2.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9zM10.3 10.3l3.7 3.7M7 5v4M5 7h4",
  loop: "M3 7.5A3.5 3.5 0 0 1 6.5 4H13M10.8 1.8 13 4l-2.2 2.2M13 8.5A3.5 3.5 0 0 1 9.5 12H3M5.2 9.8 3 12l2.2 2.2",
  ruler: "M1.8 10.8 10.8 1.8 14.2 5.2 5.2 14.2zM4.3 8.3l1.5 1.5M6.3 6.3l2 2M8.3 4.3l1.5 1.5",
  check: "M3.5 8.5l3 3 6-7",
};

/** @typedef {keyof typeof PATHS} IconName */

/** @param {IconName} name */
export function icon(name) {
  const element = svg("svg", { viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true" });
  element.append(svg("path", { d: PATHS[name] }));
  return element;
}

/**
 * @param {IconName} name
 * @param {string} label accessible name and tooltip
 * @param {(event: MouseEvent) => void} onClick
 * @returns {HTMLButtonElement & {show: (name: IconName, label: string) => void}}
 */
export function iconButton(name, label, onClick) {
  const button = h(
    "button",
    { type: "button", class: "icon-button", "aria-label": label, onclick: onClick },
    icon(name),
  );
  tooltip(button, () => button.getAttribute("aria-label") ?? "");
  let shown = name;
  /** @param {IconName} next @param {string} nextLabel */
  const show = (next, nextLabel) => {
    if (next !== shown) button.replaceChildren(icon(next));
    shown = next;
    if (button.getAttribute("aria-label") !== nextLabel) button.setAttribute("aria-label", nextLabel);
  };
  return Object.assign(button, { show });
}
