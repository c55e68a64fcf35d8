// Written by `python -m lineseg_app.page_types` from what the server declares; a test says if it is outdated.
// The page names these types as import("./wire.js").NAME; there is no such module, for they are gone when it runs.

// Both directions

export type Params = Record<string, number>;

export type Point = [number, number];

export type Line = [number, number, number];

export type Box = [number, number, number, number];

export type Reference = "labels" | "wall";

export type Presence = "here" | "away" | "gone";

export type Connection = "connecting" | "open" | "lost";

export type Where = "recording" | "params" | "frame" | "view" | "upload" | "server";

export type Job = "curves" | "map" | "auto";

/** What is looked at. Every input changes only this. */
export type View = Required<Omit<ViewPatch, "mode" | "against">> & {
  mode: string;
  against: Against | null;
};
export type Against = Required<Pinned>;
/** The drawn state, as the page keeps it. latencyMs: from the latest change that was made here until it was drawn. */
export type State = DrawnState & { rev: number; latencyMs: number | null };
export type Field = FieldEntry;
export type Knob = KnobEntry;
export type Method = MethodEntry;
export type Score = ScoreEntry;
export type Trouble = Failure;
export type Columns = TraceColumns;
export type Marks = Record<string, number[]>;
/** What crosses the socket of a tab. */
export type Incoming = Hello | Change | OpenLink | Cancel | Close | Follow;
export type Message = Welcome | Recordings | LiveStatus | Loading | Failure | Traced | Drawn | Survey;
/** The scores of every stride-th frame, as the page reads them: score after score in the order of Welcome.scores. */
export type Survey = Surveyed & { values: Float32Array };
/** Of a threshold its values, and of each measure what it is at them. */
export type Curve = { values: number[] } & Record<string, (number | null)[]>;
/** What long work answers. */
export type Answer = Worked & Partial<SampledCurves & SampledMap> & Tuned;

// What the page sends

/** A, as a patch says it. */
export interface Pinned {
  method: string;
  params?: Record<string, number>;
}

/** Some fields of a View; those that were not sent stay as they are. */
export interface ViewPatch {
  mode?: "tune" | "learn" | "inspect";
  recording?: string;
  topic?: string | null;
  frame?: number;
  method?: string;
  params?: Record<string, number>;
  step?: number | null;
  selected?: number | null;
  camera?: "plan" | "free";
  score?: string;
  against?: Pinned | null;
  weights?: Record<string, number>;
  reference?: "labels" | "wall";
  layers?: Record<string, boolean>;
  live?: boolean;
  dark?: boolean;
}

/** The first message: which session to take up again, if it is still there, and what to look at. */
export interface Hello {
  type: "hello";
  session?: string | null;
  view?: Partial<View> | null;
  rev?: number | null;
  follow?: string | null;
}

export interface Change {
  type: "view";
  rev: number;
  patch: ViewPatch;
}

/** Look at what a link says: at all of it that can be had. */
export interface OpenLink {
  type: "link";
  rev: number;
  patch: Partial<View>;
}

export interface Cancel {
  type: "cancel";
}

export interface Close {
  type: "close";
}

/** Mirror the tab that shows itself under this id; null: no more. */
export interface Follow {
  type: "follow";
  id: string | null;
}

/** Without its ends they are those of the points. */
export interface SaidLine {
  first: number;
  last: number;
  start?: [number, number] | null;
  end?: [number, number] | null;
}

/** Everything that is said of a frame; revision: the one that this is on top of. */
export interface Said {
  recording: string;
  topic?: string | null;
  frame: number;
  revision: number;
  lines: SaidLine[] | null;
  tags: string[];
  note: string;
}

export interface CurvesWish {
  type: "curves";
  job: number;
  params: Record<string, number>;
}

export interface MapWish {
  type: "map";
  job: number;
  params: Record<string, number>;
  x: string;
  y: string;
  measure: string;
}

/** anew: forget the trials of former runs. */
export interface AutoWish {
  type: "auto";
  job: number;
  params: Record<string, number>;
  objective: "truth" | "label-free";
  thresholds: string[];
  trials: number;
  anew?: boolean;
}

export interface StopWish {
  type: "stop";
  what: "curves" | "map" | "auto";
}

export interface PublishAsked {
  session: string;
  on: boolean;
  topic?: string;
}

/** To the node at this address; extensions: also the thresholds that the authors' program does not know. */
export interface SendAsked {
  address: string;
  node: string;
  ros?: 1 | 2;
  extensions?: boolean;
  params?: Record<string, number>;
}

// What the server sends

