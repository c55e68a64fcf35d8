// @ts-check

/**
 * An empty canvas with as many dots as the screen has, and its pen, which draws in CSS pixels.
 * @param {HTMLCanvasElement} canvas
 * @param {{width: number, height: number}} [size] if it is known: asking for it may lay the page out
 */
export function freshCanvas(canvas, { width, height } = { width: canvas.clientWidth, height: canvas.clientHeight }) {
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const dots = devicePixelRatio || 1;
  const [wide, tall] = [Math.round(width * dots), Math.round(height * dots)];
  if (canvas.width !== wide) canvas.width = wide;
  if (canvas.height !== tall) canvas.height = tall;
  pen.setTransform(dots, 0, 0, dots, 0, 0);
  pen.globalAlpha = 1;
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}
