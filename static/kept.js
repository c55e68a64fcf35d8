// @ts-check
// What this browser keeps from one visit to the next. It keeps nothing for a page in a closed frame, or if told so.

/** @param {string} key @returns {string | null} */
export function recall(key) {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** What was kept as JSON; null if there is none. Another version, or a person, may have put anything there. @param {string} key @returns {any} */
export function recalled(key) {
  try {
    return JSON.parse(recall(key) ?? "null");
  } catch {
    return null;
  }
}

/**
 * Whether it is kept: without room, or if the browser says no, a choice holds until the page is left.
 * @param {string} key @param {string | null} value null: forgets it
 */
export function keep(key, value) {
  try {
    if (value === null) localStorage.removeItem(key);
    else localStorage.setItem(key, value);
    return true;
  } catch {
    return false;
  }
}
