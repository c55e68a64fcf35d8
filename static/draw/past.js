// @ts-check
// The undo of a drawn world: ids of worlds, one per gesture.

const LONGEST = 200;

export class Past {
  /** @type {string[]} */ #past = [];
  /** @type {string[]} */ #future = [];
  /** The world before the current gesture. @type {string | null} */ #before = null;

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Whether a gesture is under way. */
  get open() {
    return this.#before !== null;
  }

  /** Starts a gesture, unless one is under way. @param {string} now */
  begin(now) {
    this.#before ??= now;
  }

  /** Ends the gesture. @param {string} now */
  end(now) {
    if (this.#before !== null && this.#before !== now) {
      this.#past = [...this.#past.slice(-LONGEST), this.#before];
      this.#future = [];
    }
    this.#before = null;
  }

  /** @param {string} now @returns {string | null} */
  undo(now) {
    return travel(this.#past, this.#future, now);
  }

  /** @param {string} now @returns {string | null} */
  redo(now) {
    return travel(this.#future, this.#past, now);
  }

  forget() {
    [this.#past, this.#future, this.#before] = [[], [], null];
  }
}

/** @param {string[]} from @param {string[]} to @param {string} now @returns {string | null} */
function travel(from, to, now) {
  const there = from.pop();
  if (there === undefined) return null;
  to.push(now);
  return there;
}
