// @ts-check
// True lines over the plan: chosen, dragged by their ends, drawn from point to point.
import { svg } from "../widgets/dom.js";
import { placesOf, runBetween, seenOf } from "./lines.js";

/** @typedef {import("./lines.js").Line} Line */
/** @typedef {import("./lines.js").Point} Point */
/** @typedef {import("./lines.js").Sweep} Sweep */
/** cut: where a chosen line would be split. @typedef {"first" | "cut" | "last"} Grip */
/** proposed: the lines are the present result's. @typedef {{lines: Line[], chosen: number, cut: number, proposed: boolean, sweep: Sweep | null, drawing: boolean}} Shown */

const GRIPS = /** @type {const} */ (["first", "cut", "last"]);
// So far from a point a new line may begin [px].
const REACH = 30;

/**
 * @param {HTMLElement} stage
 * @param {import("../stage/stage.js").Stage} view
 * @param {typeof import("../text/label.js").labelText.handle} text
 * @param {{onChoose: (line: number, beam: number | null) => void, onGrip: (grip: Grip, beam: number, done: boolean) => void, onDrawn: (run: number[]) => void}} handlers
 *   onChoose: a line, and its beam under the pointer; onGrip: a grip of the chosen line at another beam; done: the gesture ends there
 */
export function createOverlay(stage, view, text, { onChoose, onGrip, onDrawn }) {
  const shapes = svg("g");
  const sketch = svg("line", { class: "label-line chosen", hidden: "" });
  const grips = GRIPS.map(emptyGrip);
  const element = svg("svg", { class: "label-overlay", role: "group", hidden: "" });
  element.append(shapes, sketch, ...grips);
  stage.append(element);
  /** @type {Shown | null} */
  let shown = null;
  /** The beam at which drawing began. @type {number | null} */
  let from = null;
  view.onMove(draw);
  element.addEventListener("wheel", (event) => view.pass(event), { passive: true });
  element.addEventListener("pointerdown", begin);
  element.addEventListener("pointermove", sketchTo);
  element.addEventListener("pointerup", finish);
  element.addEventListener("pointercancel", () => stopSketch());

  /** Where a beam's point is on the stage. @param {number} beam */
  function place(beam) {
    const point = shown?.sweep?.points[beam];
    return point ? view.project(...point) : null;
  }

  function draw() {
    element.toggleAttribute("hidden", shown === null);
    if (!shown) return;
    const { lines, chosen, cut, proposed, drawing } = shown;
    element.classList.toggle("drawing", drawing);
    while (shapes.children.length > lines.length) shapes.lastElementChild?.remove();
    while (shapes.children.length < lines.length) shapes.append(emptyShape());
    lines.forEach((line, k) => {
      const group = shapes.children[k];
      const [one, other] = [
        line.start ? view.project(...line.start) : place(line.first),
        line.end ? view.project(...line.end) : place(line.last),
      ];
      group.toggleAttribute("hidden", !one || !other);
      if (!one || !other) return;
      for (const each of group.children) put(each, one, other);
      group.classList.toggle("chosen", k === chosen);
      group.classList.toggle("proposed", proposed);
      group.setAttribute("aria-label", text.line(k + 1));
    });
    const line = lines[chosen];
    GRIPS.forEach((name, k) => {
      const beam = name === "cut" ? cut : line?.[name];
      const at = line && shown?.sweep && !drawing ? place(beam) : null;
      grips[k].toggleAttribute("hidden", !at);
      if (!at) return;
      grips[k].setAttribute("transform", `translate(${at[0]} ${at[1]})`);
      grips[k].setAttribute("aria-label", text[name](beam));
    });
  }

  /** @param {Element} line @param {Point} one @param {Point} other */
  function put(line, [x1, y1], [x2, y2]) {
    for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) line.setAttribute(name, String(value));
  }

  function emptyShape() {
    const group = svg("g", { class: "label-shape" });
    group.append(svg("line", { class: "label-hit" }), svg("line", { class: "label-line" }));
    group.addEventListener("pointerdown", (event) => {
      if (shown?.drawing) return;
      event.preventDefault();
      const k = [...shapes.children].indexOf(group);
      onChoose(k, nearest(event, shown?.sweep ? seenOf(shown.lines[k], shown.sweep) : []));
    });
    return group;
  }

  /** Where a grip of the chosen line may stand. @param {Grip} name */
  function placesFor(name) {
    if (!shown?.sweep) return [];
    const { lines, chosen, sweep } = shown;
    return name === "cut" ? seenOf(lines[chosen], sweep).slice(0, -1) : placesOf(lines, chosen, name, sweep);
  }

  /** @param {Grip} name */
  function emptyGrip(name) {
    const grip = svg("g", { class: `label-grip ${name}`, tabindex: 0, role: "button", hidden: "" });
    grip.append(name === "cut" ? svg("path", { d: "M0-7 7 0 0 7-7 0z" }) : svg("circle", { r: 7 }));
    let dragging = false;
    grip.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      event.stopPropagation();
      grip.setPointerCapture(event.pointerId);
      grip.focus();
      dragging = true;
    });
    const drag = (/** @type {PointerEvent} */ event, /** @type {boolean} */ done) => {
      if (!dragging) return;
      if (done) dragging = false;
      const beam = nearest(event, placesFor(name));
      if (beam !== null) onGrip(name, beam, done);
    };
    grip.addEventListener("pointermove", (event) => drag(event, false));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
      grip.addEventListener(kind, (event) => drag(event, true));
    grip.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!step || !shown) return;
      event.preventDefault();
      event.stopPropagation();
      const places = placesFor(name);
      const now = places.indexOf(name === "cut" ? shown.cut : shown.lines[shown.chosen][name]);
      const beam = places[Math.min(Math.max(now + step * (event.shiftKey ? 10 : 1), 0), places.length - 1)];
      if (beam !== undefined) onGrip(name, beam, true);
    });
    return grip;
  }

  /** That of these beams whose point is nearest to the pointer. @param {PointerEvent} event @param {number[]} beams @param {number} reach */
  function nearest(event, beams, reach = Infinity) {
    const box = element.getBoundingClientRect();
    let [best, least] = [/** @type {number | null} */ (null), reach];
    for (const beam of beams) {
      const at = place(beam);
      const away = at ? Math.hypot(at[0] + box.left - event.clientX, at[1] + box.top - event.clientY) : Infinity;
      if (away < least) [best, least] = [beam, away];
    }
    return best;
  }

  const all = () => [...(shown?.sweep?.points.keys() ?? [])];

  /** @param {PointerEvent} event */
  function begin(event) {
    if (!shown?.drawing) return;
    event.preventDefault();
    from = nearest(event, all(), REACH);
    if (from !== null) element.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  function sketchTo(event) {
    if (from === null) return;
    const [one, other] = [place(from), place(nearest(event, all()) ?? from)];
    sketch.toggleAttribute("hidden", !one || !other);
    if (one && other) put(sketch, one, other);
  }

  /** @param {PointerEvent} event */
  function finish(event) {
    if (from === null || !shown?.sweep) return;
    const [begun, to] = [from, nearest(event, all())];
    const { sweep } = shown;
    stopSketch();
    if (to !== null && to !== begun) onDrawn(runBetween(begun, to, sweep));
  }

  function stopSketch() {
    from = null;
    sketch.toggleAttribute("hidden", true);
  }

  return {
    /** @param {Shown | null} next null: nothing to edit */
    set(next) {
      shown = next;
      draw();
    },
  };
}
