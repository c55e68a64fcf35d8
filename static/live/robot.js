// @ts-check
// Dialogs that send to a robot: parameters of a node, and segments of live scans.
import { openDialog } from "../widgets/dialog.js";
import { h } from "../widgets/dom.js";
import { messageOf } from "../fetch.js";
import { keep, recalled } from "../kept.js";

const KEY = "lineseg.robot";
const BRIDGE = "";

/** @typedef {typeof import("../text/live.js").liveText} Words */
/** @typedef {import("../wire.js").Sent} Sent */

/**
 * Sends the thresholds to a node and shows its values afterwards.
 * @param {Words} words
 * @param {string} method
 * @param {import("../wire.js").Params} params
 */
export async function showSend(words, method, params) {
  const text = words.send;
  const { addresses, nodes } = await reachable();
  const to = h(
    "select",
    { class: "select" },
    ...nodes.map(({ address, source }) => h("option", { value: address }, text.node(source, address))),
    h("option", { value: BRIDGE }, text.bridge),
  );
  const hint = h("p", { class: "hint" });
  const bridge = createBridge(text, addresses);
  const answer = createAnswer();
  const send = h("button", { type: "submit", class: "button primary" }, text.button);
  const form = h(
    "form",
    { class: "robot-form" },
    h("label", { class: "robot-field" }, h("span", {}, text.to), to),
    bridge.element,
    hint,
    answer.element,
    h("div", { class: "dialog-buttons" }, send),
  );
  const choose = () => {
    bridge.element.disabled = bridge.element.hidden = to.value !== BRIDGE;
    hint.textContent = to.value === BRIDGE ? text.bridgeHint : text.nodeHint;
    answer.clear();
  };
  to.addEventListener("change", choose);
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    send.disabled = true;
    send.textContent = text.busy;
    answer.clear();
    const { content, trouble } =
      to.value === BRIDGE ? await toBridge(text, bridge.asked(), params) : await toNode(text, to.value, method, params);
    send.disabled = false;
    send.textContent = text.button;
    if (trouble === null) answer.show(...content);
    else answer.refuse(trouble);
  });
  choose();
  openDialog(text.title, words.close, h("p", { class: "hint" }, text.hint), form);
  to.focus();
}

/**
 * The fields for a node that is reached over rosbridge.
 * @param {Words["send"]} text
 * @param {string[]} addresses the bridges that were named at the start, since no others are reached
 */
function createBridge(text, addresses) {
  /** @type {{address?: string, node?: string, ros?: number, extensions?: boolean}} */
  const last = recalled(KEY) ?? {};
  const named = addresses.length && !addresses.includes(last.address ?? "") ? addresses[0] : last.address;
  const address = field(text.address, named ?? "ws://localhost:9090", "url");
  const list = h("datalist", { id: "named-robots" }, ...addresses.map((value) => h("option", { value })));
  address.input.setAttribute("list", list.id);
  const node = field(text.nodeName, last.node ?? "/line_extraction", "text");
  const ros = h(
    "select",
    { class: "select" },
    h("option", { value: "2", selected: last.ros !== 1 }, text.ros2),
    h("option", { value: "1", selected: last.ros === 1 }, text.ros1),
  );
  const extensions = h("input", { type: "checkbox", checked: Boolean(last.extensions) });
  const element = h(
    "fieldset",
    { class: "robot-bridge" },
    address.row,
    list,
    node.row,
    h("label", { class: "robot-field" }, h("span", {}, text.ros), ros),
    h("label", { class: "robot-check" }, extensions, text.extensions),
  );
  const asked = () => ({
    address: address.input.value.trim(),
    node: node.input.value.trim(),
    ros: Number(ros.value),
    extensions: extensions.checked,
  });
  return { element, asked };
}

/** @typedef {Promise<{content: HTMLElement[], trouble: string | null}>} Outcome */

/** @param {Words["send"]} text @param {object} asked @param {import("../wire.js").Params} params @returns {Outcome} */
async function toBridge(text, asked, params) {
  keep(KEY, JSON.stringify(asked));
  const { values, trouble } = await post("/api/robot/params", { ...asked, params });
  return { content: trouble === null ? table(text, values.sent) : [], trouble };
}

