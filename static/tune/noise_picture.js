// @ts-check
// The scatter of the points over their range, with the threshold that must exceed it.
import { svg } from "../widgets/dom.js";
import { limitAt } from "./limit.js";

/** @typedef {import("../wire.js").Noise} Noise */
/** @typedef {import("../wire.js").Params} Params */
/** knob: the threshold that is drawn; fits: what fits, if it is better. @typedef {{noise: Noise, knob: import("../wire.js").Knob, params: Params, fits: Params | null}} Drawn */

const [WIDTH, HEIGHT] = [134, 92];
const BOX = { left: 27, right: 128, top: 9, bottom: 78 };
const SAMPLES = 24;

/** σ of a range [m] at a range [m]. @param {Noise} noise @param {number} range */
export function sigmaAt({ base, growth }, range) {
  return Math.hypot(base, growth * range);
}

/** How far the picture reaches [m]: to the last bin whose σ is known, but not along its few longest ranges. @param {Noise} noise */
export function reachOf({ edges, sigma }) {
  const last = sigma.findLastIndex((each) => each !== null);
  return Math.min(edges[last + 1], 2 * edges[last]);
}

/** @param {typeof import("../text/tuning.js").tuningText.fit} text */
export function createNoisePicture(text) {
  const element = svg("svg", { class: "noise-picture", role: "img", viewBox: `0 0 ${WIDTH} ${HEIGHT}` });
  let shown = "";

  return {
    element,
    /** @param {Drawn} drawn @param {string} label */
    set(drawn, label) {
      const wanted = JSON.stringify([label, drawn]);
      if (wanted === shown) return;
      shown = wanted;
      element.setAttribute("aria-label", label);
      element.replaceChildren(...shapes(drawn, text));
    },
  };
}

/** @param {Drawn} drawn @param {typeof import("../text/tuning.js").tuningText.fit} text */
function shapes({ noise, knob, params, fits }, text) {
  const reach = reachOf(noise);
  const total = (/** @type {number} */ range) => Math.hypot(sigmaAt(noise, range), noise.bend ?? 0);
  const limit = (/** @type {number} */ range) => limitAt(knob.name, params, range);
  const fit = (/** @type {number} */ range) => limitAt(knob.name, { ...params, ...fits }, range);
  const top = roundUp(1.12 * Math.max(total(reach), limit(reach), fit(reach)));
  const x = (/** @type {number} */ range) => BOX.left + (range / reach) * (BOX.right - BOX.left);
  const y = (/** @type {number} */ metres) => BOX.bottom - (metres / top) * (BOX.bottom - BOX.top);
  const line = (/** @type {(range: number) => number} */ of) =>
    Array.from({ length: SAMPLES + 1 }, (_, k) => {
      const range = (k / SAMPLES) * reach;
      return `${k ? "L" : "M"}${x(range).toFixed(1)} ${y(of(range)).toFixed(1)}`;
    }).join("");
  const area = (/** @type {(range: number) => number} */ of) => `${line(of)}V${BOX.bottom}H${BOX.left}Z`;
  const bins = noise.sigma.map((sigma, k) =>
    sigma === null
      ? ""
      : `M${x(noise.edges[k]).toFixed(1)} ${y(sigma).toFixed(1)}H${x(Math.min(noise.edges[k + 1], reach)).toFixed(1)}`,
  );
  const above = y(limit(reach)) > BOX.top + 12 ? -5 : 11;
  return [
    svg("path", { class: "noise-walls", d: area(total) }),
    svg("path", { class: "noise-white", d: area((range) => sigmaAt(noise, range)) }),
    svg("path", { class: "noise-bins", d: bins.join("") }),
    svg("path", { class: "noise-axes", d: `M${BOX.left} ${BOX.top}V${BOX.bottom}H${BOX.right}` }),
    svg("path", { class: "noise-limit", d: line(limit) }),
    ...(fits ? [svg("path", { class: "noise-fit", d: line(fit) })] : []),
    named(knob.symbol, BOX.right, y(limit(reach)) + above),
    words(BOX.left - 4, BOX.top + 4, "end", String(Number((1000 * top).toPrecision(2)))),
    words(BOX.left - 4, BOX.top + 15, "end", "mm"),
    words(BOX.left - 4, BOX.bottom + 3, "end", "0"),
    words(BOX.left, BOX.bottom + 12, "start", "0"),
    words(BOX.right, BOX.bottom + 12, "end", text.m(reach)),
  ];
}

/** @param {number} x @param {number} y @param {string} anchor @param {string} content */
function words(x, y, anchor, content) {
  const element = svg("text", { class: "noise-tick", x, y, "text-anchor": anchor });
  element.textContent = content;
  return element;
}

/** A symbol with its index as a subscript. @param {string} symbol @param {number} x @param {number} y */
function named(symbol, x, y) {
  const [base, index = ""] = symbol.split("_");
  const element = svg("text", { class: "noise-symbol", x, y, "text-anchor": "end" });
  const low = svg("tspan", { class: "noise-index", dy: 2 });
  low.textContent = index;
  element.append(base, low);
  return element;
}

/** The next number that is 1, 2, 3, 5 or 10 times a power of ten. @param {number} value */
function roundUp(value) {
  const unit = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 3, 5].find((step) => step * unit >= value) ?? 10) * unit;
}
