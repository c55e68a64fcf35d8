// @ts-check
// Which session this tab resumes. It rests in sessionStorage only between two loads of the page: a duplicated tab copies
// the storage of a living one, finds nothing there, and so gets a session of its own.

const KEY = "lineseg.session";

/**
 * The former session, and the hash to begin with: the address bar may lag a moment behind the View that was left.
 * @returns {{id: string | null, rev: number, hash: string}}
 */
export function takeSession() {
  const kept = sessionStorage.getItem(KEY);
  sessionStorage.removeItem(KEY);
  try {
    const { id, rev, shown, hash } = JSON.parse(kept ?? "");
    return {
      id: String(id),
      rev: Number(rev) || 0,
      hash: shown === location.hash || reloaded() ? String(hash) : location.hash,
    };
  } catch {
    return { id: null, rev: 0, hash: location.hash };
  }
}

/** A reload begins with the address of the moment when it was asked for, and the page may have written a newer one since. */
function reloaded() {
  const [navigation] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType("navigation"));
  return navigation?.type === "reload";
}

/** @param {() => {id: string | null, rev: number, hash: string}} current */
export function keepSessionOnLeave(current) {
  addEventListener("pagehide", () => {
    const { id, rev, hash } = current();
    if (id) sessionStorage.setItem(KEY, JSON.stringify({ id, rev, hash, shown: location.hash }));
  });
  addEventListener("pageshow", (event) => event.persisted && sessionStorage.removeItem(KEY));
}