/** A recording on offer; `missing` if its file is no longer there. */
export interface RecordingEntry {
  id: string;
  label: string;
  group: "Live" | "Samples" | "Lessons" | "Recent" | "Uploads" | "Command line" | "Drawn";
  missing: boolean;
}

/** A threshold: its name and its bounds. low, high, step: of its slider; least, most: what it may be, and why. */
export interface KnobEntry {
  name: string;
  kind: "float" | "int" | "bool";
  symbol: string;
  label: string;
  unit: string;
  low: number;
  high: number;
  step: number;
  log: boolean;
  least: number;
  most: number;
  why: string;
  help: string;
  extension: boolean;
  counted: string;
  floor: boolean;
  default: number;
}

/** begins: how a line of the method begins, in a word; ros: whether a ROS program knows its thresholds. */
export interface MethodEntry {
  name: string;
  label: string;
  citation: string;
  begins: string;
  ros: boolean;
  knobs: KnobEntry[];
}

/** A score of the strip. least: a difference that is worth a look; weight: in the suspicion, as it is at first. */
export interface ScoreEntry {
  name: string;
  label: string;
  unit: string;
  help: string;
  worse: "higher" | "lower";
  least: number;
  weight: number;
}

/** The answer to hello. viser: where the scene is; presenter: the id under which others may follow this tab. */
export interface Welcome {
  type: "welcome";
  session: string;
  resumed: boolean;
  viser: string;
  version: string;
  methods: MethodEntry[];
  scores: ScoreEntry[];
  recordings: RecordingEntry[];
  uploadLimit: number;
  presenter: string;
}

/** All that is on offer, when the list has changed. */
export interface Recordings {
  type: "recordings";
  recordings: RecordingEntry[];
}

/** A recording is being read; note: why it takes long. */
export interface Loading {
  type: "loading";
  recording: string;
  label: string;
  done: number;
  total: number;
  note: string;
}

/**
 * How a live source fares; told while a tab shows it, at most a few times a second.
 *
 * rate: scans a second; delay: of the last scan, from its stamp to its arrival [s]. total: scans since the
 * beginning, of which the oldest were dropped, so that at most `most` are kept; refused: messages that were no
 * scans. publisher: which tab's segments go back to the robot, if any.
 */
export interface LiveStatus {
  type: "live";
  recording: string;
  connection: "connecting" | "open" | "lost";
  message: string;
  rate: number;
  delay: number | null;
  total: number;
  dropped: number;
  refused: number;
  most: number;
  publishable: boolean;
  publisher: "" | "this" | "another";
  publishTopic: string;
  published: number;
  publishTrouble: string;
}

/** What could not be had, and why; rev: of the change that asked for it, if one did. */
export interface Failure {
  type: "error";
  where: "recording" | "params" | "frame" | "view" | "upload" | "server";
  message: string;
  rev: number | null;
}

/** Every decision of the frame that the next `drawn` shows. */
export interface Traced {
  type: "trace";
  trace: TraceColumns;
}

/** `origin` says whose input it answers: "page", or "scene" for viser's sliders and clicks in the scene. */
export interface Drawn {
  type: "drawn";
  rev: number;
  origin: "page" | "scene";
  state: DrawnState;
}

/**
 * The scores of every stride-th frame under these thresholds, or a message why there are none.
 *
 * Crosses the network as one binary frame: the length of the rest of the head (uint32), the head in JSON, filled up
 * with blanks to a multiple of 4 bytes, and `values`: float32, score after score in the order of Welcome.scores,
 * each of ⌈frames / stride⌉ frames. All little-endian. The last of the scores, the differences from A, is there,
 * and totals of every fate, if there is an A and every frame is known. first: number of the first frame, as in the
 * state.
 */
export interface Surveyed {
  type: "survey";
  rev: number;
  recording: string;
  topic: string;
  method: string;
  params: Record<string, number>;
  frames: number;
  first: number;
  stride: number;
  message: string | null;
  totals: Record<string, number> | null;
}

/** A stream of scans in the recording. */
export interface Topic {
  name: string;
  scans: number;
}

/** Where the frame of a failure pack came from, counted from 0, and how it was looked at. */
export interface Pack {
  recording: string;
  frame: number;
  method: string;
  params: Record<string, number>;
  note: string;
}

/** first, last: its beams. rms: of the distances of its points [m]. */
export interface Segment {
  start: [number, number];
  end: [number, number];
  first: number;
  last: number;
  line: [number, number, number];
  points: number;
  length: number;
  rms: number;
}

