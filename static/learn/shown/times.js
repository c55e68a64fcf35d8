// @ts-check
// How long two methods take for the frames of the recording, measured on this machine.
import { freshCanvas } from "../../widgets/canvas.js";
import { colour, onTheme } from "../../widgets/colours.js";
import { h } from "../../widgets/dom.js";
import { fetchText } from "../../fetch.js";

/** @typedef {import("../../wire.js").MethodTimes} MethodTimes */

const COLOURS = ["--accent", "--failed"];
const PAD = { left: 44, right: 6, top: 8, bottom: 18 };
const TICKS = [1, 10, 100, 1000, 10_000, 100_000];

/** @param {typeof import("../../text/shown.js").shownText.times} text @param {() => string} session @param {boolean} stored whether they were measured when the page was made */
export function createTimes(text, session, stored) {
  const canvas = h("canvas", { class: "times-canvas", role: "img", "aria-label": text.nothing });
  const table = h("table", { class: "table times-table", hidden: true });
  const says = h("p", { role: "status" });
  const measure = h("button", { type: "button", class: "button" }, stored ? text.stored : text.measure);
  /** @type {MethodTimes[]} */
  let times = [];
  measure.addEventListener("click", async () => {
    measure.disabled = true;
    says.textContent = text.measuring;
    const { words, trouble } = await fetchText(`/api/lessons/times?${new URLSearchParams({ session: session() })}`);
    measure.disabled = false;
    if (trouble !== null) return says.replaceChildren(trouble);
    const { machine, methods } = /** @type {import("../../wire.js").TimesHere} */ (JSON.parse(words));
    times = methods;
    const [one, other] = times;
    says.textContent = text.says(one.method, other.method, other.mean / one.mean, machine);
    canvas.setAttribute("aria-label", says.textContent);
    table.hidden = false;
    table.replaceChildren(headOf(text), ...times.map((each, k) => rowOf(each, COLOURS[k])));
    return draw();
  });

  function draw() {
    const { pen, width, height } = freshCanvas(canvas);
    if (!times.length) return;
    const all = times.flatMap(({ us }) => us);
    const [low, high] = [Math.log10(Math.min(...all) / 1.3), Math.log10(Math.max(...all) * 1.3)];
    const y = (/** @type {number} */ us) =>
      height - PAD.bottom - ((Math.log10(us) - low) / (high - low)) * (height - PAD.top - PAD.bottom);
    const last = Math.max(...times.flatMap(({ frames }) => frames), 1);
    const x = (/** @type {number} */ frame) => PAD.left + (frame / last) * (width - PAD.left - PAD.right);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = colour("--muted");
    pen.strokeStyle = colour("--axis");
    for (const us of TICKS.filter((each) => y(each) > PAD.top && y(each) < height - PAD.bottom)) {
      pen.fillText(text.tick(us), 2, y(us) + 4);
      pen.beginPath();
      pen.moveTo(PAD.left, y(us));
      pen.lineTo(width, y(us));
      pen.stroke();
    }
    pen.fillText(text.frames, PAD.left, height - 4);
    times.forEach(({ frames, us }, k) => {
      pen.strokeStyle = colour(COLOURS[k]);
      pen.beginPath();
      frames.forEach((frame, at) => pen.lineTo(x(frame), y(us[at])));
      pen.stroke();
    });
  }

  onTheme(draw);
  return { element: h("div", { class: "shown-times" }, measure, says, canvas, table) };
}

/** @param {typeof import("../../text/shown.js").shownText.times} text */
function headOf({ head }) {
  return h("thead", {}, h("tr", {}, ...head.map((words) => h("th", {}, words))));
}

/** @param {MethodTimes} times @param {string} name of its colour */
function rowOf({ method, mean, std, least, most }, name) {
  const ms = [mean, std, least, most].map((us) => h("td", {}, (us / 1000).toFixed(3)));
  const label = h("th", { scope: "row" }, method);
  label.style.color = `var(${name})`;
  return h("tr", {}, label, ...ms);
}
