// @ts-check
import { h } from "./dom.js";

/** @param {string} words */
export async function copy(words) {
  try {
    await navigator.clipboard.writeText(words);
  } catch {
    // Without TLS on another host there is no navigator.clipboard.
    const holder = h("textarea", { class: "off-screen", value: words });
    (document.querySelector("dialog[open]") ?? document.body).append(holder);
    holder.select();
    document.execCommand("copy");
    holder.remove();
  }
}

/** @param {string} name @param {BlobPart} content */
export function download(name, content) {
  const url = URL.createObjectURL(new Blob([content]));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
