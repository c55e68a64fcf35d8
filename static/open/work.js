// @ts-check
// Long work that a person started: one at a time, shown over the scene, and cancelled there or by the next.

/** @typedef {(done: number, total: number) => void} Show */

/**
 * @param {ReturnType<typeof import("../stage/notices.js").mountNotices>} notices
 * @param {typeof import("../text/page.js").pageText.stage} text
 * @param {() => boolean} kept whether something else stays open if it fails
 */
export function createWork(notices, text, kept) {
  /** @type {AbortController | null} */
  let current = null;

  /** @returns {boolean} whether there was something to cancel */
  function cancel() {
    const was = current;
    current = null;
    was?.abort();
    return was !== null;
  }

  return {
    cancel,
    get busy() {
      return current !== null;
    },
    /** @param {string} why */
    refuse(why) {
      notices.setError(why, kept());
    },
    /**
     * @param {string} words what it is
     * @param {(show: Show, signal: AbortSignal) => Promise<void>} run rejects with a sentence
     */
    async run(words, run) {
      cancel();
      notices.dismiss();
      const mine = new AbortController();
      current = mine;
      const show = (/** @type {number} */ done, /** @type {number} */ total) =>
        notices.show(words, done, total, text.scans(done, total));
      show(0, 0);
      try {
        await run(show, mine.signal);
      } catch (error) {
        if (!mine.signal.aborted) notices.setError(String(error instanceof Error ? error.message : error), kept());
      }
      if (mine.signal.aborted) return;
      current = null;
      notices.setLoaded();
    },
  };
}
