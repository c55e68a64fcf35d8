// @ts-check
// Values of frames as a row of colours.
import { clamp } from "../widgets/scale.js";

/** @typedef {{low: number, high: number}} Scale */

// From good to doubtful. Lightness alone distinguishes them, so they work for every kind of colour vision.
export const LIGHT = [0xeceff2, 0xf7d59b, 0xe8903a, 0xb04410, 0x571908];
export const DARK = [0x2c3239, 0x5f3c1d, 0xad5d18, 0xf0a043, 0xfff1c9];
export const SHADES = 64;

/**
 * The frame that each pixel shows: the most doubtful of the frames at this pixel.
 * @param {Float32Array} known every stride-th frame
 * @param {{frames: number, stride: number}} survey
 * @param {number} width
 * @param {1 | -1} sign of what is worse
 */
export function worstOfPixels(known, { frames, stride }, width, sign) {
  const shown = new Int32Array(width);
  if (known.length <= width) {
    const perPixel = (frames - 1) / width / stride;
    for (let x = 0; x < width; x++) shown[x] = stride * Math.min(known.length - 1, Math.round((x + 0.5) * perPixel));
    return shown;
  }
  shown.fill(-1);
  for (let k = 0; k < known.length; k++) {
    const x = pixelOf((k * stride) / (frames - 1), width);
    if (shown[x] < 0 || sign * (known[k] - known[shown[x] / stride]) > 0) shown[x] = k * stride;
  }
  return shown;
}

/** @param {number} place 0 to 1 @param {number} width */
export function pixelOf(place, width) {
  return clamp(Math.floor(place * width), 0, width - 1);
}

/** @param {Scale | undefined} scale @param {Float32Array} known @returns {Scale} */
export function widened(scale, known) {
  let { low, high } = scale ?? { low: Infinity, high: -Infinity };
  for (const value of known) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return { low, high };
}

/** How doubtful a value is, from 0 to 1. @param {number} value @param {Scale} scale @param {1 | -1} sign */
export function share(value, { low, high }, sign) {
  if (high <= low) return 0;
  return (sign > 0 ? value - low : high - value) / (high - low);
}

/** @param {HTMLCanvasElement} canvas one pixel high @param {Uint32Array} shades @param {(x: number) => number} place 0 to 1 */
export function fill(canvas, shades, place) {
  const pen = canvas.getContext("2d");
  if (!pen) return;
  const image = pen.createImageData(canvas.width, 1);
  const pixels = new Uint32Array(image.data.buffer);
  for (let x = 0; x < canvas.width; x++) pixels[x] = shades[Math.round(place(x) * (SHADES - 1))];
  pen.putImageData(image, 0, 0);
}

/** @type {Map<number[], Uint32Array>} */
const made = new Map();

/** Colours as pixels (ABGR), evenly between the given ones. @param {number[]} stops */
export function shadesBetween(stops) {
  const kept = made.get(stops);
  if (kept) return kept;
  const shades = new Uint32Array(SHADES);
  for (let k = 0; k < SHADES; k++) {
    const at = (k / (SHADES - 1)) * (stops.length - 1);
    const from = Math.min(Math.floor(at), stops.length - 2);
    const mixed = [16, 8, 0].map((shift) => {
      const [one, other] = [(stops[from] >> shift) & 255, (stops[from + 1] >> shift) & 255];
      return Math.round(one + (at - from) * (other - one));
    });
    shades[k] = (255 << 24) | (mixed[2] << 16) | (mixed[1] << 8) | mixed[0];
  }
  made.set(stops, shades);
  return shades;
}
