// @ts-check
import { h } from "./dom.js";

/**
 * A field for a number. A refused value shows the reason at the field; the old value returns when the field loses focus.
 * @param {object} options
 * @param {string} options.label
 * @param {(typed: string) => string | null} options.accept takes the text, or says why not
 * @param {string} [options.className]
 * @param {boolean} [options.repeats] whether Enter takes the same number once more
 */
export function createNumberField({ label, accept, className = "", repeats = false }) {
  const input = h("input", {
    type: "text",
    inputMode: "decimal",
    autocomplete: "off",
    spellcheck: false,
    class: `number ${className}`,
    "aria-label": label,
  });
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  let shown = "";

  const commit = (again = false) => {
    if (input.value.trim() === shown && !again) return clear();
    const why = accept(input.value.trim().replace(",", "."));
    if (why) refuse(why);
    else clear();
    return undefined;
  };
  /** @param {string} why */
  const refuse = (why) => {
    error.textContent = why;
    error.hidden = false;
    input.setAttribute("aria-invalid", "true");
  };
  const clear = () => {
    error.hidden = true;
    input.removeAttribute("aria-invalid");
  };

  input.addEventListener("focus", () => input.select());
  input.addEventListener("input", clear);
  input.addEventListener("change", () => commit());
  input.addEventListener("blur", () => {
    input.value = shown;
    setTimeout(() => document.activeElement !== input && clear(), 6000);
  });
  input.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Enter") {
      commit(repeats && shown !== "");
      // After an accepted value the page's keys work again; a refused value stays in the field to be corrected.
      if (error.hidden) input.blur();
      else input.select();
    } else if (event.key === "Escape") {
      input.value = shown;
      clear();
      input.blur();
    }
  });

  return {
    element: input,
    error,
    refuse,
    clear,
    /** @param {string} value */
    set(value) {
      if (value === shown) return;
      shown = value;
      if (document.activeElement !== input || input.getAttribute("aria-invalid") === null) input.value = value;
    },
  };
}
