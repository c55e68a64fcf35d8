// @ts-check
// The link that opened this page, while its recording is not available: the address stays unchanged, and the settings of
// the link are applied to the file once it is opened.

/** @typedef {import("../wire.js").View} View */
/** @typedef {import("./fields.js").Patch} Patch */

export function createLinked() {
  /** @type {Readonly<View> | null} */
  let link = null;
  /** The name of its file, if the link contains it. */
  let name = "";
  let lost = false;
  let held = false;

  return {
    /** @param {Readonly<View>} view @param {string} called */
    open(view, called) {
      [link, name, lost, held] = [view, called, false, false];
    },
    /** Whether a recording is shown or requested because of the link. @param {string | null} recording */
    names: (recording) => link !== null && link.recording === recording,
    get name() {
      return name;
    },
    lose() {
      lost = held = true;
    },
    /** Whether the address still names a recording that cannot be shown. */
    get held() {
      return held;
    },
    /** The person moved on to something else. */
    release() {
      held = false;
    },
    /** Another recording was opened. @param {string} recording */
    opened(recording) {
      lost = false;
      if (link && recording !== link.recording) link = null;
    },
    /** The other settings of the link, if this is its file. @param {string} file @returns {Patch} */
    rest(file) {
      if (!lost || !link || (name && name !== file)) return {};
      const { recording, dark, ...rest } = link;
      return rest;
    },
  };
}
