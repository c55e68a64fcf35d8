// @ts-check
// The replay of one frame, decision by decision.
import { Decision } from "../stepping/decision.js";
import { Steps } from "../stepping/steps.js";
import { h, setText } from "../widgets/dom.js";
import { icon } from "../widgets/icon.js";
import { comparison } from "../stepping/comparison.js";

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {import("../wire.js").Method} Method */

const USUAL_SPEED = 5;

/**
 * @param {HTMLElement} dock
 * @param {typeof import("../text/page.js").pageText} words
 * @param {{onStep: (step: number | null) => void, settled: () => boolean, pointing: import("../widgets/words.js").Pointing}} handlers
 */
export function mountReplay(dock, words, handlers) {
  return new Replay(dock, words.replay, handlers);
}

class Replay {
  #text;
  #steps;
  #decision;
  /** @type {import("../stepping/jumps.js").Marks} */ #marks = {};
  /** @type {Knob[]} */ #knobs = [];
  #enter;
  #count = h("span", { class: "muted" });
  #idle;
  #active;

  /**
   * @param {HTMLElement} dock
   * @param {typeof import("../text/page.js").pageText.replay} text
   * @param {{onStep: (step: number | null) => void, settled: () => boolean, pointing: import("../widgets/words.js").Pointing}} handlers
   */
  constructor(dock, text, { onStep, settled, pointing }) {
    this.#text = text;
    const steps = new Steps(
      {
        speed: text.speed,
        usualSpeed: USUAL_SPEED,
        kinds: [
          ["seed", text.next("seed")],
          ["line", text.nextLine],
          ["drop", text.nextDrop],
        ],
      },
      {
        settled,
        onStep: (step) => {
          this.#show();
          onStep(step);
        },
        onPlaying: (playing) => this.#decision.hush(playing),
      },
    );
    this.#steps = steps;
    this.#decision = new Decision(text.leave, () => this.leave());
    this.#decision.linkTo(pointing);
    this.#enter = h(
      "button",
      { type: "button", class: "button replay-enter", onclick: () => steps.go(0) },
      icon("play"),
      text.enter,
    );
    this.#idle = h("div", { class: "replay-idle" }, this.#enter, this.#count);
    const { buttons, speed, jumps, scrubber } = steps;
    const controls = [...buttons, speed, jumps.element, scrubber.track, scrubber.counter];
    this.#active = h(
      "div",
      { class: "replay-active", hidden: true },
      this.#decision.element,
      h("div", { class: "replay-controls" }, ...controls),
    );
    dock.setAttribute("aria-label", text.label);
    dock.append(this.#idle, this.#active);
  }

  toggle() {
    this.#steps.toggle();
  }

  togglePlay() {
    this.#steps.togglePlay();
  }

  leave() {
    this.#steps.go(null);
  }

  /** @param {number} by ±Infinity: to the ends */
  move(by) {
    this.#steps.move(by);
  }

  /** @param {string} name of a kind of decision */
  jump(name) {
    if (this.#steps.at !== null) this.#steps.jump(name);
  }

  /** @param {Method} method */
  setMethod(method) {
    this.#knobs = method.knobs;
    this.#steps.jumps.rename("seed", this.#text.next(method.begins));
  }

  /** @param {Readonly<import("../wire.js").View>} view */
  setView({ mode, step }) {
    this.#steps.setAt(mode === "learn" ? null : step);
    this.#show();
  }

  /** @param {State} state */
  setState({ steps, marks, decision }) {
    this.#marks = marks ?? this.#marks;
    this.#steps.setDecisions(steps, this.#marks);
    this.#enter.disabled = steps === 0;
    setText(this.#count, steps ? this.#text.decisions(steps) : this.#text.none);
    this.#decision.set(
      decision?.phase ?? "",
      decision?.words ?? [],
      decision ? comparison(decision, this.#knobs) : null,
    );
    this.#show();
  }

  #show() {
    this.#idle.hidden = this.#steps.at !== null;
    this.#active.hidden = this.#steps.at === null;
  }
}
