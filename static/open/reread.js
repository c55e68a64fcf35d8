// @ts-check
// How files are read: what was noticed is told, and a person may have a file read in another way.
import { createNoticed } from "./noticed.js";
import { openPanel } from "./reread_panel.js";

/** @typedef {import("./reread_fields.js").Values} Values */
/** @typedef {import("../view/fields.js").Patch} Patch */

// With these unchanged, a frame stays the same frame.
const CHOOSE_SCANS = ["topic", "frame_id", "geometry", "columns", "skip_columns"];

/** A Reading as the View has it: the topic apart. @param {Values} values */
function parted({ topic = null, ...reading }) {
  return { topic: topic === null ? null : String(topic), reading };
}

/**
 * @param {import("../page.js").Page} page
 * @param {typeof import("../text/reading.js").readingText} text
 * @param {{add: (notice: HTMLElement) => void}} notices
 */
export function createReread(page, text, notices) {
  const entries = () => page.welcome?.reading ?? [];
  const noticed = createNoticed(text, { entries, onMend: mend, onChange: openShown });
  notices.add(noticed.element);

  /** @param {import("./reread_panel.js").Subject} subject */
  function open(subject) {
    const { recording, topic, reading } = subject;
    openPanel(entries(), text, subject, (values) => read(recording, { ...reading, topic }, values));
  }

  /** Opens the panel for the recording on the screen. */
  function openShown() {
    const { drawn } = page;
    if (!drawn?.account) return;
    const named = drawn.account.guesses.map(({ field }) => field);
    open({ recording: drawn.recording, label: drawn.label, ...parted(drawn.readAs), named });
  }

  /** Reads a recording in another way. The frame stays if the same scans are read. @param {string} recording @param {Values} before @param {Values} after */
  function read(recording, before, after) {
    const sameScans = CHOOSE_SCANS.every((name) => (before[name] ?? null) === (after[name] ?? null));
    const frame = sameScans && recording === page.view.recording ? { frame: page.view.frame } : {};
    page.change({ recording, ...parted(after), ...frame });
  }

  /** Changes how the recording on the screen is read. @param {Values} values */
  function mend(values) {
    const { drawn } = page;
    if (!drawn) return;
    const usual = Object.fromEntries(entries().map(({ name }) => [name, null]));
    read(drawn.recording, drawn.readAs, { ...usual, ...drawn.readAs, ...values });
  }

  return {
    /** What was noticed. */
    notice: noticed.element,
    openShown,
    mend,
    /** The way on from an error. @param {import("../wire.js").Refused} refused @param {string} note */
    way: (refused, note) => ({ note, label: text.readAs, run: () => open(refused) }),
    /** Opens a recording of the menu, read as the last time. @param {import("../wire.js").RecordingEntry} entry */
    choose({ id, reading }) {
      const last = Object.keys(reading).length ? parted(reading) : {};
      page.change({ recording: id, ...last });
    },
    setState: noticed.setState,
  };
}