/** A line that was not kept; check: the threshold that it falls short of. */
export interface Dropped {
  first: number;
  last: number;
  points: number;
  length: number;
  check: string;
  text: string;
}

/** The decision that the replay shows; value, limit: what was compared, null where it is no finite number. */
export interface Decision {
  index: number;
  kind: string;
  phase: string;
  text: string;
  beam: number;
  first: number;
  last: number;
  check: string;
  direction: number;
  points: number;
  candidate: number;
  value: number | null;
  limit: number | null;
  line: [number | null, number | null, number | null];
}

/** What became of the selected beam. at: its point [m]; segment: that of the beam, −1 without one. */
export interface Explanation {
  beam: number;
  text: string;
  segment: number;
  check: string;
  value: number | null;
  limit: number | null;
  margin: number | null;
  at: Point | null;
}

/** How often the quantity that a threshold cuts had which value, from low to high. */
export interface Histogram {
  low: number;
  high: number;
  log: boolean;
  passed: number[];
  failed: number[];
}

/** Segments against true lines: the numbers of the paper's Table 4 and more; null where one is not defined. */
export interface Agreement {
  trueLines: number | null;
  segments: number | null;
  matches: number | null;
  trueRate: number | null;
  falseRate: number | null;
  completeness: number | null;
  splits: number | null;
  merges: number | null;
  endpointMedian: number | null;
  endpointMost: number | null;
}

/** A line that is there, as people say: its beams and its ends [m]. */
export interface TrueLine {
  first: number;
  last: number;
  start: [number, number];
  end: [number, number];
}

/** What people say of a frame. lines: null where nobody has said which are true; revision: counts the savings. */
export interface Labelled {
  revision: number;
  lines: TrueLine[] | null;
  tags: string[];
  note: string;
}

/**
 * What people say of the frame on the screen, and where it is kept.
 *
 * apart: whether that is the user's data folder, not the folder of the recording. stamp: another one whenever the
 * file is; trouble: why the file cannot be read, or "".
 */
export interface Labels {
  revision: number;
  lines: TrueLine[] | null;
  tags: string[];
  note: string;
  file: string;
  folder: string;
  apart: boolean;
  stamp: string;
  trouble: string;
}

/**
 * What is on the screen.
 *
 * view: all of it, as a patch that leads back to it. label: of the recording; pack: of a failure pack, what it
 * says. topic: the one on the screen. live: whether the newest frame is followed, null of a recording that is not
 * live; first: number of the first frame, of a live recording the oldest are gone. stamp: time since the first scan
 * [s]. covered: how many of the `valid` beams are in segments. steps: decisions that there are. difference: what
 * became of the lines of A. truth: the recording knows its walls. agreement: in the mode Inspect, where the truth
 * is known; labels: there, of a recording that can have some. references: by what segments can be judged; judgedBy:
 * by what they are, "" without truth. extent: box around the points of the frame, bounds: of the recording [m].
 * extractionUs: time of the extraction [µs].
 */
export interface Scene {
  view: View;
  mode: View["mode"];
  recording: string;
  label: string;
  format: string;
  pack: Pack | null;
  topic: string;
  topics: Topic[];
  frame: number;
  frames: number;
  live: boolean | null;
  first: number;
  stamp: number | null;
  frameId: string;
  beams: number;
  valid: number;
  covered: number;
  method: string;
  params: Record<string, number>;
  step: number | null;
  steps: number;
  layers: Record<string, boolean>;
  selected: number | null;
  camera: View["camera"];
  score: string;
  against: Against | null;
  weights: Record<string, number>;
  difference: Record<string, number> | null;
  extent: [number, number, number, number];
  bounds: [number, number, number, number];
  segments: Segment[];
  dropped: Dropped[];
  decision: Decision | null;
  explanation: Explanation | null;
  histograms: Record<string, Histogram>;
  truth: boolean;
  agreement: Agreement | null;
  labels: Labels | null;
  reference: Reference;
  references: ("labels" | "wall")[];
  judgedBy: "labels" | "wall" | "";
  extractionUs: number;
}

/** How long it took to make the picture, and to hand it to viser [ms]. */
export interface Timings {
  pictureMs: number;
  drawMs: number;
}

/**
 * The state that was drawn.
 *
 * marks: decisions at which replay may halt, if the trace is another than that of the last message. following: the
 * presenter that this tab mirrors.
 */
