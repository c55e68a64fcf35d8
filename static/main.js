// @ts-check
// Wiring only: who tells whom.
import { createDraw } from "./draw/draw.js";
import { createPackCard } from "./export/pack.js";
import { createTake } from "./export/take.js";
import { catchDrops, chooseFile, pick, upload } from "./open/files.js";
import { createFollow, presenterIn } from "./view/follow.js";
import { keyboard, showHelp } from "./keys.js";
import { createAb } from "./inspect/ab.js";
import { createFilter } from "./inspect/filter.js";
import { createFrames } from "./inspect/frames.js";
import { createTruth } from "./inspect/truth.js";
import { createWeights } from "./inspect/weights.js";
import { createWhatIf } from "./inspect/what_if.js";
import { createWords } from "./inspect/words.js";
import { createLabels } from "./label/labels.js";
import { createLayers } from "./stage/layers.js";
import { mountLearn } from "./learn/learn.js";
import { Link } from "./view/link.js";
import { createLinked } from "./view/linked.js";
import { createLive } from "./live/pill.js";
import { showPublish, showSend, stopPublishing } from "./live/robot.js";
import { createModes } from "./bars/modes.js";
import { mountNotices } from "./stage/notices.js";
import { addressOf, record } from "./rerun/run.js";
import { mountRerun } from "./rerun/tab.js";
import { keepSessionOnLeave, takeSession } from "./view/session.js";
import { mountStage } from "./stage/stage.js";
import { mountStatus } from "./bars/status.js";
import { Store } from "./view/store.js";
import { text } from "./text/en.js";
import { drawText } from "./text/draw.js";
import { exportText } from "./text/export.js";
import { inspectText } from "./text/inspect.js";
import { labelText } from "./text/label.js";
import { learnText } from "./text/learn.js";
import { liveText } from "./text/live.js";
import { rerunText } from "./text/rerun.js";
import { tuningText } from "./text/tuning.js";
import { mountTimeline } from "./bars/timeline.js";
import { mountTopbar } from "./bars/topbar.js";
import { createExchange, fetchText } from "./tune/exchange.js";
import { createExplanation } from "./tune/explanation.js";
import { mountPanel } from "./tune/panel.js";
import { mountReplay } from "./tune/replay.js";
import { isSweepTable } from "./tune/sweep_table.js";
import { createTuner } from "./tune/tuner.js";
import { copy } from "./widgets/clipboard.js";
import { h } from "./widgets/dom.js";
import { iconButton } from "./widgets/icon.js";
import { closePopovers } from "./widgets/menu.js";
import { toast } from "./widgets/toast.js";

/** @typedef {import("./wire.js").State} State */
/** @typedef {import("./wire.js").Method} Method */
/** @typedef {import("./wire.js").Message} Message */

const HASH_DELAY_MS = 200;
const LOST_DELAY_MS = 600;
const THEME_KEY = "lineseg.theme";

/** @param {string} id */
const part = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

const store = new Store();
const session = takeSession();
/** @type {State | null} */
let drawn = null;
/** @type {Method[]} */
let methods = [];
let uploadLimit = Infinity;
let fitted = "";
/** What a link says of the plan, until the plan is there. @type {import("./view/store.js").Look | null} */
let lookedFor = null;
/** The world that drawing begins with. */
let firstDrawing = "";
/** @type {(() => void) | null} */
let cancelUpload = null;

// --- parts -----------------------------------------------------------------------------------------------------------

