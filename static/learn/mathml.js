// @ts-check
// MathML from words: "d = | a x_P + b y_P + c |" and a few shapes. The browser sets it; screen readers read it.

const NAMESPACE = "http://www.w3.org/1998/Math/MathML";
const OPERATOR = /^[=<>≤≥≠+−·×|(),→←∑⟂]$/u;

/** @typedef {Element | string} Part */

/** @param {string} tag @param {...Part} children */
function element(tag, ...children) {
  const made = document.createElementNS(NAMESPACE, tag);
  made.append(...children);
  return made;
}

/** One word: a number, an operator, a name, or a name with an index. @param {string} word @returns {Element} */
function token(word) {
  if (OPERATOR.test(word)) {
    const made = element("mo", word);
    // Stretching brackets need a mathematical font.
    made.setAttribute("stretchy", "false");
    return made;
  }
  if (/^[−\d]/.test(word) || word === "∞") return element("mn", word);
  const [base, index] = word.split("_");
  const name = element("mi", base);
  return index ? element("msub", name, element("mi", index)) : name;
}

/** @param {...Part} parts words, separated by spaces, and shapes */
export function row(...parts) {
  return element(
    "mrow",
    ...parts.flatMap((part) => (typeof part === "string" ? part.split(" ").filter(Boolean).map(token) : [part])),
  );
}

/** @param {Part} top @param {Part} bottom */
export function fraction(top, bottom) {
  return element("mfrac", row(top), row(bottom));
}

/** @param {Part} inside */
export function root(inside) {
  return element("msqrt", row(inside));
}

/** @param {Part} base @param {string} power */
export function power(base, power) {
  return element("msup", row(base), token(power));
}

/** @param {string} words */
export function words(words) {
  // Ordinary spaces at the ends would be lost.
  return element(
    "mtext",
    words.replace(/^ +| +$/g, (spaces) => "\u00a0".repeat(spaces.length)),
  );
}

/** A part that stands for something in the scene. @param {string} name @param {Part} part */
export function term(name, part) {
  const made = row(part);
  made.setAttribute("data-term", name);
  made.setAttribute("class", "term");
  return made;
}

/** @param {...Part} parts */
export function math(...parts) {
  const made = element("math", row(...parts));
  made.setAttribute("displaystyle", "true");
  return made;
}

/** A number with a real minus sign. @param {number} value @param {number} [digits] */
export function num(value, digits = 3) {
  if (!Number.isFinite(value)) return "∞";
  // + 0 avoids a negative zero.
  return (Number(value.toFixed(digits)) + 0).toFixed(digits).replace("-", "−");
}

/** In brackets if it is negative, as after an operator. @param {number} value @param {number} [digits] */
export function signed(value, digits = 3) {
  // A number rounded to zero has no sign.
  return num(value, digits).startsWith("−") ? row("(", num(value, digits), ")") : row(num(value, digits));
}
