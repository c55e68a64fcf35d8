// @ts-check
// What a part of the page can be informed of. Each entry is an optional method of the part.

/** @typedef {import("./wire.js").Message} Message */
/** @typedef {import("./wire.js").Method} Method */
/** @typedef {import("./wire.js").State} State */
/** @typedef {import("./wire.js").View} View */

/**
 * What comes with a View: what a person changed in it (null if the server changed it), and whether undo and redo are possible.
 * @typedef {{patch: import("./view/fields.js").Patch | null, canUndo: boolean, canRedo: boolean}} Change
 */

/**
 * @typedef {object} Part
 * @property {(view: Readonly<View>, change: Change) => void} [setView] the View changed
 * @property {(state: State, origin: "page" | "scene") => void} [setState] a state was drawn; origin: where the change was made
 * @property {(method: Method, methods: Method[]) => void} [setMethod] another method was selected
 * @property {(methods: Method[]) => void} [setMethods] the available methods
 * @property {(scores: import("./wire.js").Score[]) => void} [setScores] the available scores
 * @property {(welcome: import("./wire.js").Welcome) => void} [setWelcome] the server is connected, perhaps again
 * @property {(recordings: import("./wire.js").RecordingEntry[]) => void} [setRecordings]
 * @property {(times: import("./wire.js").Times) => void} [setTimes] when the frames of the next drawn state were taken
 * @property {(survey: import("./wire.js").Survey) => void} [setSurvey]
 * @property {(trace: import("./learn/trace.js").Columns) => void} [setTrace]
 * @property {(loading: import("./wire.js").Loading) => void} [setLoading] a recording is being opened
 * @property {(refused: import("./wire.js").Refused, why: string) => void} [setRefused] a recording could not be read as wanted
 * @property {(status: import("./wire.js").LiveStatus) => void} [setLive]
 * @property {(connection: import("./view/link.js").Connection, reason: string) => void} [setConnection]
 */

/**
 * Calls this method of every part that has it, in order.
 * @template {keyof Part} Name
 * @param {Part[]} parts
 * @param {Name} name
 * @param {Parameters<NonNullable<Part[Name]>>} what
 */
export function tell(parts, name, ...what) {
  for (const part of parts) /** @type {any} */ (part)[name]?.(...what);
}
