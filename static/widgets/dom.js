// @ts-check

/**
 * An element with properties (`class`, `aria-…`, `data-…` as attributes, `on…` as listeners) and children.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} [props]
 * @param {...(Node | string | null | undefined)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function h(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || value === null) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "class") element.className = value;
    else if (/^(aria-|data-|role$|for$|list$|popover$)/.test(name)) element.setAttribute(name, String(value));
    else Reflect.set(element, name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

const SVG = "http://www.w3.org/2000/svg";

/**
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 * @returns {SVGElement}
 */
export function svg(tag, attributes = {}) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

/** Sets text only if it changed, so that live regions and selections are not disturbed. @param {Element} element @param {string} value */
export function setText(element, value) {
  if (element.textContent !== value) element.textContent = value;
}

/** @param {string} words */
export function sentenceCase(words) {
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Scrolls the part of a panel that holds an element until it can be seen; the page around it stays where it is. @param {Element | null | undefined} element */
export function scrollInPanel(element) {
  const scrolls = (/** @type {Element} */ holder) => /auto|scroll/.test(getComputedStyle(holder).overflowY);
  let holder = element?.parentElement;
  while (holder && !scrolls(holder)) holder = holder.parentElement;
  if (!element || !holder?.closest(".panel")) return;
  const [part, room] = [element.getBoundingClientRect(), holder.getBoundingClientRect()];
  holder.scrollTop += Math.min(0, part.top - room.top) + Math.max(0, part.bottom - room.bottom);
}