export interface DrawnState {
  view: View;
  mode: View["mode"];
  recording: string;
  label: string;
  format: string;
  pack: Pack | null;
  topic: string;
  topics: Topic[];
  frame: number;
  frames: number;
  live: boolean | null;
  first: number;
  stamp: number | null;
  frameId: string;
  beams: number;
  valid: number;
  covered: number;
  method: string;
  params: Record<string, number>;
  step: number | null;
  steps: number;
  layers: Record<string, boolean>;
  selected: number | null;
  camera: View["camera"];
  score: string;
  against: Against | null;
  weights: Record<string, number>;
  difference: Record<string, number> | null;
  extent: [number, number, number, number];
  bounds: [number, number, number, number];
  segments: Segment[];
  dropped: Dropped[];
  decision: Decision | null;
  explanation: Explanation | null;
  histograms: Record<string, Histogram>;
  truth: boolean;
  agreement: Agreement | null;
  labels: Labels | null;
  reference: Reference;
  references: ("labels" | "wall")[];
  judgedBy: "labels" | "wall" | "";
  extractionUs: number;
  pictureMs: number;
  drawMs: number;
  marks?: Record<string, number[]>;
  following: "here" | "away" | "gone" | null;
}

/** Indices of decisions at which each phase and each line begins. */
export interface Starts {
  phase: number[];
  line: number[];
}

/**
 * The decisions of a frame as columns, one entry each, and the points they speak of.
 *
 * kinds, checks, phases: names of the numbers in the columns kind, check, phase. first, last, beam: beams, −1 none.
 * text: the sentence of each. points: how many points lie from first to last. jumps: indices to which each jump of
 * the method leads. total: decisions that there are, of which the columns hold the first. a, b, c: of the line;
 * others, ends: of the few decisions that have them, by index: (a, b, c) of the partner's line, (x1, y1, x2, y2) of
 * the endpoints. x, y: of every beam [m], null where it has no return. circle: whether the scan is a full circle.
 */
export interface TraceColumns {
  kinds: string[];
  checks: string[];
  phases: string[];
  jumps: Record<string, number[]>;
  starts: Starts;
  total: number;
  circle: boolean;
  kind: number[];
  check: number[];
  phase: number[];
  direction: number[];
  candidate: number[];
  first: number[];
  last: number[];
  beam: number[];
  points: number[];
  a: (number | null)[];
  b: (number | null)[];
  c: (number | null)[];
  others: Record<number, [number, number, number]>;
  ends: Record<number, [number, number, number, number]>;
  value: (number | null)[];
  limit: (number | null)[];
  text: string[];
  x: (number | null)[];
  y: (number | null)[];
}

/** What would change the answer for the selected beam, and of which answer. */
export interface WhatIfs {
  frame: number;
  beam: number | null;
  method: string;
  params: Record<string, number>;
  changes: WhatIf[];
}

/** What looks wrong in the frames that were asked about, by their numbers. */
export interface Whys {
  recording: string;
  method: string;
  params: Record<string, number>;
  words: Record<number, string[]>;
}

/**
 * How the whole recording agrees with its truth; stride: of so many frames one was looked at.
 *
 * labelled: stamp of the labels that are the truth, or "".
 */
export interface Truth {
  recording: string;
  method: string;
  params: Record<string, number>;
  judgedBy: "labels" | "wall";
  labelled: string;
  agreement: Agreement;
  stride: number;
}

/** What people say of a frame, in short. lines: how many, null where nobody has said which are true. */
export interface Brief {
  revision: number;
  lines: number | null;
  tags: string[];
  note: string;
}

/** What people say of a recording, by frame. stamp: another one whenever its file is. */
export interface LabelsOverview {
  stamp: string;
  frames: Record<number, Brief>;
}

/** points: of each beam [m], null without a return. */
export interface Sweep {
  points: ([number, number] | null)[];
  fullCircle: boolean;
}

/**
 * One threshold over its range, of each value how many lines there are and which beams are in them.
 *
 * runs: of each value the stretches of beams of one line: first, last, "#rrggbb".
 */
export interface ThresholdSweep {
  name: string;
  beams: number;
  values: number[];
  lines: number[];
  runs: [number, number, string][][];
}

/**
 * The table of a sweep. axes: the values of each swept threshold; columns: of each row.
 *
 * file: of each row its place in files.
 */
export interface SweepTable {
  files: string[];
  axes: Record<string, number[]>;
  measures: string[];
  file: number[];
  columns: Record<string, (number | null)[]>;
}

/** What thresholds do to some frames of a recording, spread evenly; of: how many it has. */
export interface Sampled {
  frames: number;
  of: number;
  params: Record<string, number>;
}

/** Of each threshold its values, and of each measure what it is at them. */
export interface SampledCurves {
  frames: number;
  of: number;
  params: Record<string, number>;
  curves: Record<string, Curve>;
}

