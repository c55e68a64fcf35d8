// @ts-check
// The address bar: the View as a hash, written soon after each change and read when it is opened; links to copy.
import { copy } from "../widgets/clipboard.js";
import { toast } from "../widgets/toast.js";
import { presenterIn } from "./follow.js";
import { createLinked } from "./linked.js";

/** @typedef {import("./hash.js").Look} Look */

const DELAY_MS = 200;

/**
 * @param {import("../page.js").Page} page
 * @param {{top: typeof import("../text/page.js").pageText.top, follow: typeof import("../text/page.js").pageText.follow}} text
 * @param {{following: () => string | null, onLook: (look: Look | null) => void, onLead: () => void}} handlers
 *   following: the presenter that this tab mirrors; onLook: what to look at in the recording of the link; onLead: the link means its most suspicious frame
 */
export function createAddress(page, text, { following, onLook, onLead }) {
  const linked = createLinked();
  let timer = 0;
  /** The place of the last drawn state. @type {string | null} */
  let shown = null;
  addEventListener("hashchange", ({ newURL }) => {
    // The page may have written the address since.
    const { hash } = new URL(newURL);
    if (!presenterIn(hash)) return read(hash);
    history.replaceState(null, "", hash);
    return location.reload();
  });

  function write() {
    clearTimeout(timer);
    timer = 0;
    if (linked.held) return;
    const presenter = following();
    const hash = presenter === null ? page.store.hash : `follow=${presenter}`;
    if (`#${hash}` !== location.hash) history.replaceState(null, "", `#${hash}`);
  }

  function writeSoon() {
    if (!timer) timer = setTimeout(write, DELAY_MS);
  }

  /** @param {string} hash */
  function read(hash) {
    const named = page.store.read(hash);
    if (page.store.leads) onLead();
    if (!named) return;
    linked.open(page.view, page.store.name);
    onLook(page.store.look);
  }

  const followLink = () => `${location.origin}${location.pathname}#follow=${page.welcome?.presenter ?? ""}`;

  return {
    linked,
    read,
    write,
    writeSoon,
    get followLink() {
      return followLink();
    },
    async copyLink() {
      linked.release();
      write();
      await copy(location.href);
      toast(page.view.recording?.startsWith("upload:") ? text.top.linkCopiedUpload : text.top.linkCopied);
    },
    async copyFollowLink() {
      await copy(followLink());
      toast(text.follow.copied);
    },
    /** The recording of the link cannot be opened. */
    lose() {
      linked.lose();
      onLook(null);
    },
    /** @param {unknown} _ @param {import("../parts.js").Change} change */
    setView(_, { patch }) {
      if (patch) linked.release();
      writeSoon();
    },
    /** @param {import("../wire.js").State} state */
    setState({ recording, place, label }) {
      page.store.name = label;
      // A recording shown instead of the one in the link must not hide the reason.
      const opened = shown !== null && place !== shown;
      shown = place;
      if (!opened) return;
      linked.opened(recording);
      if (!linked.names(recording)) onLook(null);
    },
  };
}
