// @ts-check
import { h } from "../widgets/dom.js";

const PIXELS_EACH = 2;

/**
 * An SVG document drawn in pixels, as PNG.
 * @param {Blob} svg
 * @param {string} trouble what to say if the browser cannot
 * @returns {Promise<Blob>}
 */
export async function pngOf(svg, trouble) {
  const url = URL.createObjectURL(svg);
  try {
    const image = h("img", { src: url });
    await image.decode();
    const [width, height] = [image.naturalWidth * PIXELS_EACH, image.naturalHeight * PIXELS_EACH];
    const canvas = h("canvas", { width, height });
    canvas.getContext("2d")?.drawImage(image, 0, 0, width, height);
    return await new Promise((resolve, reject) =>
      canvas.toBlob((png) => (png ? resolve(png) : reject(new Error(trouble))), "image/png"),
    );
  } finally {
    URL.revokeObjectURL(url);
  }
}