const settled = () => link.settled;
const linked = createLinked();
const following = createFollow(text.follow, {
  presenter: presenterIn(session.hash),
  onFollow(presenter) {
    link.follow(presenter);
    writeHash();
  },
});
store.allows = following.allows;
/** Under which others may follow this tab. */
let presenterId = "";
const stage = mountStage(part("stage"), text.stage, { onKey: (event) => press(event), onFrame: acceptDrops });
const notices = mountNotices(part("stage"), text.stage, { onCancel: cancel, onRetry: () => link.retry() });
const layers = createLayers(text, (switched) => store.change({ layers: switched }));
const fitButton = iconButton("fit", text.stage.fit, fit);
const cameraButton = iconButton("cube", text.stage.free, toggleCamera);
part("stage").append(h("div", { class: "stage-tools" }, fitButton, cameraButton, layers.button), layers.list);
const explanation = createExplanation(text.explanation, {
  onClose: () => store.change({ selected: null }),
  onChange: (name, value) => store.change({ params: { [name]: value } }),
});
part("stage").append(explanation.element);
part("stage").setAttribute("aria-label", text.stage.label);
const labels = createLabels(part("stage"), stage, labelText, {
  onFrame: goToFrame,
  number: (frame) => timeline.number(frame),
});
const weights = createWeights(inspectText.weights, (changed) =>
  store.change({ weights: { ...store.view.weights, ...changed } }),
);
const words = createWords({
  session: () => session.id ?? "",
  wanted: () => [...frames.inView, ...filter.unknown()],
  onWords: showWords,
});
const filter = createFilter(inspectText.filter, {
  words: (frame) => words.of(frame),
  onChange: filterFrames,
  onTags: (tags) => labels.suggest(tags),
});
const frames = createFrames(inspectText.frames, {
  onFrame: goToFrame,
  onScore: (score) => store.change({ score }),
  number: (frame) => timeline.number(frame),
  value: (frame) => timeline.words(frame),
  words: (frame) =>
    [
      filter.line(frame),
      words.of(frame)?.join(" · ") || (words.of(frame) ? inspectText.nothingWrong : timeline.summary(frame)),
    ]
      .filter(Boolean)
      .join(" · "),
  passes: (frame) => filter.passes(frame),
  filter: filter.element,
  onRows: () => store.view.mode === "inspect" && words.need(),
  extra: weights.element,
});
const ab = createAb(inspectText.ab, {
  onToggle: togglePin,
  onSwap: () => store.view.against && store.change({ ...store.view.against, against: present(), step: null }),
  onAdopt: () => store.view.against && store.change({ ...store.view.against, against: null, step: null }),
  onNext: nextDifference,
});
const draw = createDraw(part("stage"), stage, drawText, {
  onRecording: (recording) => store.change({ recording, step: store.view.step }),
  onSave: () =>
    h("a", { href: `/api/recording?${new URLSearchParams({ session: session.id ?? "" })}`, download: "" }).click(),
});
const packCard = createPackCard(exportText.card, takePack);
part("stage").append(h("div", { class: "stage-cards" }, packCard.element, ab.element, draw.card));
part("stage").append(following.element);
const truth = createTruth(inspectText.truth, {
  session: () => session.id ?? "",
  onShow: (verdicts) => store.change({ layers: { verdicts } }),
  onReference: (reference) => store.change({ reference }),
});
const whatIf = createWhatIf({
  session: () => session.id ?? "",
  onChanges(changes) {
    panel.setMarks(changes);
    explanation.setChanges(changes, drawn ? methodOf(drawn.method).knobs : []);
  },
});
const tuner = createTuner(tuningText, { session: () => session.id, onParams: (params) => store.change({ params }) });
const panel = mountPanel(
  part("panel"),
  text,
  {
    onParams: (params, gesture) => store.change({ params }, gesture),
    onSelect: (selected) => store.change({ selected }),
    onUndo: () => store.undo(),
    onRedo: () => store.redo(),
  },
  [
    { name: "frames", label: inspectText.tabs.frames, content: frames.element },
    { name: "labels", label: labelText.tab, content: labels.element },
    { name: "truth", label: inspectText.tabs.truth, content: truth.element },
  ],
  tuner,
);
const replay = mountReplay(part("replay"), text, { onStep: (step) => store.change({ step }), settled });
const learn = mountLearn(
  { stage: part("stage"), view: stage, dock: part("stepper"), panel: part("learn") },
  { tune: text.tune, learn: learnText },
  {
    onStep: (step) => store.change({ step }),
    onChange: (patch, gesture = null) => store.change(patch, gesture),
    onDraw: () => firstDrawing && store.change({ recording: firstDrawing, step: null }),
    settled,
    session: () => session.id ?? "",
  },
);
const modes = createModes(learnText.modes, setMode);
const live = createLive(liveText, { onFollow: follow });
const rerun = mountRerun(part("stage"), rerunText, {
  session: () => session.id ?? "",
  dark: () => store.view.dark,
  onFrame: goToFrame,
  cancelLabel: text.stage.cancel,
});
modes.element.append(rerun.button);
const timeline = mountTimeline(part("timeline"), text.timeline, {
  onFrame: goToFrame,
  onScore: (score) => store.change({ score }),
  onScores: showScored,
  onFollow: follow,
  settled,
  pill: live.button,
});
part("timeline").setAttribute("aria-label", text.timeline.label);
const status = mountStatus(part("status"), text.status);
part("status").insertBefore(live.element, part("status").querySelector(".spacer"));
const take = createTake(exportText, { session: () => session.id ?? "", state: () => drawn, work: longWork });
const exchange = createExchange(text, {
  params: () => store.view.params,
  method: () => methodOf(store.view.method),
  onImport: importParams,
  first: take.groups,
  more: () => [
    ...robotCommands(),
    rerunCommands(),
    { title: text.follow.title, items: [{ label: text.follow.copy, run: copyFollowLink }] },
  ],
});
const topbar = mountTopbar(part("topbar"), text, {
  exchange: exchange.element,
  ab: ab.button,
  modes: modes.element,
  theme: savedTheme(),
  onRecording: (recording) => store.change({ recording }),
  onOpen: () => chooseFile(open),
  onTopic: (topic) => store.change({ topic, frame: 0, step: null, selected: null }),
  onMethod: (method) => store.change({ method, step: learning() ? 0 : null }),
  onLink: copyLink,
  onTheme: setTheme,
  onHelp: () => showHelp(bindings, text),
});

