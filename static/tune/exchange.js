// @ts-check
// The Export menu, and parameters as text in both directions.
import { createMenu } from "../widgets/menu.js";
import { showImport, showParams } from "./params_dialogs.js";

/** @typedef {import("../wire.js").Params} Params */

/**
 * @param {typeof import("../text/page.js").pageText} words
 * @param {{session: () => string, params: () => Params, method: () => import("../wire.js").Method, onImport: (file: string) => Promise<string | null>,
 *          first: () => import("../widgets/menu.js").Group[], more: () => import("../widgets/menu.js").Group[]}} handlers
 *   onImport: applies the text of a parameter file or says why it cannot; first, more: entries of the menu before and after
 */
export function createExchange(words, { session, params, method, onImport, first, more }) {
  const text = words.exchange;
  const menu = createMenu({
    label: words.top.export,
    atEnd: true,
    groups: () => [
      ...first(),
      {
        title: text.parameters,
        items: [
          ...Object.keys(text.formats)
            .filter((to) => method().ros || to !== "ros1")
            .map((to) => ({
              label: text.formats[to].label,
              run: () => showParams(text, to, { session: session(), method: method().name }, params()),
            })),
          { label: text.import, run: () => showImport(text, onImport) },
        ],
      },
      ...more(),
    ],
  });

  return { element: menu.element };
}
