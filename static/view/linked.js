// @ts-check
// The link that this page was opened with, as long as its recording cannot be had: the address stays as it was, and what
// the link says goes with the file once that is opened.

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("./fields.js").Patch} Patch */

export function createLinked() {
  /** @type {Readonly<View> | null} */
  let link = null;
  /** What its file is called, where the link says so. */
  let name = "";
  let lost = false;
  let held = false;

  return {
    /** @param {Readonly<View>} view @param {string} called */
    open(view, called) {
      [link, name, lost, held] = [view, called, false, false];
    },
    /** Whether a recording is shown, or wanted, because the link says so. @param {string | null} recording */
    names: (recording) => link !== null && link.recording === recording,
    get name() {
      return name;
    },
    lose() {
      lost = held = true;
    },
    /** The address still says what cannot be shown. */
    get held() {
      return held;
    },
    /** The person goes on with something else. */
    release() {
      held = false;
    },
    /** Another recording was opened. @param {string} recording */
    opened(recording) {
      lost = false;
      if (link && recording !== link.recording) link = null;
    },
    /** What the link says besides its recording, if this is the file. @param {string} file @returns {Patch} */
    rest(file) {
      if (!lost || !link || (name && name !== file)) return {};
      const { recording, dark, ...rest } = link;
      return rest;
    },
  };
}