// --- keyboard and files ----------------------------------------------------------------------------------------------

const learning = () => store.view.mode === "learn";
const replaying = () => learning() || store.view.step !== null;
const steps = () => (learning() ? learn.stepper : replay);
const does = text.help.keys;
/** @type {import("./keys.js").Binding[]} */
const bindings = [
  { keys: ["Space"], shown: "␣", does: does.play, run: () => (replaying() ? steps().togglePlay() : timeline.toggle()) },
  { keys: ["ArrowLeft"], shown: "← →", does: does.step, run: () => place().move(-1) },
  { keys: ["ArrowRight"], shown: "", does: "", run: () => place().move(1) },
  { keys: ["Shift+ArrowLeft"], shown: "", does: "", run: () => place().move(-10) },
  { keys: ["Shift+ArrowRight"], shown: "", does: "", run: () => place().move(10) },
  { keys: ["Home"], shown: "Home End", does: does.ends, run: () => place().move(-Infinity) },
  { keys: ["End"], shown: "", does: "", run: () => place().move(Infinity) },
  { keys: ["r"], shown: "R", does: does.replay, run: () => steps().toggle() },
  { keys: ["s"], shown: "S N D", does: does.jumps, run: () => (labels.active ? labels.split() : steps().jump("seed")) },
  { keys: ["n"], shown: "", does: "", run: () => (replaying() ? steps().jump("line") : doubtful(1)) },
  { keys: ["d"], shown: "", does: "", run: () => steps().jump("drop") },
  { keys: ["x"], shown: "X M C", does: learnText.keys.jumps, run: () => learning() && learn.stepper.jump("refusal") },
  {
    keys: ["m"],
    shown: "",
    does: "",
    run: () => (labels.active ? labels.merge(1) : learning() && learn.stepper.jump("merge")),
  },
  { keys: ["c"], shown: "", does: "", run: () => learning() && learn.stepper.jump("cut") },
  { keys: ["z"], shown: "Z", does: learnText.keys.zoom, run: () => learning() && learn.zoom() },
  { keys: ["Shift+n"], shown: "N Shift+N", does: does.doubtful, run: () => !replaying() && doubtful(-1) },
  { keys: ["b"], shown: "B Shift+B", does: inspectText.keys.ab, run: togglePin },
  { keys: ["Shift+b"], shown: "", does: "", run: nextDifference },
  { keys: ["e"], shown: "E", does: labelText.keys.open, run: openLabels },
  { keys: ["a"], shown: "A S M Del", does: labelText.keys.edit, run: () => labels.active && labels.draw() },
  { keys: ["Shift+m"], shown: "", does: "", run: () => labels.active && labels.merge(-1) },
  { keys: ["Delete", "Backspace"], shown: "", does: "", run: () => labels.active && labels.remove() },
  { keys: ["1"], shown: "1 2", does: learnText.keys.answer, run: () => learning() && learn.answer(true) },
  { keys: ["2"], shown: "", does: "", run: () => learning() && learn.answer(false) },
  { keys: ["f"], shown: "F", does: does.fit, run: fit },
  { keys: ["v"], shown: "V", does: does.view, run: toggleCamera },
  { keys: ["l"], shown: "L", does: does.layers, run: () => layers.button.click() },
  { keys: ["o", "Ctrl+o"], shown: "O", does: does.open, run: () => chooseFile(open) },
  { keys: ["Ctrl+z"], shown: "Ctrl+Z", does: does.undo, run: () => editor().undo() },
  { keys: ["Ctrl+Shift+z", "Ctrl+y"], shown: "Ctrl+Shift+Z", does: does.redo, run: () => editor().redo() },
  { keys: ["Escape"], shown: "Esc", does: does.escape, run: leave },
  { keys: ["?"], shown: "?", does: does.help, run: () => showHelp(bindings, text) },
];
const press = keyboard(bindings);
addEventListener("keydown", press);
acceptDrops(window);