/** heights: a row for each of ys; of each of xs what the measure is, null where it is not defined. */
export interface SampledMap {
  frames: number;
  of: number;
  params: Record<string, number>;
  x: string;
  y: string;
  measure: string;
  xs: number[];
  ys: number[];
  heights: ((number | null)[])[];
}

/** score: null where there is none. */
export interface Trial {
  number: number;
  params: Record<string, number>;
  score: number | null;
}

/** The thresholds that are proposed, and whether they gain anything on frames that were held back. */
export interface Verdict {
  params: Record<string, number>;
  text: string;
  gained: boolean;
}

/** A step of auto-tuning: at first what is looked for, then trials as they come, now and then what matters. */
export interface Tuned {
  text?: string;
  caution?: string;
  thresholds?: string[];
  study?: string;
  trials?: Trial[];
  importance?: Record<string, number>;
  verdict?: Verdict;
}

/** What every answer of long work has. done: it has ended; stopped: because somebody said so; message: why not. */
export interface Worked {
  type: "curves" | "map" | "auto";
  job: number;
  done?: boolean;
  stopped?: boolean;
  message?: string;
}

/** A decision, by what it is and not by its number: the nth (from 0, or from the end) that agrees in all. */
export interface Find {
  kind: string;
  check: string | null;
  direction: 1 | -1 | null;
  beam: number | null;
  nth: number;
}

/**
 * One text, and what the page shows beside it: the decision found, or without one the whole result.
 *
 * params: on top of the lesson's own. method: whose whole result is shown, with its usual thresholds, instead of
 * that of region growing; nothing of it can be searched for.
 */
export interface Step {
  text: string;
  method: string | null;
  find: Find | null;
  params: Record<string, number>;
  selected: number | null;
}

/**
 * What must be so, in all its parts, for the task to be done.
 *
 * lines: how many, [least, most]. together: pairs of beams in one line; apart: in two; inside, outside: beams in
 * some line, in none. changed: the only thresholds that may differ from the lesson's, and at least one of them
 * must. at: the kind of decision that is shown. selected: the beam is one of these. count: how many such decisions
 * there are, [least, most].
 */
export interface Goal {
  lines: [number, number] | null;
  together: [number, number][];
  apart: [number, number][];
  inside: number[];
  outside: number[];
  changed: string[];
  at: Find | null;
  selected: number[];
  count: [Find, number, number] | null;
}

/** text: what to do; hint: on demand; done: said when it is done. */
export interface Task {
  text: string;
  hint: string;
  done: string;
  goal: Goal;
  params: Record<string, number>;
}

/** params: thresholds that differ from USUAL and the defaults; knobs: those the lesson offers to change. */
export interface Lesson {
  title: string;
  about: string;
  recording: string;
  frame: number;
  params: Record<string, number>;
  knobs: string[];
  steps: Step[];
  task: Task;
}

export interface NamedLesson {
  title: string;
  about: string;
  recording: string;
  frame: number;
  params: Record<string, number>;
  knobs: string[];
  steps: Step[];
  task: Task;
  id: string;
}

/** broken: one sentence for each file that is no lesson. */
export interface Lessons {
  lessons: NamedLesson[];
  broken: string[];
}

/**
 * A field of the View as the page knows it; see ViewField.
 *
 * default: {} where it depends on other fields. most: of a number, or of the length of a text.
 */
export interface FieldEntry {
  name: string;
  link: string | null;
  written: "text" | "whole" | "choice" | "thresholds" | "pinned" | "numbers" | "switches" | "switch";
  default: any;
  choices: string[];
  most: number | null;
  mirrored: boolean;
  resetBy: string[];
  lasting: boolean;
}

/** How a measure is called and read; truth: whether it needs true lines. */
export interface Measure {
  name: string;
  label: string;
  unit: string;
  better: "higher" | "lower" | "neither";
  truth: boolean;
  help: string;
}

/**
 * The nearest value of a threshold at which a beam has another answer; None if no value in its range gives one.
 *
 * segment: that of the beam at this value; first, last: the beams of that segment; −1 for none.
 */
export interface WhatIf {
  name: string;
  value: number | null;
  segment: number;
  first: number;
  last: number;
  text: string;
}

/**
 * One parameter: under which name, what was sent, what the robot has now (None if nothing), and what it said.
 *
 * taken: whether the robot has the value that was sent.
 */
export interface Sent {
  name: string;
  threshold: string;
  value: number;
  now: unknown;
  taken: boolean;
  reason: string;
}
