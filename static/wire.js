// @ts-check
// What crosses the WebSocket; app/wire.py is the other side.

/**
 * A threshold: how it is called, shown and bounded (lineseg/params.py).
 * @typedef {object} Knob
 * @property {string} name
 * @property {"float" | "int" | "bool"} kind a bool is 0 or 1
 * @property {string} symbol
 * @property {string} label
 * @property {string} unit
 * @property {number} low
 * @property {number} high
 * @property {number} step
 * @property {boolean} log
 * @property {number} least
 * @property {number | null} most
 * @property {string} why
 * @property {string} help
 * @property {boolean} extension
 * @property {number} default
 */

/** begins: how a line of it begins; ros: whether a ROS program knows its thresholds. @typedef {{name: string, label: string, citation: string, begins: string, ros: boolean, knobs: Knob[]}} Method */
/** @typedef {{id: string, label: string, group: string, missing?: boolean}} RecordingEntry */
/** @typedef {Record<string, number>} Params */

/** A result that was pinned, A. @typedef {{method: string, params: Params}} Against */

/** Where the frame of a failure pack came from, counted from 0, and how it was looked at. @typedef {{recording: string, frame: number, method: string, params: Params, note: string}} Pack */

/**
 * What is looked at. Every input changes only this.
 * @typedef {object} View
 * @property {string | null} recording
 * @property {string | null} topic
 * @property {number} frame
 * @property {string} method
 * @property {Params} params
 * @property {number | null} step decision shown by the replay; null = no replay
 * @property {Record<string, boolean>} layers
 * @property {number | null} selected beam
 * @property {"plan" | "free"} camera
 * @property {boolean} dark
 * @property {string} mode
 * @property {string} score of the timeline's strip
 * @property {boolean} live the newest frame of a live recording is followed
 * @property {"labels" | "wall"} reference by what segments are judged where both are there
 * @property {Against | null} against
 * @property {Record<string, number>} weights of the scores in the suspicion, where they are not the usual ones
 */

/**
 * @typedef {object} Segment
 * @property {[number, number]} start
 * @property {[number, number]} end
 * @property {number} first
 * @property {number} last
 * @property {[number, number, number]} line
 * @property {number} points
 * @property {number} length
 * @property {number} rms
 */

/** @typedef {{first: number, last: number, points: number, length: number, check: string, text: string}} Dropped */

/**
 * @typedef {object} Decision
 * @property {number} index
 * @property {string} kind
 * @property {string} phase
 * @property {string} text
 * @property {number} beam
 * @property {number} first
 * @property {number} last
 * @property {string} check
 * @property {number | null} value
 * @property {number | null} limit
 */

/**
 * @typedef {object} Explanation
 * @property {number} beam
 * @property {[number, number] | null} at its point [m]
 * @property {string} text
 * @property {number} segment
 * @property {string} check
 * @property {number | null} value
 * @property {number | null} limit
 * @property {number | null} margin
 */

/** Numbers of a frame or recording against its truth (app/frame/judge.py); null where one is not defined. @typedef {Record<string, number | null>} Agreement */

/**
 * What is said of the frame, and where it is kept (app/routes/labels.py).
 * @typedef {object} Labels
 * @property {number} revision
 * @property {import("./label/lines.js").Line[] | null} lines null: nobody has said which are true
 * @property {string[]} tags
 * @property {string} note
 * @property {string} file
 * @property {string} folder
 * @property {boolean} apart whether that is the data folder of the user, not the folder of the recording
 * @property {string} stamp another one whenever the file is
 * @property {string} trouble why the file cannot be read
 */

/** The nearest value of a threshold at which the answer for a beam changes (lineseg/what_if.py). @typedef {{name: string, value: number | null, text: string}} WhatIf */

/** @typedef {{low: number, high: number, log: boolean, passed: number[], failed: number[]}} Histogram */
/** @typedef {[number, number, number, number]} Box xmin, ymin, xmax, ymax [m] */
/** @typedef {Record<string, number[]>} Marks decision indices: seed, line, drop, phase, merge */

