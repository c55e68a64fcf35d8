// @ts-check
// How the window is divided: the sizes that a person gave to the panel and the timeline, and which of them are hidden.
import { keep, recalled } from "../kept.js";
import { createDivider } from "./divider.js";

const KEY = "lineseg.layout";
const LEAST_PX = 240;
// Dragged to less than this, a part is hidden.
const HIDDEN_PX = 120;
// Plots lower than this are not shown; dragged as far down, the timeline is hidden.
const SNAP_PX = 24;
const PLOTS_PX = 200;
const LEAST_KEPT_PX = 24;
const MOST_KEPT_PX = 4000;
const SIZES = /** @type {const} */ (["panel", "learn", "below", "plots"]);
// What remains of the stage.
const STAGE_PX = 180;
// In one column the panel lies below the stage. The same condition is in layout.css.
const ONE_COLUMN = matchMedia("(width <= 720px), (orientation: portrait) and (width <= 1000px)");

/** panel, learn: widths of the panel; below: its height in one column; plots: height of the plots above the timeline [px]. What is absent has its usual size. @typedef {{panel?: number, learn?: number, below?: number, plots?: number, hidden?: string[]}} Sizes */

/**
 * @param {{main: HTMLElement, panels: HTMLElement[], plots: HTMLElement, timeline: HTMLElement}} places
 * @param {typeof import("../text/page.js").pageText.layout} text
 */
export function createLayout({ main, panels, plots, timeline }, text) {
  let sizes = sizesIn(recalled(KEY));
  const shown = () => panels.find((panel) => !panel.hidden) ?? panels[0];
  const sized = () => (ONE_COLUMN.matches ? "below" : main.dataset.mode === "learn" ? "learn" : "panel");
  const panelDivider = createDivider(text.panel, {
    upright: () => !ONE_COLUMN.matches,
    size: () => (ONE_COLUMN.matches ? shown().clientHeight : shown().clientWidth),
    onSize: resize,
    onUsual: () => set({ ...sizes, [sized()]: undefined }),
    onToggle: () => toggle("panel"),
  });
  main.append(panelDivider.element);
  const timelineDivider = createDivider(text.timeline, {
    upright: () => false,
    size: () => (isHidden("timeline") ? -HIDDEN_PX / 2 : (sizes.plots ?? 0)),
    onSize: pullUp,
    onUsual: () => set({ ...sizes, plots: sizes.plots ? undefined : PLOTS_PX }),
    onToggle: () => toggle("timeline"),
  });
  plots.append(timelineDivider.element);
  ONE_COLUMN.addEventListener("change", show);
  const observer = new ResizeObserver(() => panelDivider.show(isHidden("panel")));
  for (const panel of panels) observer.observe(panel);

  /** @param {number} size */
  function resize(size) {
    const most = (ONE_COLUMN.matches ? main.clientHeight : main.clientWidth) - STAGE_PX;
    const least = Math.min(LEAST_PX, most);
    const hides = size < HIDDEN_PX;
    if (hides !== isHidden("panel")) toggle("panel");
    if (!hides) set({ ...sizes, [sized()]: Math.round(Math.min(Math.max(size, least), most)) });
  }

  /** @param {number} size of the plots */
  function pullUp(size) {
    const hides = size < -SNAP_PX;
    if (hides !== isHidden("timeline")) toggle("timeline");
    const most = Math.max(0, innerHeight - 2 * STAGE_PX);
    if (!hides) set({ ...sizes, plots: size < SNAP_PX ? undefined : Math.round(Math.min(size, most)) });
  }

  /** @param {string} part */
  const isHidden = (part) => sizes.hidden?.includes(part) ?? false;

  /** Hides or shows a part. @param {"panel" | "timeline"} part */
  function toggle(part) {
    const others = (sizes.hidden ?? []).filter((name) => name !== part);
    set({ ...sizes, hidden: isHidden(part) ? others : [...others, part] });
  }

  /** @param {Sizes} next */
  function set(next) {
    sizes = next;
    keep(KEY, JSON.stringify(sizes));
    show();
  }

  function show() {
    const { style } = document.body;
    for (const name of SIZES) {
      const size = sizes[name];
      style.setProperty(`--${name}-size`, size ? `${size}px` : "");
    }
    main.classList.toggle("without-panel", isHidden("panel"));
    timeline.hidden = isHidden("timeline");
    plots.classList.toggle("none", !sizes.plots || isHidden("timeline"));
    timelineDivider.show(isHidden("timeline"));
    panelDivider.show(isHidden("panel"));
  }

  show();
  return {
    toggle,
    get: () => sizes,
    set,
  };
}

/** What can be used of sizes from a file, or of those that this browser keeps. @param {any} said @returns {Sizes} */
export function sizesIn(said) {
  const sizes = SIZES.filter((name) => said?.[name] >= LEAST_KEPT_PX && said[name] <= MOST_KEPT_PX);
  const hidden = ["panel", "timeline"].filter((part) => Array.isArray(said?.hidden) && said.hidden.includes(part));
  return { ...Object.fromEntries(sizes.map((name) => [name, Number(said[name])])), hidden };
}
