// @ts-check
// Reads what app/handout/packing.py has packed.

/** @typedef {import("../wire.js").Handout} Handout */
/** @typedef {Record<string, Int32Array | Uint32Array | Uint8Array>} Arrays */

const KINDS = { int32: Int32Array, uint32: Uint32Array };

/** @param {string} text base64 @returns {Promise<{content: Handout, arrays: Arrays}>} */
export async function unpack(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const length = new DataView(buffer).getUint32(0, true);
  /** @type {{content: Handout, arrays: Record<string, [keyof typeof KINDS | "uint8", number, number]>}} */
  const { content, arrays } = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const begin = 4 + length;
  return {
    content,
    arrays: Object.fromEntries(
      Object.entries(arrays).map(([name, [kind, at, count]]) => [
        name,
        kind === "uint8"
          ? new Uint8Array(buffer, begin + at, count)
          : new KINDS[kind](numbers(buffer, begin + at, count)),
      ]),
    ),
  };
}

/** Numbers from the bytes of their differences. @param {ArrayBuffer} buffer @param {number} at @param {number} count */
function numbers(buffer, at, count) {
  const [low, second, third, high] = [0, 1, 2, 3].map((k) => new Uint8Array(buffer, at + k * count, count));
  const made = new Int32Array(count);
  let last = 0;
  for (let k = 0; k < count; k++) {
    const step = low[k] | (second[k] << 8) | (third[k] << 16) | (high[k] << 24);
    made[k] = last = (last + ((step >>> 1) ^ -(step & 1))) | 0;
  }
  return made.buffer;
}
