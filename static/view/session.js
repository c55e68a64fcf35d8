// @ts-check
// Which session this tab resumes. It is in sessionStorage only between two loads of the page: a duplicated tab copies
// the storage of an open tab, finds nothing there, and so gets its own session.

const KEY = "lineseg.session";

/**
 * The previous session and the initial hash: the address bar may lag behind the last View.
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

/** A reload uses the address at the time of the request; the page may have written a newer one since. */
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
