// @ts-check
// Passes each message of the server to the parts that need it.
import { markStage } from "./view/stages.js";

/** @typedef {import("./wire.js").State} State */
/** @typedef {import("./wire.js").Message} Message */

/**
 * @param {import("./page.js").Page} page
 * @param {{address: ReturnType<typeof import("./view/address.js").createAddress>, notices: ReturnType<typeof import("./stage/notices.js").mountNotices>,
 *          work: ReturnType<typeof import("./open/work.js").createWork>, following: {readonly active: boolean},
 *          panel: {refuse: (why: string) => void}, packCard: {take: (pack: import("./wire.js").Pack) => void},
 *          opening: {choose: () => void}, reread: ReturnType<typeof import("./open/reread.js").createReread>}} parts
 * @param {typeof import("./text/page.js").pageText} text
 * @returns {(message: Message, latencyMs: number | null) => void}
 */
export function createReceiver(page, { address, notices, work, following, panel, packCard, opening, reread }, text) {
  const { linked } = address;

  /** @param {import("./wire.js").Welcome} welcome */
  function greet(welcome) {
    page.session.id = welcome.session;
    page.welcome = welcome;
    page.tell("setRecordings", welcome.recordings);
    page.tell("setMethods", welcome.methods);
    page.tell("setScores", welcome.scores);
    page.showMethod();
    page.store.declare(welcome.methods);
    // A resumed session may have thresholds that the link leaves at their defaults.
    if (welcome.resumed) page.link?.send(page.view, true);
    page.tell("setWelcome", welcome);
  }

  /** @param {import("./wire.js").Trouble} trouble */
  function complain({ where, message, refused }) {
    const { drawn, store } = page;
    const gone = where === "recording" && linked.names(page.view.recording);
    if (gone) address.lose();
    if (drawn && page.settled()) {
      if (where === "params") store.restore(drawn.params);
      else page.adoptDrawn();
    }
    if (where === "params") return panel.refuse(message);
    if (refused) page.tell("setRefused", refused, message);
    notices.setLoaded();
    notices.setEmpty();
    document.body.classList.toggle("vacant", !drawn);
    const way = { note: text.stage.linkKept(linked.name), label: text.top.openFile, run: opening.choose };
    const about = gone && linked.name && !message.includes(linked.name) ? `${linked.name}: ${message}` : message;
    const note = drawn ? text.stage.kept : "";
    return notices.setError(about, drawn !== null, refused ? reread.way(refused, note) : gone ? way : undefined);
  }

  /** @param {State} state @param {"page" | "scene"} origin */
  function show(state, origin) {
    const before = page.drawn;
    const { pack, recording } = state;
    const unpacked = pack && recording !== before?.recording && !linked.names(recording) && !following.active;
    page.drawn = Object.freeze({ ...state, marks: state.marks ?? before?.marks ?? {} });
    document.body.classList.remove("vacant");
    if (page.settled()) page.adoptDrawn();
    if (!work.busy && !state.growing) notices.setLoaded();
    page.tell("setState", page.drawn, origin);
    const title = `${state.label} – ${text.appName}`;
    if (document.title !== title) document.title = title;
    markStage("shown", state.rev);
    if (unpacked) packCard.take(pack);
  }

  return (message, latencyMs) => {
    switch (message.type) {
      case "welcome":
        return greet(message);
      case "recordings":
        return page.tell("setRecordings", message.recordings);
      case "loading":
        return page.tell("setLoading", message);
      case "live":
        return page.tell("setLive", message);
      case "error":
        return complain(message);
      case "trace":
        return page.tell("setTrace", message.trace);
      case "times":
        return page.tell("setTimes", message);
      case "survey":
        return page.tell("setSurvey", message);
      case "drawn": {
        const { state, rev, origin } = message;
        return show({ ...state, rev, latencyMs: latencyMs ?? page.drawn?.latencyMs ?? null }, origin);
      }
    }
  };
}
