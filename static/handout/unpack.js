// @ts-check
// Reads what app/handout/packing.py has packed.

/** @typedef {import("../wire.js").Handout} Handout */
/** @typedef {Record<string, Int32Array | Uint32Array | Uint8Array>} Arrays */

const KINDS = { int32: Int32Array, uint32: Uint32Array, uint8: Uint8Array };

/** @param {string} text base64 @returns {Promise<{content: Handout, arrays: Arrays}>} */
export async function unpack(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const length = new DataView(buffer).getUint32(0, true);
  /** @type {{content: Handout, arrays: Record<string, [keyof typeof KINDS, number, number]>}} */
  const { content, arrays } = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const begin = 4 + length;
  return {
    content,
    arrays: Object.fromEntries(
      Object.entries(arrays).map(([name, [kind, at, count]]) => [name, new KINDS[kind](buffer, begin + at, count)]),
    ),
  };
}
