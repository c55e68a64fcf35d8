// @ts-check
// What arrives on the socket of the tab; what it may be is in wire.d.ts.

/** @typedef {import("../wire.js").Message} Message */

/** A message as it arrives: text is JSON; a binary one has the length of its JSON head, the head, and numbers. @param {string | ArrayBuffer} data @returns {Message} */
export function messageOf(data) {
  if (typeof data === "string") return JSON.parse(data);
  const length = new DataView(data).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  return { ...head, values: new Float32Array(data, 4 + length) };
}