/** What ← and → move through. */
function place() {
  return replaying() ? steps() : timeline;
}

/** Whose edits Ctrl+Z takes back. */
function editor() {
  return [draw, labels].find(({ active }) => active) ?? store;
}

function openLabels() {
  setMode("inspect");
  panel.open("labels");
}

/** @param {1 | -1} by */
function doubtful(by) {
  if (store.view.mode === "inspect") frames.next(by);
  else timeline.doubtful(by);
}

function showScored() {
  if (store.view.mode === "inspect") frames.setScored(timeline.strip);
}

function filterFrames() {
  frames.sort();
  filter.tell();
  if (store.view.mode === "inspect") words.need();
}

function showWords() {
  if (filter.searching) filterFrames();
  else frames.paint();
}

/** What B is, as A would be pinned. */
function present() {
  return { method: store.view.method, params: store.view.params };
}

function togglePin() {
  store.change({ against: store.view.against ? null : present() });
}

function nextDifference() {
  if (!store.view.against) return;
  const next = timeline.different();
  if (next === null) toast(inspectText.ab.nowhere);
  else goToFrame(next);
}

function leave() {
  if (document.querySelector(":popover-open:not([popover=manual])")) closePopovers();
  else if (labels.leave()) return;
  else if (store.view.selected !== null) store.change({ selected: null });
  else if (replaying()) steps().leave();
}

/** @param {Window} target */
function acceptDrops(target) {
  catchDrops(target, { onHover: notices.setDropping, onFiles: open });
}

/** @param {File[]} files */
async function open(files) {
  const picked = pick(files);
  if (!picked) return notices.setError(text.stage.nothingDropped, drawn !== null);
  if (picked.kind === "recording" && (await isSweepTable(picked.file))) return openSweep(picked.file);
  if (picked.kind === "recording") return send(picked.file);
  const why = await importParams(await picked.file.text());
  if (why) notices.setError(`${picked.file.name}: ${why}`, drawn !== null);
  return undefined;
}

/** @param {File} file */
function openSweep(file) {
  if (store.view.mode !== "tune") setMode("tune");
  panel.open("map");
  tuner.openSweep(file);
}