/**
 * The state that was drawn.
 * @typedef {object} State
 * @property {number} rev
 * @property {string} mode
 * @property {string} recording
 * @property {string} label
 * @property {string} format
 * @property {Pack | null} pack of a failure pack, what it says
 * @property {string | null} topic
 * @property {{name: string, scans: number}[]} topics
 * @property {number} frame
 * @property {number} frames
 * @property {boolean | null} live whether the newest frame is followed; null of a recording that is not live
 * @property {number} first number of the first frame; of a live recording the oldest are gone
 * @property {number | null} stamp
 * @property {string} frameId
 * @property {number} beams
 * @property {number} valid
 * @property {number} covered
 * @property {string} method
 * @property {Params} params
 * @property {number | null} step
 * @property {number} steps
 * @property {Record<string, boolean>} layers
 * @property {number | null} selected
 * @property {"plan" | "free"} camera
 * @property {string} score
 * @property {"here" | "away" | "gone" | null} following the presenter that this tab mirrors
 * @property {Against | null} against
 * @property {Agreement | null} agreement in the mode Inspect, where the truth is known
 * @property {Labels | null} labels in the mode Inspect, of a recording that can have some
 * @property {"labels" | "wall"} reference of the View
 * @property {("labels" | "wall")[]} references by what segments can be judged
 * @property {"labels" | "wall" | ""} judgedBy by what they are
 * @property {Record<string, number>} weights of the scores in the suspicion
 * @property {Record<string, number> | null} difference what became of the lines of A
 * @property {Box | null} extent
 * @property {Box | null} bounds
 * @property {Segment[]} segments
 * @property {Dropped[]} dropped
 * @property {Decision | null} decision
 * @property {Marks} [marks]
 * @property {Explanation | null} explanation
 * @property {Record<string, Histogram>} histograms
 * @property {boolean} truth the recording knows its walls
 * @property {number} extractionUs
 * @property {number} pictureMs
 * @property {number} drawMs
 * @property {number | null} latencyMs input in the page to this state, of the latest change made here
 */

/**
 * @typedef {object} Welcome
 * @property {"welcome"} type
 * @property {string} session
 * @property {boolean} resumed
 * @property {string} viser
 * @property {string} version
 * @property {Method[]} methods
 * @property {Score[]} scores
 * @property {RecordingEntry[]} recordings
 * @property {number} uploadLimit
 * @property {string} presenter the id under which others may follow this tab
 */

/** @typedef {{name: string, label: string, unit: string, help: string, worse: "higher" | "lower", least: number, weight: number}} Score (lineseg/doubt) */

/**
 * Scores of every stride-th frame under some thresholds, or a message why there are none.
 * @typedef {object} Survey
 * @property {"survey"} type
 * @property {number} rev
 * @property {string} recording
 * @property {string} topic
 * @property {string} method
 * @property {Params} params
 * @property {number} frames
 * @property {number} first number of the first of them
 * @property {number} stride
 * @property {string | null} message
 * @property {Record<string, number> | null} totals what became of the lines of A, over all frames
 * @property {Float32Array} values score after score, in the order of Welcome.scores
 */

/** @typedef {{type: "recordings", recordings: RecordingEntry[]}} Recordings */
/** @typedef {{type: "loading", recording: string, label: string, done: number, total: number, note: string}} Loading note: why it takes long */

/**
 * How a live source fares.
 * @typedef {object} LiveStatus
 * @property {"live"} type
 * @property {string} recording
 * @property {"connecting" | "open" | "lost"} connection
 * @property {string} message
 * @property {number} rate scans a second
 * @property {number | null} delay [s]
 * @property {number} total scans since the beginning
 * @property {number} dropped the oldest of them
 * @property {number} refused messages that were no scans
 * @property {number} most scans that are kept
 * @property {boolean} publishable the robot may take segments
 * @property {"" | "this" | "another"} publisher which tab's segments it gets, if any
 * @property {string} publishTopic
 * @property {number} published
 * @property {string} publishTrouble
 */

/** @typedef {{type: "error", where: string, message: string, rev: number | null}} Trouble */
/** @typedef {{type: "drawn", rev: number, origin: "page" | "scene", state: State}} Drawn */
/** @typedef {{type: "trace", trace: import("./learn/trace.js").Columns}} Traced */
/** @typedef {Welcome | Recordings | LiveStatus | Loading | Trouble | Traced | Drawn | Survey} Message */

/** A message as it arrives: text is JSON; a binary one has the length of its JSON head, the head, and numbers. @param {string | ArrayBuffer} data @returns {Message} */
export function messageOf(data) {
  if (typeof data === "string") return JSON.parse(data);
  const length = new DataView(data).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  return { ...head, values: new Float32Array(data, 4 + length) };
}
