// @ts-check
// What a part of the page may be told. Each of these is a method of that name, which a part has or has not.

/** @typedef {import("./wire.js").Message} Message */
/** @typedef {import("./wire.js").Method} Method */
/** @typedef {import("./wire.js").State} State */
/** @typedef {import("./wire.js").View} View */

/**
 * Beside a View: what a person changed in it, null for what the server told, and whether that can be undone and redone.
 * @typedef {{patch: import("./view/fields.js").Patch | null, canUndo: boolean, canRedo: boolean}} Change
 */

/**
 * @typedef {object} Part
 * @property {(view: Readonly<View>, change: Change) => void} [setView] it changed
 * @property {(state: State, origin: "page" | "scene") => void} [setState] it was drawn; origin: where the change was made
 * @property {(method: Method, methods: Method[]) => void} [setMethod] another one is chosen
 * @property {(methods: Method[]) => void} [setMethods] those that there are
 * @property {(scores: import("./wire.js").Score[]) => void} [setScores] those that there are
 * @property {(welcome: import("./wire.js").Welcome) => void} [setWelcome] the server is there, perhaps again
 * @property {(recordings: import("./wire.js").RecordingEntry[]) => void} [setRecordings]
 * @property {(survey: import("./wire.js").Survey) => void} [setSurvey]
 * @property {(trace: import("./learn/trace.js").Columns) => void} [setTrace]
 * @property {(loading: import("./wire.js").Loading) => void} [setLoading] a recording is being opened
 * @property {(status: import("./wire.js").LiveStatus) => void} [setLive]
 * @property {(connection: import("./view/link.js").Connection, reason: string) => void} [setConnection]
 */

/**
 * Tells all parts, in their order.
 * @template {keyof Part} Name
 * @param {Part[]} parts
 * @param {Name} name
 * @param {Parameters<NonNullable<Part[Name]>>} what
 */
export function tell(parts, name, ...what) {
  for (const part of parts) /** @type {any} */ (part)[name]?.(...what);
}