/** @param {File} file */
function send(file) {
  cancelUpload?.();
  notices.dismiss();
  if (file.size > uploadLimit) {
    notices.setError(text.stage.tooLarge(file.name, megabytes(file.size), megabytes(uploadLimit)), drawn !== null);
    return;
  }
  const show = (/** @type {number} */ done, /** @type {number} */ total) =>
    notices.setLoading(text.stage.uploading(file.name), done, total, text.stage.scans(done, total));
  const over = () => {
    cancelUpload = null;
    notices.setLoaded();
  };
  show(0, 0);
  cancelUpload = upload(
    file,
    {
      onProgress: show,
      onDone: (recording) => (over(), store.change({ ...linked.rest(file.name), recording })),
      onTrouble: (why) => (over(), notices.setError(why, drawn !== null)),
    },
    text.stage.uploadFailed(file.name),
  );
}

function cancel() {
  if (cancelUpload) {
    cancelUpload();
    cancelUpload = null;
  } else {
    link.cancel();
    if (drawn) store.adopt(viewOf(drawn));
  }
  notices.setLoaded();
}

function rerunCommands() {
  const { title, all, steps } = rerunText.export;
  return {
    title,
    items: [
      { label: all, run: () => exportRun(false) },
      { label: steps, run: () => exportRun(true) },
    ],
  };
}

/** @param {boolean} steps every decision of this frame, instead of all frames */
function exportRun(steps) {
  const label = drawn?.label ?? "";
  longWork(rerunText.recording(label), async (show, signal) => {
    const { recording } = await record(session.id ?? "", steps, show, signal);
    h("a", { href: addressOf(recording, label), download: "" }).click();
  });
}

/**
 * Work that is told of over the scene, and cancelled there or by other work.
 * @param {string} words what it is
 * @param {(show: (done: number, total: number) => void, signal: AbortSignal) => Promise<void>} run rejects with a sentence
 */
async function longWork(words, run) {
  cancelUpload?.();
  notices.dismiss();
  const work = new AbortController();
  cancelUpload = () => work.abort();
  const show = (/** @type {number} */ done, /** @type {number} */ total) =>
    notices.setLoading(words, done, total, text.stage.scans(done, total));
  show(0, 0);
  try {
    await run(show, work.signal);
  } catch (error) {
    if (!work.signal.aborted) notices.setError(String(error instanceof Error ? error.message : error), drawn !== null);
  }
  if (work.signal.aborted) return;
  cancelUpload = null;
  notices.setLoaded();
}

/** @param {number} bytes */
function megabytes(bytes) {
  return `${Math.ceil(bytes / 1e6).toLocaleString("en")} MB`;
}

/** Takes the text of a parameter file, or says why not. @param {string} file @returns {Promise<string | null>} */
async function importParams(file) {
  const query = new URLSearchParams({ method: store.view.method });
  const { words, trouble } = await fetchText(`/api/params?${query}`, { method: "POST", body: file });
  if (trouble) return trouble;
  const { params } = JSON.parse(words);
  const changed = Object.entries(params).filter(([name, value]) => store.view.params[name] !== value);
  if (changed.length) store.change({ params: Object.fromEntries(changed) });
  toast(changed.length ? text.exchange.imported(changed.length) : text.exchange.importedNothing);
  return null;
}

// --- the view and its link -------------------------------------------------------------------------------------------

/** @param {number} frame */
function goToFrame(frame) {
  // The decisions of another frame are others.
  store.change({ frame, selected: null, step: replaying() ? 0 : null, live: false });
}

/** @param {boolean} on whether the newest frame of a live recording is followed */
function follow(on) {
  store.change(on ? { live: true, step: null, selected: null } : { live: false });
}

function robotCommands() {
  const text = liveText;
  const now = live.status?.recording === drawn?.recording ? live.status : null;
  const publish =
    now?.publisher === "this"
      ? { label: text.publish.stop, run: () => stopPublishing(session.id ?? "") }
      : { label: text.publish.item, run: () => showPublish(text, session.id ?? "") };
  const send = { label: text.send.item, run: () => showSend(text, store.view.params) };
  return [{ title: text.group, items: now?.publishable ? [send, publish] : [send] }];
}

