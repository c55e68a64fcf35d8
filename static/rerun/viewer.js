// @ts-check
// rerun's web viewer in its own iframe: it is told what to show, and it reports its time cursor.

const TIMELINE = "frame";
const RETRY_MS = 100;
const LATEST_MS = 20_000;

// rerun's viewer would send usage data: a request to anywhere but this server gets an empty answer, and is not made.
const fetchHere = window.fetch.bind(window);
window.fetch = async (what, options) => {
  const { origin } = new URL(what instanceof Request ? what.url : what, location.href);
  return origin === location.origin ? fetchHere(what, options) : new Response(null, { status: 204 });
};

/** @param {number} field @param {number[]} content @returns {number[]} a message inside a message of protocol buffers */
function nested(field, content) {
  return [8 * field + 2, ...varint(content.length), ...content];
}

/** @param {number} value */
function varint(value) {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
  return [...bytes, value];
}

/**
 * rerun.viewer_control.v1alpha1.ViewerControlRequest { set_time_cursor { timeline { name } time { time } } }
 * @param {number} frame
 */
function cursorAt(frame) {
  const timeline = nested(2, nested(1, [...new TextEncoder().encode(TIMELINE)]));
  return new Uint8Array(nested(6, [...timeline, ...nested(3, [8, ...varint(frame)])]));
}

/** Whether this browser can run the viewer. */
export function canDraw() {
  return "gpu" in navigator || document.createElement("canvas").getContext("webgl2") !== null;
}

/**
 * Starts the viewer on `url`.
 * @param {string} url of a recording
 * @param {boolean} dark
 * @param {(frame: number) => void} onFrame its cursor moved on the timeline of frames
 */
export async function start(url, dark, onFrame) {
  const rerun = wasm_bindgen;
  await rerun({ module_or_path: "/rerun/re_viewer_bg.wasm" });
  let timeline = TIMELINE;
  let wanted = -1;
  /** @type {() => void} */
  let opened = () => {};
  const open = new Promise((resolve) => (opened = () => resolve(undefined)));
  const handle = new rerun.WebHandle({
    url: [url],
    theme: dark ? "dark" : "light",
    hide_welcome_screen: true,
    check_for_updates_on_startup: false,
    notebook: true,
    persist: false,
    enable_history: false,
    on_viewer_event(/** @type {string} */ words) {
      const event = JSON.parse(words);
      if (event.type === "recording_open") opened();
      if (event.type === "timeline_change") timeline = event.timeline;
      if ("time" in event && timeline === TIMELINE) setTimeout(onFrame, 0, Math.round(event.time));
    },
  });
  await handle.start(document.getElementById("canvas"));
  await open;
  return {
    /**
     * Moves the cursor unless another timeline is selected; a recording that was just opened has none yet.
     * @param {number} frame
     */
    async setFrame(frame) {
      wanted = frame;
      for (const late = Date.now() + LATEST_MS; wanted === frame && timeline === TIMELINE; ) {
        try {
          return await handle.viewer_control(cursorAt(frame));
        } catch (error) {
          if (Date.now() > late) throw error;
          await new Promise((go) => setTimeout(go, RETRY_MS));
        }
      }
      return undefined;
    },
  };
}

Object.assign(window, { rerunViewer: { canDraw, start } });
