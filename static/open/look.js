// @ts-check
// The first scans of a file under the Reading that is being tried: asked of the server, and drawn from above.
import { freshCanvas } from "../widgets/canvas.js";
import { colour } from "../widgets/colours.js";
import { h } from "../widgets/dom.js";

/** @typedef {import("../wire.js").Previewed} Previewed */
/** @typedef {import("../wire.js").Point} Point */

const MARGIN = 18;
const DOT = 1.3;

/** Asks for looks; only the answer to the newest wish counts. */
export class Looks {
  #socket;
  #job = 0;
  #waiting = "";

  /** @param {(seen: Previewed) => void} onSeen */
  constructor(onSeen) {
    this.#socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/reading`);
    this.#socket.onopen = () => this.#waiting && this.#socket.send(this.#waiting);
    this.#socket.onmessage = ({ data }) => {
      const seen = JSON.parse(data);
      if (seen.job === this.#job) onSeen(seen);
    };
  }

  /** @param {string} recording @param {import("./reread_fields.js").Values} reading */
  ask(recording, reading) {
    this.#job += 1;
    this.#waiting = JSON.stringify({ job: this.#job, recording, reading });
    if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send(this.#waiting);
  }

  close() {
    this.#socket.close();
  }
}

/** A canvas that shows scans from above with a scale. */
export function createPlan() {
  const canvas = h("canvas", { class: "reread-plan", role: "img" });

  return {
    element: canvas,
    /** @param {Point[][]} scans @param {string} label */
    draw(scans, label) {
      canvas.setAttribute("aria-label", label);
      const { pen, width, height } = freshCanvas(canvas);
      const box = boxOf(scans);
      const scale = Math.min((width - 2 * MARGIN) / (box.wide || 1), (height - 3 * MARGIN) / (box.tall || 1));
      const x = (/** @type {number} */ metres) => width / 2 + scale * (metres - box.x);
      const y = (/** @type {number} */ metres) => (height - MARGIN) / 2 - scale * (metres - box.y);
      for (const [k, points] of [...scans.entries()].reverse()) {
        pen.fillStyle = colour(k ? "--muted" : "--accent");
        pen.globalAlpha = k ? 0.35 : 1;
        for (const [px, py] of points) pen.fillRect(x(px) - DOT, y(py) - DOT, 2 * DOT, 2 * DOT);
      }
      pen.globalAlpha = 1;
      drawLaser(pen, x(0), y(0), colour("--ink"));
      drawScale(pen, scale, height, colour("--ink"));
    },
  };
}

/** The middle and the size of all points and the laser. @param {Point[][]} scans */
function boxOf(scans) {
  let [left, right, low, high] = [0, 0, 0, 0];
  for (const [x, y] of scans.flat()) {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [low, high] = [Math.min(low, y), Math.max(high, y)];
  }
  return { x: (left + right) / 2, y: (low + high) / 2, wide: right - left, tall: high - low };
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {string} colour */
function drawLaser(pen, x, y, colour) {
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.arc(x, y, 4, 0, 2 * Math.PI);
  pen.moveTo(x + 4, y);
  pen.lineTo(x + 10, y);
  pen.stroke();
}

/** A bar of a round length. @param {CanvasRenderingContext2D} pen @param {number} scale pixels of a metre @param {number} height @param {string} colour */
function drawScale(pen, scale, height, colour) {
  const most = 90 / scale;
  const power = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map((n) => n * power).find((length) => length <= most) ?? power;
  const words =
    metres >= 1000 ? `${metres / 1000} km` : metres >= 1 ? `${metres} m` : `${+(1000 * metres).toPrecision(2)} mm`;
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(10, height - 14);
  pen.lineTo(10, height - 9);
  pen.lineTo(10 + metres * scale, height - 9);
  pen.lineTo(10 + metres * scale, height - 14);
  pen.stroke();
  pen.font = "11.5px system-ui, sans-serif";
  pen.fillText(words, 16 + metres * scale, height - 8);
}