/** @param {import("./bars/modes.js").Mode} mode */
function setMode(mode) {
  // Learning begins at the first decision; tuning looks at the whole result.
  if (mode === store.view.mode) return;
  // Inspecting begins with the most suspicious frames.
  const score = mode === "inspect" && store.view.score === "coverage" ? { score: "suspicion" } : {};
  store.change({ mode, step: mode === "learn" ? 0 : null, ...score });
}

/** @param {string} mode */
function showMode(mode) {
  const on = mode === "learn";
  modes.set(mode);
  panel.setMode(mode);
  const entered = part("main").dataset.mode !== mode;
  part("main").dataset.mode = mode;
  if (entered) showScored();
  part("learn").hidden = part("stepper").hidden = !on;
  part("panel").hidden = part("replay").hidden = on;
}

function fit() {
  if (!drawn) return;
  const box = drawn.bounds ?? drawn.extent;
  if (box) stage.fit(box);
}

function toggleCamera() {
  store.change({ camera: store.view.camera === "plan" ? "free" : "plan" });
}

function followLink() {
  return `${location.origin}${location.pathname}#follow=${presenterId}`;
}

async function copyFollowLink() {
  await copy(followLink());
  toast(text.follow.copied);
}

async function copyLink() {
  linked.release();
  writeHash();
  await copy(location.href);
  toast(store.view.recording?.startsWith("upload:") ? text.top.linkCopiedUpload : text.top.linkCopied);
}

let hashTimer = 0;
function writeHash() {
  clearTimeout(hashTimer);
  hashTimer = 0;
  if (linked.held) return;
  const hash = following.active ? `follow=${following.presenter}` : store.hash;
  if (`#${hash}` !== location.hash) history.replaceState(null, "", `#${hash}`);
}
addEventListener("hashchange", () => (presenterIn(location.hash) ? location.reload() : readLink(location.hash)));

/** @param {string} hash */
function readLink(hash) {
  if (!store.read(hash)) return;
  linked.open(store.view, store.name);
  lookedFor = store.look;
}

stage.onMove(() => {
  explanation.place(stage.project);
  if (lookedFor) return;
  store.look = stage.look;
  writeHashSoon();
});

function writeHashSoon() {
  if (!hashTimer) hashTimer = setTimeout(writeHash, HASH_DELAY_MS);
}

store.onChange((view, patch) => {
  if (patch) {
    linked.release();
    link.send(patch);
  }
  showMethod(view.method);
  panel.setParams(view.params, store.canUndo, store.canRedo);
  tuner.setParams(view.params);
  draw.setRecording(view.recording);
  timeline.setFrame(view.frame);
  frames.setFrame(view.frame);
  timeline.showStrip(view.score, view.dark);
  showMode(view.mode);
  replay.setStep(view.mode === "learn" ? null : view.step);
  learn.setView(view);
  layers.set(view.layers);
  stage.setMode(view.camera);
  cameraButton.setAttribute("aria-pressed", String(view.camera === "free"));
  cameraButton.setAttribute("aria-label", view.camera === "free" ? text.stage.plan : text.stage.free);
  writeHashSoon();
});

/** What a drawn state says of the View. @param {State} state */
function viewOf(state) {
  const {
    mode,
    recording,
    topics,
    frame,
    method,
    params,
    step,
    layers: shown,
    selected,
    camera,
    score,
    against,
    reference,
  } = state;
  const topic = topics.length > 1 ? state.topic : null;
  const following = state.live ?? true;
  return {
    mode,
    recording,
    topic,
    frame,
    method,
    params,
    step,
    layers: shown,
    selected,
    camera,
    score,
    against,
    reference,
    live: following,
  };
}

// --- theme -----------------------------------------------------------------------------------------------------------

