// @ts-check
import { h, setText } from "./dom.js";
import { clamp } from "./scale.js";
import { symbols } from "./symbols.js";

/** A bar of a measured value against its limit. */
export function createVersus() {
  const fill = h("div", { class: "versus-fill" });
  const limit = h("div", { class: "versus-limit" });
  const words = h("span", { class: "versus-words" });
  const element = h(
    "div",
    { class: "versus" },
    words,
    h("div", { class: "versus-bar", "aria-hidden": "true" }, fill, limit),
  );

  return {
    element,
    /**
     * @param {{value: number | null, limit: number | null, symbol: string, unit: string, least: boolean} | null} compared
     *   least: the limit is a minimum (P_min, L_min), not a maximum
     */
    set(compared) {
      const known = compared && compared.value !== null && compared.limit !== null;
      element.classList.toggle("blank", !known);
      if (!known) return void setText(words, "");
      const { symbol, unit, least } = compared;
      const value = Number(compared.value);
      const bound = Number(compared.limit);
      const passed = least ? value >= bound : value <= bound;
      const whole = Math.max(value, bound, 1e-12) * 1.15;
      element.classList.toggle("failed", !passed);
      fill.style.width = `${100 * clamp(value / whole, 0, 1)}%`;
      limit.style.left = `${100 * clamp(bound / whole, 0, 1)}%`;
      const sign = value === bound ? "=" : value < bound ? "<" : ">";
      const told = unit === "rad" ? degrees : (/** @type {number} */ it) => `${number(it)}`;
      const after = unit && unit !== "rad" ? ` ${unit}` : "";
      words.replaceChildren(...symbols(`${told(value)} ${sign} ${symbol ? `${symbol} ` : ""}${told(bound)}${after}`));
    },
  };
}

/** As sentences tell angles. @param {number} value [rad] */
function degrees(value) {
  return `${((180 * value) / Math.PI).toFixed(1)}°`;
}

/** @param {number} value */
function number(value) {
  if (Number.isInteger(value)) return String(value);
  return Math.abs(value) < 0.0005 ? value.toPrecision(1) : value.toFixed(3);
}
