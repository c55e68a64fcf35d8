// @ts-check
// Composition only: the parts, their places, and the order in which they are informed.
import { mountBars } from "./bars/bars.js";
import { mountTopbar } from "./bars/topbar.js";
import { bindingsOf } from "./bindings.js";
import { createDraw } from "./draw/draw.js";
import { createExportMenu } from "./export/menu.js";
import { createPackCard } from "./export/pack.js";
import { createInspect } from "./inspect/inspect.js";
import { giveKeysBack, keyboard, showHelp } from "./keys.js";
import { createLabels } from "./label/labels.js";
import { createOpening } from "./open/open.js";
import { createReread } from "./open/reread.js";
import { createWork } from "./open/work.js";
import { Page } from "./page.js";
import { mountPanels } from "./panels.js";
import { createReceiver } from "./receive.js";
import { offerToScripts } from "./scripts.js";
import { mountScene } from "./stage/scene.js";
import { words } from "./text/words.js";
import { createTheme } from "./theme.js";
import { createAddress } from "./view/address.js";
import { createFollow, presenterIn } from "./view/follow.js";
import { h } from "./widgets/dom.js";

const text = words.page;
const page = new Page();
const { store, session, change, sessionId, goToFrame } = page;

/** @param {string} id */
const place = (id) => /** @type {HTMLElement} */ (document.getElementById(id));
const following = createFollow(text.follow, {
  presenter: presenterIn(session.hash),
  onFollow: (presenter) => (page.link?.follow(presenter), address.write()),
  session: sessionId,
  done: () => learn.done,
});
store.allows = following.allows;
const address = createAddress(page, text, {
  following: () => following.presenter,
  onLook: (look) => camera.want(look),
  onLead: () => inspect.frames.lead(),
});
// On the stage, later elements lie over earlier ones.
const scene = mountScene(page, place("stage"), text, {
  onKey: (event) => press(event),
  onFrame: (frame) => opening.acceptDrops(frame),
  onCancel: () => opening.cancel(),
  onRetry: () => page.link?.retry(),
  drawing: () => draw.active,
  names: address.linked.names,
  onLook: address.writeSoon,
  onLight: (threshold) => tune.panel.light(threshold),
  onThreshold: (name) => tune.panel.show(name),
});
const { stage, notices, camera } = scene;
const labels = createLabels(place("stage"), stage, words.label, { onFrame: goToFrame });
const inspect = createInspect(page, words.inspect, {
  pointing: scene.pointing,
  timeline: () => timeline,
  onTags: (tags) => labels.suggest(tags),
  onMend: (values) => reread.mend(values),
});
const draw = createDraw(place("stage"), stage, words.draw, {
  onRecording: (recording) => change({ recording, step: page.view.step }),
  onSave: () =>
    h("a", { href: `/api/recording?${new URLSearchParams({ session: sessionId() })}`, download: "" }).click(),
});
const packCard = createPackCard(page, words.export.card);
const cards = h("div", { class: "stage-cards" }, packCard.element, inspect.ab.element, draw.card);
notices.add(following.element);
notices.add(cards);
const labelling = { name: "labels", label: words.label.tab, content: labels.element };
const { layout, tune, learn, modes, rerun } = mountPanels(page, place, words, { scene, inspect, labelling });
const { live, timeline, plots, status } = mountBars(page, place, words, { onScores: inspect.showScored });
const work = createWork(notices, text.stage, () => page.drawn !== null);
const opening = createOpening(page, { work, notices, tune, learn }, text, address.linked);
const reread = createReread(page, words.reading, notices);
stage.keepClearOf([following.element, reread.notice, packCard.element, inspect.ab.element]);
const exports = createExportMenu(page, words, {
  status: () => live.status,
  work,
  note: labels.note,
  onImport: opening.importParams,
  onFollowLink: address.copyFollowLink,
});
const theme = createTheme((dark) => dark !== page.view.dark && change({ dark }));
const topbar = mountTopbar(place("topbar"), words, {
  exchange: exports,
  ab: inspect.ab.button,
  modes: modes.element,
  theme: theme.saved(),
  onRecording: reread.choose,
  onReread: reread.openShown,
  onOpen: opening.choose,
  onTopic: (topic) => change({ topic, frame: 0, step: null, selected: null }),
  onMethod: (method) => change({ method, step: page.learning ? 0 : null }),
  onLink: address.copyLink,
  onTheme: theme.set,
  onHelp: () => showHelp(bindings, text),
});

const controls = { ...tune, ...scene, layout, learn, timeline, inspect, labels, draw, opening };
const bindings = bindingsOf(page, controls, words, () => showHelp(bindings, text));
const press = keyboard(bindings);
addEventListener("keydown", press);
giveKeysBack(document);
opening.acceptDrops(window);

// Sizes must be set before the camera, and the labels of a frame before the lists that they filter.
page.parts = [
  address,
  following,
  modes,
  topbar,
  timeline,
  plots,
  live,
  packCard,
  ...tune.parts,
  learn,
  draw,
  status,
  reread,
];
page.parts.push(labels, rerun, ...inspect.parts, ...scene.parts);
page.connect(
  createReceiver(page, { address, notices, work, following, packCard, opening, reread, panel: tune.panel }, text),
  following,
);
// A link says nothing of the theme: what it is read on top of must have it already.
store.adopt({ dark: theme.show() });
address.read(session.hash);
offerToScripts(page, { timeline, address, rerun, tuner: tune.tuner, stage });