const systemDark = matchMedia("(prefers-color-scheme: dark)");
systemDark.addEventListener("change", () => setTheme(savedTheme()));

function savedTheme() {
  const saved = localStorage.getItem(THEME_KEY);
  return saved === "light" || saved === "dark" ? saved : "auto";
}

/** @param {"auto" | "light" | "dark"} theme */
function setTheme(theme) {
  if (theme === "auto") localStorage.removeItem(THEME_KEY);
  else localStorage.setItem(THEME_KEY, theme);
  const dark = showTheme(theme);
  if (dark !== store.view.dark) store.change({ dark });
}

/** @param {"auto" | "light" | "dark"} theme @returns {boolean} dark */
function showTheme(theme) {
  document.documentElement.dataset.theme = theme;
  return theme === "dark" || (theme === "auto" && systemDark.matches);
}

// --- the server ------------------------------------------------------------------------------------------------------

/** @param {Message} message @param {number | null} latencyMs */
function receive(message, latencyMs) {
  switch (message.type) {
    case "welcome":
      return greet(message);
    case "recordings":
      return topbar.setRecordings(message.recordings);
    case "loading": {
      const { label, done, total, note } = message;
      return notices.setLoading(note || text.stage.loading(label), done, total, text.stage.scans(done, total));
    }
    case "live":
      return live.setStatus(message);
    case "error":
      return complain(message);
    case "trace":
      return learn.setTrace(message.trace);
    case "survey":
      timeline.setSurvey(message);
      return ab.setSurvey(message, drawn);
    case "drawn":
      return showDrawn(
        { ...message.state, rev: message.rev, latencyMs: latencyMs ?? drawn?.latencyMs ?? null },
        message.origin,
      );
  }
}

/** @param {import("./wire.js").Welcome} welcome */
function greet(welcome) {
  session.id = welcome.session;
  methods = welcome.methods;
  uploadLimit = welcome.uploadLimit;
  topbar.setRecordings(welcome.recordings);
  presenterId = welcome.presenter;
  firstDrawing = welcome.recordings.find(({ group }) => group === "Drawn")?.id ?? "";
  topbar.setMethods(methods);
  timeline.setScores(welcome.scores);
  frames.setScores(welcome.scores);
  weights.setScores(welcome.scores);
  showMethod(store.view.method);
  store.declare(methods);
  stage.open(welcome.viser);
  // A resumed session may hold thresholds that the link leaves at their defaults.
  if (welcome.resumed) link.send(sendable());
  labels.retry();
}

/** @param {string} name */
function methodOf(name) {
  return methods.find((method) => method.name === name) ?? methods[0];
}

let shownMethod = "";
/** Its sliders, its ways through the replay. @param {string} name */
function showMethod(name) {
  if (name === shownMethod || !methods.length) return;
  shownMethod = name;
  const method = methodOf(name);
  topbar.setMethod(method);
  panel.setMethod(method);
  tuner.setMethod(method, panel.row);
  replay.setMethod(method);
  learn.setMethod(method, methods[0].knobs);
}

/** The View as the server takes it. */
function sendable() {
  const { recording, ...rest } = store.view;
  return recording === null ? rest : { recording, ...rest };
}

/** @param {import("./wire.js").Trouble} trouble */
function complain({ where, message }) {
  const gone = where === "recording" && linked.names(store.view.recording);
  if (gone) {
    linked.lose();
    lookedFor = null;
  }
  if (drawn && link.settled) {
    if (where === "params") store.restore(drawn.params);
    else store.adopt(viewOf(drawn));
  }
  if (where === "params") return panel.refuse(message);
  notices.setLoaded();
  notices.setEmpty();
  const way = { note: text.stage.linkKept(linked.name), label: text.top.openFile, run: () => chooseFile(open) };
  const about = gone && linked.name && !message.includes(linked.name) ? `${linked.name}: ${message}` : message;
  return notices.setError(about, drawn !== null, gone ? way : undefined);
}

