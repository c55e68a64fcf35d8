// @ts-check
// How long things in the scene are: a bar, or a cross where distances across a line are exaggerated.
import { h, setText, svg } from "../widgets/dom.js";
import { niceLength, squareOf } from "./grid.js";

/** @typedef {import("./viser.js").Stretch} Stretch */

const ARM_PX = 70;
const CORNER = 46;

/** @param {(factor: number) => string} across words of a stretch */
export function createScale(across) {
  const barWords = h("span");
  const bar = h("div", { class: "scale-bar" }, barWords);
  const cross = svg("svg", { class: "scale-cross", width: 2 * CORNER, height: 2 * CORNER });
  const words = h("p", { class: "scale-words" });
  const element = h("div", { class: "scale", "aria-hidden": "true", hidden: true }, bar, cross, words);

  /** @param {number} pxPerMetre @param {Stretch} stretch */
  function drawCross(pxPerMetre, { factor, normal: [a, b] }) {
    cross.replaceChildren(...arm([b, a], pxPerMetre), ...arm([a, -b], pxPerMetre * factor));
    setText(words, across(factor));
  }

  return {
    element,
    /** @param {number | null} pxPerMetre null: the scene has no scale @param {Stretch | null} stretch */
    set(pxPerMetre, stretch) {
      element.hidden = pxPerMetre === null;
      if (pxPerMetre === null) return;
      bar.hidden = stretch !== null;
      cross.style.display = stretch ? "" : "none";
      words.hidden = !stretch;
      if (stretch) return drawCross(pxPerMetre, stretch);
      const metres = squareOf(pxPerMetre);
      bar.style.width = `${metres * pxPerMetre}px`;
      setText(barWords, lengthWords(metres));
    },
  };
}

/** A bar in a direction, through the middle of the cross. @param {[number, number]} direction on the screen @param {number} pxPerMetre */
function arm([x, y], pxPerMetre) {
  const metres = niceLength(ARM_PX / pxPerMetre);
  const half = (metres * pxPerMetre) / 2;
  const [dx, dy] = x < 0 || (x === 0 && y > 0) ? [-x, -y] : [x, y];
  const line = svg("line", {
    x1: CORNER - half * dx,
    y1: CORNER - half * dy,
    x2: CORNER + half * dx,
    y2: CORNER + half * dy,
  });
  const words = svg("text", { x: CORNER + (half + 6) * dx, y: CORNER + (half + 6) * dy + 4 });
  words.textContent = lengthWords(metres);
  return [line, words];
}

/** @param {number} metres */
function lengthWords(metres) {
  if (metres >= 1) return `${metres} m`;
  return metres >= 0.01 ? `${Math.round(metres * 100)} cm` : `${Number((metres * 1000).toPrecision(1))} mm`;
}
