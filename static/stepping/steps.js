// @ts-check
// Steps through the decisions of one frame: which one is shown, and all ways to move to another. Tune and Learn share this.
import { Player } from "../widgets/player.js";
import { steppingText as text } from "../text/stepping.js";
import { iconButton } from "../widgets/icon.js";
import { clamp } from "../widgets/scale.js";
import { createSpeed } from "../widgets/speed.js";
import { Jumps } from "./jumps.js";
import { Scrubber } from "./scrubber.js";

/** @typedef {import("./jumps.js").Marks} Marks */
/**
 * @typedef {object} Course
 * @property {() => boolean} settled the last decision was drawn
 * @property {(at: number | null) => void} onStep another decision is requested; null: the whole result
 * @property {(playing: boolean) => void} onPlaying
 * @property {(from: number, by: number, playing: boolean) => number | null} [moved] where a move leads; null: the move must wait
 * @property {() => number | null} [loopStart] where playing starts again after the end; null: it stops at the last decision
 */

export class Steps {
  /** @type {number | null} */ #at = null;
  #count = 0;
  /** @type {Marks} */ #marks = {};
  #course;
  #player;
  #play = iconButton("play", text.play, () => this.togglePlay());

  /**
   * @param {{speed: string, usualSpeed: number, kinds: [name: string, label: string][], backdrop?: HTMLElement}} parts
   *   speed: words of the menu of speeds; kinds: decisions that have a button to jump to; backdrop: shown behind the scrubber
   * @param {Course} course
   */
  constructor({ speed, usualSpeed, kinds, backdrop }, course) {
    this.#course = course;
    this.#player = new Player(usualSpeed, {
      ready: course.settled,
      atEnd: () => this.#loopStart === null && this.#last <= (this.#at ?? -1),
      rewind: () => this.go(0),
      next: () => this.#move(1, true),
      onState: (playing) => this.#showPlay(playing),
    });
    this.buttons = [
      iconButton("first", text.first, () => this.move(-Infinity)),
      iconButton("back", text.back, () => this.move(-1)),
      this.#play,
      iconButton("forward", text.forward, () => this.move(1)),
      iconButton("last", text.last, () => this.move(Infinity)),
    ];
    this.speed = createSpeed({ speed, perSecond: text.perSecond }, usualSpeed, (perSecond) =>
      this.#player.setSpeed(perSecond),
    );
    this.jumps = new Jumps(kinds, (name) => this.jump(name));
    this.scrubber = new Scrubber({ onGo: (at) => this.#goByHand(at), onMove: (by) => this.move(by) }, backdrop ?? null);
  }

  /** The decision that is shown; null: the whole result. */
  get at() {
    return this.#at;
  }

  get #last() {
    return this.#count - 1;
  }

  get #loopStart() {
    return this.#course.loopStart?.() ?? null;
  }

  /** @param {number | null} next */
  go(next) {
    if (next === null) this.stop();
    const wanted = next === null || !this.#count ? null : clamp(next, 0, this.#last);
    if (wanted === this.#at) return;
    this.#at = wanted;
    this.#show();
    this.#course.onStep(wanted);
  }

  /** Moves by hand, which stops playing. @param {number} at */
  #goByHand(at) {
    this.stop();
    this.go(at);
  }

  /** Moves like a person does, which stops playing. @param {number} by ±Infinity: to the ends */
  move(by) {
    this.stop();
    this.#move(by, false);
  }

  /** @param {number} by @param {boolean} playing */
  #move(by, playing) {
    if (!this.#count) return;
    if (this.#at === null) return this.go(by === Infinity || by === -1 ? this.#last : 0);
    const next = this.#course.moved ? this.#course.moved(this.#at, by, playing) : this.#at + by;
    if (next === null) return this.stop();
    return this.go(next);
  }

  /** Goes to the next decision of a kind. @param {string} name */
  jump(name) {
    this.stop();
    const next = this.#marks[name]?.find((index) => index > (this.#at ?? -1));
    if (next !== undefined) this.go(next);
  }

  togglePlay() {
    if (this.#count < 2) return;
    const start = this.#loopStart;
    if (!this.#player.playing && start !== null) this.go(start);
    this.#player.toggle();
  }

  stop() {
    this.#player.stop();
  }

  /** Enters the replay, or goes back to the whole result. */
  toggle() {
    this.go(this.#at === null ? 0 : null);
  }

  /** The decisions changed. @param {number} count @param {Marks} marks */
  setDecisions(count, marks) {
    this.#count = count;
    this.#marks = marks;
    this.#show();
  }

  /** @param {number | null} at of the View */
  setAt(at) {
    if (at === null) this.stop();
    this.#at = at;
    this.#show();
  }

  #show() {
    this.scrubber.set(this.#at, this.#count);
    this.jumps.set(this.#marks, this.#at ?? -1);
  }

  /** @param {boolean} playing */
  #showPlay(playing) {
    this.#play.show(playing ? "pause" : "play", playing ? text.pause : text.play);
    this.#course.onPlaying(playing);
  }
}