/**
 * @param {Words["send"]} text @param {string} address @param {string} method @param {import("../wire.js").Params} params
 * @returns {Outcome}
 */
async function toNode(text, address, method, params) {
  const { values, trouble } = await post("/api/robot/node", { address, method, params });
  if (trouble !== null) return { content: [], trouble };
  const { name, now } = text.columns;
  const rows = Object.entries(values.params).map(([threshold, value]) =>
    h("tr", { class: "taken" }, h("td", {}, threshold), h("td", {}, String(value))),
  );
  const head = h("tr", {}, h("th", {}, name), h("th", {}, now));
  const content = [
    h("p", { class: "robot-done" }, text.runs(values.method, rows.length)),
    h("table", { class: "robot-table" }, h("thead", {}, head), h("tbody", {}, ...rows)),
  ];
  return { content, trouble };
}

/**
 * Starts publishing the segments of this tab.
 * @param {Words} words
 * @param {string} session
 */
export function showPublish(words, session) {
  const text = words.publish;
  const topic = field(text.topic, "/lineseg/segments", "text");
  const answer = createAnswer();
  const begin = h("button", { type: "submit", class: "button primary" }, text.button);
  const form = h(
    "form",
    { class: "robot-form" },
    topic.row,
    answer.element,
    h("div", { class: "dialog-buttons" }, begin),
  );
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    const { trouble } = await post("/api/robot/segments", { session, on: true, topic: topic.input.value.trim() });
    if (trouble === null) dialog.close();
    else answer.refuse(trouble);
  });
  const dialog = openDialog(text.title, words.close, h("p", { class: "hint" }, text.hint), form);
  topic.input.select();
}

/** @param {string} session */
export function stopPublishing(session) {
  return post("/api/robot/segments", { session, on: false });
}

/** @param {Words["send"]} text @param {Sent[]} sent @returns {HTMLElement[]} */
function table(text, sent) {
  const taken = sent.filter((row) => row.taken).length;
  const { name, value, now } = text.columns;
  const head = h("tr", {}, h("th", {}, name), h("th", {}, value), h("th", {}, now));
  const rows = sent.flatMap((row) => [
    h(
      "tr",
      { class: row.taken ? "taken" : "refused" },
      h("td", {}, row.name),
      h("td", {}, String(row.value)),
      h("td", {}, row.now === null ? text.unset : String(row.now)),
    ),
    ...(row.reason ? [h("tr", { class: "reason" }, h("td", { colSpan: 3 }, row.reason))] : []),
  ]);
  const summary = taken === sent.length ? text.done(taken) : text.some(taken, sent.length);
  return [
    h("p", { class: taken === sent.length ? "robot-done" : "robot-some" }, summary),
    h("table", { class: "robot-table" }, h("thead", {}, head), h("tbody", {}, ...rows)),
  ];
}

/** @returns {Promise<import("../wire.js").Robots>} */
async function reachable() {
  const response = await fetch("/api/robot").catch(() => null);
  return response?.ok ? response.json() : { addresses: [], nodes: [] };
}

/** Shows the outcome in the dialog. */
function createAnswer() {
  const element = h("div", { class: "robot-answer", "aria-live": "polite" });
  return {
    element,
    clear: () => element.replaceChildren(),
    show: (/** @type {HTMLElement[]} */ ...content) => element.replaceChildren(...content),
    refuse: (/** @type {string} */ why) =>
      element.replaceChildren(h("p", { class: "panel-error", role: "alert" }, why)),
  };
}

/** @param {string} label @param {string} value @param {string} inputMode */
function field(label, value, inputMode) {
  const input = h("input", {
    type: "text",
    class: "robot-input",
    value,
    required: true,
    spellcheck: false,
    autocomplete: "off",
    inputMode,
  });
  return { input, row: h("label", { class: "robot-field" }, h("span", {}, label), input) };
}

/** @param {string} url @param {object} asked @returns {Promise<{values: any, trouble: string | null}>} */
async function post(url, asked) {
  try {
    const body = JSON.stringify(asked);
    const response = await fetch(url, { method: "POST", headers: { "Content-Type": "application/json" }, body });
    const words = await response.text();
    return response.ok ? { values: JSON.parse(words), trouble: null } : { values: null, trouble: messageOf(words) };
  } catch (error) {
    return { values: null, trouble: String(error) };
  }
}