/** @param {State} state @param {"page" | "scene"} origin */
function showDrawn(state, origin) {
  // What is shown instead of a link that cannot be opened must not hide why.
  const opened = drawn !== null && (state.recording !== drawn.recording || state.topic !== drawn.topic);
  const { pack } = state;
  const unpacked = pack && state.recording !== drawn?.recording && !linked.names(state.recording) && !following.active;
  drawn = Object.freeze({ ...state, marks: state.marks ?? drawn?.marks ?? {} });
  if (link.settled) store.adopt(viewOf(drawn));
  following.setPresence(state.following);
  notices.setDrawn(true);
  if (opened) {
    notices.dismiss();
    linked.opened(state.recording);
    if (!linked.names(state.recording)) lookedFor = null;
  }
  store.name = drawn.label;
  if (!cancelUpload) notices.setLoaded();
  topbar.setState(drawn);
  timeline.setState(drawn);
  live.setState(drawn);
  ab.setState(drawn, methods);
  packCard.setState(drawn);
  replay.setState(drawn);
  learn.setState(drawn, origin);
  panel.setState(drawn);
  tuner.setState(drawn);
  layers.setTruth(drawn.truth);
  status.setState(drawn);
  explanation.set(drawn.explanation, methodOf(drawn.method).knobs);
  whatIf.setState(drawn);
  truth.setState(drawn);
  labels.setState(drawn);
  rerun.setState(drawn);
  words.setState(drawn);
  filter.setState(drawn);
  weights.set(drawn.weights);
  document.title = `${drawn.label} – ${text.appName}`;
  // A drawn world stays where it is while it changes.
  const place = draw.active ? "drawn" : `${drawn.recording} ${drawn.topic}`;
  if (place !== fitted) {
    fitted = place;
    fit();
  }
  if (lookedFor && linked.names(drawn.recording)) {
    stage.lookAt(lookedFor);
    lookedFor = null;
  }
  explanation.place(stage.project);
  if (unpacked) takePack(pack);
}

/** The frame of a failure pack, as it was looked at. @param {import("./wire.js").Pack} pack */
function takePack({ method, params }) {
  const same =
    method === store.view.method && Object.entries(params).every(([name, value]) => store.view.params[name] === value);
  if (same) return;
  store.change({ method, params });
  toast(exportText.card.taken);
}

let lostTimer = 0;
/** @param {import("./view/link.js").Connection} connection @param {string} reason */
function showConnection(connection, reason) {
  status.setConnection(connection);
  if (connection === "open") {
    clearTimeout(lostTimer);
    lostTimer = 0;
    notices.setLost(false, "");
  } else if (connection === "lost" && !lostTimer) {
    lostTimer = setTimeout(() => notices.setLost(true, reason), LOST_DELAY_MS);
  }
}

/** @type {Link} */
const link = new Link(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/session`, {
  rev: session.rev,
  hello: () => ({ type: "hello", session: session.id, rev: link.rev, view: sendable(), follow: following.presenter }),
  onMessage: receive,
  onConnection: showConnection,
});
readLink(session.hash);
store.adopt({ dark: showTheme(savedTheme()) });
keepSessionOnLeave(() => ({ id: session.id, rev: link.rev, hash: store.hash }));

Object.defineProperty(window, "lineseg", {
  value: Object.freeze({
    /** The last drawn state. */
    get state() {
      return drawn;
    },
    /** The strip of the timeline: score, values of every stride-th frame, the thresholds they belong to, complete. */
    get strip() {
      return timeline.strip;
    },
    /** Whoever opens it sees what this tab shows. */
    get followLink() {
      return followLink();
    },
    /** The frame at which the time cursor of rerun's viewer stands; null without it. */
    get rerunFrame() {
      return rerun.cursor;
    },
    /** Curves, map and auto-tuning. */
    get tuner() {
      return tuner.current;
    },
    /** Where a point of the plan is on the stage [px]. @param {number} x @param {number} y */
    project: (x, y) => stage.project(x, y),
    /** Everything that was changed here is drawn. */
    get settled() {
      return link.settled;
    },
  }),
});
