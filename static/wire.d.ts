// Generated from the server's types by `python -m lineseg_app.page_types`; a test fails if it is outdated.
// Refer to these types as import("./wire.js").NAME. No such module exists, because types are gone at run time.

// Both directions

export type Params = Record<string, number>;

export type Reading = Record<string, string | number>;

export type Point = [number, number];

export type Line = [number, number, number];

export type Box = [number, number, number, number];

export type Reference = "labels" | "wall";

export type Presence = "here" | "away" | "gone";

export type Connection = "connecting" | "open" | "lost";

export type Where = "recording" | "params" | "frame" | "view" | "upload" | "server";

export type Job = "curves" | "map" | "auto" | "fit";

/** What the tab shows. Every input changes only this. */
export type View = Required<Omit<ViewPatch, "mode" | "against">> & {
  mode: string;
  against: Against | null;
};
export type Against = Required<Pinned>;
/** The drawn state, as the page keeps it. latencyMs: from the latest change made here until it was drawn. */
export type State = DrawnState & { rev: number; latencyMs: number | null };
/** A sentence: text, and parts of it that name something in the scene or a threshold. */
export type Words = (string | Link)[];
export type Field = FieldEntry;
export type Knob = KnobEntry;
export type Method = MethodEntry;
export type Score = ScoreEntry;
export type Trouble = Failure;
export type Columns = TraceColumns;
export type Marks = Record<string, number[]>;
/** The messages on the socket of a tab. */
export type Incoming = Hello | Change | OpenLink | Cancel | Close | Follow;
export type Message = Welcome | Recordings | LiveStatus | Loading | Failure | Traced | Times | Drawn | Survey;
/** The scores of every stride-th frame, as the page reads them: score after score in the order of Welcome.scores. */
export type Survey = Surveyed & { values: Float32Array };
/** The values of a threshold, and the value of each measure there. */
export type Curve = { values: number[] } & Record<string, (number | null)[]>;
/** An answer of long work. */
export type Answer = Worked & Partial<SampledCurves & SampledMap> & Tuned & Fitted;

// What the page sends

/** A in a patch. */
export interface Pinned {
  method: string;
  params?: Record<string, number>;
}

/** Some fields of a View; the others stay unchanged. */
export interface ViewPatch {
  mode?: "tune" | "learn" | "inspect";
  recording?: string;
  topic?: string | null;
  reading?: Record<string, string | number | null>;
  frame?: number;
  method?: string;
  params?: Record<string, number>;
  step?: number | null;
  lesson?: string | null;
  page?: number;
  selected?: number | null;
  beside?: number | null;
  closeup?: "on" | "off";
  camera?: "plan" | "free";
  speed?: "0.5" | "1" | "2" | "4" | "8";
  score?: string;
  against?: Pinned | null;
  weights?: Record<string, number>;
  reference?: "labels" | "wall";
  layers?: Record<string, boolean>;
  space?: "laser" | "world";
  past?: "none" | "10" | "100" | "all";
  ride?: "on" | "off";
  live?: boolean;
  dark?: boolean;
}

/** The first message: the session to resume, if it still exists, and the View. */
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

/** Apply a link: all of its fields that are valid. */
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

/** Mirror the tab with this presenter id; null stops mirroring. */
export interface Follow {
  type: "follow";
  id: string | null;
}

/** What a tab in a class says of itself. */
export interface PupilSays {
  name: string;
  done?: number;
}

/** A true line; missing ends are taken from its points. */
export interface SaidLine {
  first: number;
  last: number;
  start?: [number, number] | null;
  end?: [number, number] | null;
}

/** All labels of a frame; reading: how the file is read; revision: the one they are based on. */
export interface Said {
  recording: string;
  reading?: Record<string, string | number | null>;
  frame: number;
  revision: number;
  lines: SaidLine[] | null;
  tags: string[];
  note: string;
}

/** The texts of a lesson that is made of what a tab shows. box: of the plan on the stage [m]. */
export interface NewLesson {
  title: string;
  about: string;
  text: string;
  question: string;
  right: string;
  wrong: string[];
  box?: [number, number, number, number] | null;
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

/** anew: forget the trials of earlier runs. */
export interface AutoWish {
  type: "auto";
  job: number;
  params: Record<string, number>;
  objective: "truth" | "label-free";
  thresholds: string[];
  trials: number;
  anew?: boolean;
}

/** For the recording, the method and the thresholds on the screen. */
export interface FitWish {
  type: "fit";
  job: number;
}

export interface StopWish {
  type: "stop";
  what: "curves" | "map" | "auto" | "fit";
}

export interface PublishAsked {
  session: string;
  on: boolean;
  topic?: string;
}

/** Thresholds for a node of lineseg. */
export interface ToNodeAsked {
  address: string;
  method?: string;
  params?: Record<string, number>;
}

/** The node to send to; extensions: include thresholds that the authors' program does not have. */
export interface SendAsked {
  address: string;
  node: string;
  ros?: 1 | 2;
  extensions?: boolean;
  params?: Record<string, number>;
}

// What the server sends

/**
 * A part of a sentence that names something, and what it is.
 *
 * beams: the first and the last; segment: its number in the frame; threshold: its name; line: x1, y1, x2, y2 [m] of
 * a line that the frame lacks.
 */
export interface Link {
  text: string;
  beams?: [number, number];
  segment?: number;
  threshold?: string;
  line?: [number, number, number, number];
}

/** A recording in the menu; `missing` if its file no longer exists. reading: how it was last read. */
export interface RecordingEntry {
  id: string;
  label: string;
  group: "Live" | "Samples" | "Lessons" | "Recent" | "Uploads" | "Command line" | "Drawn";
  missing: boolean;
  reading: Record<string, string | number>;
}

/** A threshold: its name and its bounds. low, high, step: of its slider; least, most: allowed range, and why. */
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

/** begins: how a line of the method starts, in a word; ros: whether a ROS program has its thresholds. */
export interface MethodEntry {
  name: string;
  label: string;
  citation: string;
  begins: string;
  ros: boolean;
  knobs: KnobEntry[];
}

/** A field of the Reading. choices: allowed values, [] for any; only: formats that have it, [] for all. */
export interface ReadingEntry {
  name: string;
  kind: "str" | "int" | "float";
  label: string;
  help: string;
  group: "scans" | "numbers" | "left out";
  unit: string;
  form: string;
  choices: string[];
  only: string[];
}

/** A score of the strip. least: smallest difference that matters; weight: default weight in the suspicion. */
export interface ScoreEntry {
  name: string;
  label: string;
  unit: string;
  help: string;
  worse: "higher" | "lower";
  least: number;
  weight: number;
}

/**
 * The answer to hello. viser: address of the scene; presenter: id with which others may follow this tab.
 *
 * suffixes: those by which a recording is known among other files.
 */
export interface Welcome {
  type: "welcome";
  session: string;
  resumed: boolean;
  viser: string;
  version: string;
  methods: MethodEntry[];
  scores: ScoreEntry[];
  reading: ReadingEntry[];
  recordings: RecordingEntry[];
  uploadLimit: number;
  suffixes: string[];
  presenter: string;
}

/** All recordings in the menu, sent when the list changes. */
export interface Recordings {
  type: "recordings";
  recordings: RecordingEntry[];
}

/** A recording is being read; note: why it takes long; behind: whether its first scans are shown already. */
export interface Loading {
  type: "loading";
  recording: string;
  label: string;
  done: number;
  total: number;
  note: string;
  behind: boolean;
}

/**
 * Status of a live source, sent while a tab shows it, at most a few times a second.
 *
 * rate: scans per second; delay: of the last scan, from its stamp to its arrival [s]. total: scans since the source
 * began; the newest `most` are kept; refused: messages that were not scans; notDrawn: scans that this tab passed
 * over, because newer ones had arrived. publisher: the tab whose segments go back to the robot, if any.
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
  notDrawn: number;
  most: number;
  publishable: boolean;
  publisher: "" | "this" | "another";
  publishTopic: string;
  published: number;
  publishTrouble: string;
}

/** A recording that could not be opened as it was to be read. named: fields of the Reading in the message. */
export interface Refused {
  recording: string;
  label: string;
  topic: string | null;
  reading: Record<string, string | number>;
  named: string[];
}

/** A failed request, and why; rev: of the change that caused it, if any. refused: the recording, if it is one. */
export interface Failure {
  type: "error";
  where: "recording" | "params" | "frame" | "view" | "upload" | "server";
  message: string;
  rev: number | null;
  refused: Refused | null;
}

/** All decisions of the frame in the next `drawn` message. */
export interface Traced {
  type: "trace";
  trace: TraceColumns;
}

/**
 * When each frame of a recording was taken, sent before its first picture.
 *
 * since: time since the first scan of the file [s]; null if the stamps cannot be believed, and why, in a few words.
 */
export interface Times {
  type: "times";
  place: string;
  since: number[] | null;
  why: string;
}

/** origin: the source of the input: "page", or "scene" for viser's sliders and clicks in the scene. */
export interface Drawn {
  type: "drawn";
  rev: number;
  origin: "page" | "scene";
  state: DrawnState;
}

/**
 * The scores of every stride-th frame under these thresholds, or a message why there are none.
 *
 * Sent as one binary frame: the length of the head (uint32); the head in JSON, padded with spaces to a multiple of
 * 4 bytes; and `values`: float32, score after score in the order of Welcome.scores, each with ⌈frames / stride⌉
 * frames. All little-endian. The last score, the differences from A, and the totals of every fate are present only
 * if there is an A and every frame is known. place, first, every: as in the state.
 */
export interface Surveyed {
  type: "survey";
  rev: number;
  recording: string;
  place: string;
  method: string;
  params: Record<string, number>;
  frames: number;
  first: number;
  every: number;
  stride: number;
  message: string | null;
  totals: Record<string, number> | null;
}

/** A stream of scans in the recording. */
export interface Topic {
  name: string;
  scans: number;
}

/** The origin of a failure pack's frame, counted from 0, and how it was viewed. */
export interface Pack {
  recording: string;
  frame: number;
  method: string;
  params: Record<string, number>;
  note: string;
}

/** first, last: its beams. rms: root mean square distance of its points [m]. colour: "#rrggbb". */
export interface Segment {
  start: [number, number];
  end: [number, number];
  first: number;
  last: number;
  line: [number, number, number];
  points: number;
  length: number;
  rms: number;
  colour: string;
}

/**
 * A dropped line; check: the threshold that it missed; start, end: its outermost points [m].
 *
 * beam: to ask about it, in no segment if possible.
 */
export interface Dropped {
  start: [number, number];
  end: [number, number];
  beam: number;
  first: number;
  last: number;
  points: number;
  length: number;
  check: string;
  text: string;
}

/**
 * The decision that the replay shows; value, limit: the compared numbers, null if not finite.
 *
 * words: its sentence in parts.
 */
export interface Decision {
  index: number;
  kind: string;
  phase: string;
  text: string;
  words: Words;
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

/** The explanation of the selected beam. words: its sentence in parts; at: its point [m]; segment: or −1. */
export interface Explanation {
  beam: number;
  text: string;
  words: Words;
  segment: number;
  check: string;
  value: number | null;
  limit: number | null;
  margin: number | null;
  at: Point | null;
}

/** Histogram, from low to high, of the quantity that a threshold limits. */
export interface Histogram {
  low: number;
  high: number;
  log: boolean;
  passed: number[];
  failed: number[];
}

/** Segments compared with true lines: the numbers of the paper's Table 4 and more; null if undefined. */
export interface Agreement {
  trueLines: number | null;
  segments: number | null;
  matches: number | null;
  trueRate: number | null;
  falseRate: number | null;
  neutral: number | null;
  neutralFalseRate: number | null;
  completeness: number | null;
  splits: number | null;
  merges: number | null;
  endpointMedian: number | null;
  endpointMost: number | null;
}

/** A labelled true line: its beams and its ends [m]. */
export interface TrueLine {
  first: number;
  last: number;
  start: [number, number];
  end: [number, number];
}

/** The labels of a frame. lines: null if its true lines are not labelled; revision: number of saves. */
export interface Labelled {
  revision: number;
  lines: TrueLine[] | null;
  tags: string[];
  note: string;
}

/**
 * The labels of the frame on the screen, and where they are kept.
 *
 * apart: whether that is the user's data folder, not the folder of the recording. stamp: changes with the file;
 * trouble: why the file cannot be read, or "".
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

/** Something that the file does not say. change: other values of the Reading to try. */
export interface Guess {
  field: string;
  value: string;
  why: string;
  change: Record<string, string | number>;
}

/** Something odd about the file. change: of the Reading, that would mend it; {} if none would. */
export interface Notice {
  kind: string;
  text: string;
  change: Record<string, string | number>;
}

/**
 * What a file was taken for.
 *
 * line: one line that says it; used: the Reading with all that was found or guessed. skipped: a sentence about
 * scans that could not be read, or "". believable: whether the stamps can be believed.
 */
export interface Account {
  line: string;
  used: Record<string, string | number>;
  guesses: Guess[];
  notices: Notice[];
  skipped: string;
  believable: boolean;
}

/** A name at a place of the scan [m]. */
export interface Named {
  text: string;
  at: [number, number];
}

/** A distance between two places [m]. beside: drawn beside them. */
export interface Measured {
  text: string;
  start: [number, number];
  end: [number, number];
  beside: boolean;
}

/**
 * The part of the plan that shows a decision.
 *
 * box: as drawn [m]. factor: distances along the unit vector `normal` are drawn so many times as long, about `at`.
 */
export interface Framing {
  box: [number, number, number, number];
  factor: number;
  normal: [number, number];
  at: [number, number];
  names: Named[];
  measures: Measured[];
}

/** Another laser of the robot. why: why its scan is not shown, "" if it is, null while it is being read. */
export interface Beside {
  topic: string;
  colour: string;
  why: string | null;
}

/**
 * The laser in the world. pose: x, y [m] and heading [rad], null if it is not known at this frame.
 *
 * upsideDown: whether its beams turn clockwise seen from above. map: what is said of the line map, "" while it is
 * made and if it is not shown; mapPercent: how much of it is made. lasers: the others of the robot, none if not
 * shown.
 */
export interface World {
  pose: number[] | null;
  upsideDown: boolean;
  map: string;
  mapPercent: number;
  lasers: Beside[];
}

/**
 * What the View says, by itself for the parts of the page that need little of it.
 *
 * view: the whole View, as a patch that restores it. frame: its number in the file or source, counted from 0.
 */
export interface OfView {
  view: View;
  mode: View["mode"];
  frame: number;
  method: string;
  params: Record<string, number>;
  step: number | null;
  layers: Record<string, boolean>;
  selected: number | null;
  camera: View["camera"];
  score: string;
  against: Against | null;
  weights: Record<string, number>;
  reference: Reference;
}

/**
 * The recording on the screen.
 *
 * pack: description in a failure pack. place: equal for states of the same scans. readAs: the Reading that was
 * asked for, with the topic. account: what the file was taken for, null if there is no file. live: whether the
 * newest frame is followed, null if the recording is not live. frames: how many there are, of which the first has
 * the number `first`, the next `first + every`; growing: whether more of them are being read. mayHavePoses: whether
 * poses were or can be looked for; poses: what is said of them, "" if nobody asked. truth: whether the recording
 * has its true walls; byViews: what is said of walls that many views agree on, "" for others.
 */
export interface OfRecording {
  recording: string;
  label: string;
  format: string;
  pack: Pack | null;
  topic: string;
  topics: Topic[];
  place: string;
  readAs: Record<string, string | number>;
  account: Account | null;
  frames: number;
  live: boolean | null;
  first: number;
  every: number;
  growing: boolean;
  mayHavePoses: boolean;
  poses: string;
  truth: boolean;
  byViews: string;
}

/**
 * What is on the screen.
 *
 * stamp: of the scan [s]; since: time since the first scan of the file [s], null if the stamps cannot be believed.
 * covered: number of `valid` beams in segments. steps: number of decisions. difference: fates of the lines of A.
 * agreement: in the mode Inspect if the truth is known; labels: in the mode Inspect if the recording can have
 * labels. framing: of the decision on the screen, ahead: of the next one without its outcome; null where the whole
 * plan is shown. nodes: what the scene shows. references: available references; judgedBy: the one in use, ""
 * without truth. world: null if the scene shows the frame of the laser. extent: box around the points of the frame,
 * bounds: of what the scene shows [m]. extractionUs: time of the extraction [µs].
 */
export interface Scene {
  view: View;
  mode: View["mode"];
  frame: number;
  method: string;
  params: Record<string, number>;
  step: number | null;
  layers: Record<string, boolean>;
  selected: number | null;
  camera: View["camera"];
  score: string;
  against: Against | null;
  weights: Record<string, number>;
  reference: Reference;
  recording: string;
  label: string;
  format: string;
  pack: Pack | null;
  topic: string;
  topics: Topic[];
  place: string;
  readAs: Record<string, string | number>;
  account: Account | null;
  frames: number;
  live: boolean | null;
  first: number;
  every: number;
  growing: boolean;
  mayHavePoses: boolean;
  poses: string;
  truth: boolean;
  byViews: string;
  stamp: number | null;
  since: number | null;
  frameId: string;
  beams: number;
  valid: number;
  covered: number;
  steps: number;
  difference: Record<string, number> | null;
  extent: [number, number, number, number];
  bounds: [number, number, number, number];
  segments: Segment[];
  dropped: Dropped[];
  decision: Decision | null;
  framing: Framing | null;
  ahead: Framing | null;
  nodes: string[];
  world: World | null;
  explanation: Explanation | null;
  histograms: Record<string, Histogram>;
  agreement: Agreement | null;
  labels: Labels | null;
  references: ("labels" | "wall")[];
  judgedBy: "labels" | "wall" | "";
  extractionUs: number;
}

/** Time to make the picture, and to pass it to viser [ms]. */
export interface Timings {
  pictureMs: number;
  drawMs: number;
}

/**
 * The drawn state.
 *
 * marks: decisions at which the replay may pause, sent if the trace differs from the last message. following: the
 * presenter that this tab mirrors.
 */
export interface DrawnState {
  view: View;
  mode: View["mode"];
  frame: number;
  method: string;
  params: Record<string, number>;
  step: number | null;
  layers: Record<string, boolean>;
  selected: number | null;
  camera: View["camera"];
  score: string;
  against: Against | null;
  weights: Record<string, number>;
  reference: Reference;
  recording: string;
  label: string;
  format: string;
  pack: Pack | null;
  topic: string;
  topics: Topic[];
  place: string;
  readAs: Record<string, string | number>;
  account: Account | null;
  frames: number;
  live: boolean | null;
  first: number;
  every: number;
  growing: boolean;
  mayHavePoses: boolean;
  poses: string;
  truth: boolean;
  byViews: string;
  stamp: number | null;
  since: number | null;
  frameId: string;
  beams: number;
  valid: number;
  covered: number;
  steps: number;
  difference: Record<string, number> | null;
  extent: [number, number, number, number];
  bounds: [number, number, number, number];
  segments: Segment[];
  dropped: Dropped[];
  decision: Decision | null;
  framing: Framing | null;
  ahead: Framing | null;
  nodes: string[];
  world: World | null;
  explanation: Explanation | null;
  histograms: Record<string, Histogram>;
  agreement: Agreement | null;
  labels: Labels | null;
  references: ("labels" | "wall")[];
  judgedBy: "labels" | "wall" | "";
  extractionUs: number;
  pictureMs: number;
  drawMs: number;
  marks?: Record<string, number[]>;
  following: "here" | "away" | "gone" | null;
}

/** Indices of the decisions at which each phase and each line starts. */
export interface Starts {
  phase: number[];
  line: number[];
}

/**
 * The decisions of a frame as columns, one entry each, and the points they refer to.
 *
 * kinds, checks, phases: names of the numbers in the columns kind, check, phase. first, last, beam: beams, −1 if
 * none. text: the sentence of each. points: number of points from first to last. jumps: indices for each jump of
 * the method. total: number of all decisions; the columns hold the first ones. a, b, c: of the line; others, ends:
 * by index, for the few decisions that have them: (a, b, c) of the partner's line, (x1, y1, x2, y2) of the
 * endpoints. x, y: of every beam [m], null if it has no return. circle: whether the scan is a full circle.
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

/** A term or symbol. forms: how texts write it; equation: of the paper, lesson: the id of one about it, or "". */
export interface ExplainedTerm {
  name: string;
  text: string;
  forms: string[];
  equation: string;
  lesson: string;
}

/** The threshold changes that would change the answer for the selected beam, and that answer. */
export interface WhatIfs {
  frame: number;
  beam: number | null;
  method: string;
  params: Record<string, number>;
  changes: WhatIf[];
}

/**
 * The segments of the frame compared with its true lines; null if these are not known.
 *
 * byViews: whether many views agree on these.
 */
export interface Judgement {
  frame: number;
  method: string;
  params: Record<string, number>;
  agreement: Agreement | null;
  byViews: boolean;
}

/** Values of thresholds with which two beams would be parted or joined; first, last: of their line then, or −1. */
export interface Otherwise {
  values: Record<string, number>;
  words: Words;
  first: number;
  last: number;
}

/** Why two beams are in one line or in two; one, other: their segments, or −1. */
export interface Apart {
  frame: number;
  selected: number;
  beside: number;
  method: string;
  params: Record<string, number>;
  together: boolean;
  one: number;
  other: number;
  words: Words;
  changes: Otherwise[];
}

/** One thing that looks wrong in a frame. first, last: the beams concerned, or −1; ghosts: lines that it lacks. */
export interface Finding {
  score: string;
  words: Words;
  first: number;
  last: number;
  ghosts: [number, number, number, number][];
}

/**
 * What looks wrong in the requested frames, by frame number. whole: not given up because other thresholds came.
 */
export interface Whys {
  place: string;
  method: string;
  params: Record<string, number>;
  found: Record<number, Finding[]>;
  whole: boolean;
}

/**
 * The agreement of the whole recording with its truth; stride: every stride-th frame was judged.
 *
 * labelled: stamp of the labels used as truth, or "".
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

/**
 * A recording under a Reading that someone tries. job: of the wish.
 *
 * message: why it cannot be read in this way, and `named`: the fields that it names. choices: values to choose
 * from, by field, which the file has. lines: the first of a text file. scans: the points of the first scans [m].
 * whole: whether all of the file was read.
 */
export interface Previewed {
  job: number;
  message: string | null;
  named: string[];
  format: string;
  choices: Record<string, string[]>;
  lines: string[];
  account: Account | null;
  scans: [number, number][][];
  whole: boolean;
}

/** Summary of the labels of a frame. lines: number of true lines, null if they are not labelled. */
export interface Brief {
  revision: number;
  lines: number | null;
  tags: string[];
  note: string;
}

/** The labels of a recording, by frame. stamp: changes with the file. */
export interface LabelsOverview {
  stamp: string;
  frames: Record<number, Brief>;
}

/** points: of each beam [m], null if it has no return; bearings: of each beam [rad]. */
export interface Sweep {
  points: ([number, number] | null)[];
  bearings: number[];
  fullCircle: boolean;
}

/** beam: whose point is nearest to a place, null if none is near. */
export interface Near {
  beam: number | null;
}

/**
 * One threshold over its range: the number of lines at each value, and the beams in them.
 *
 * runs: at each value, the stretches of beams of one line: first, last, "#rrggbb".
 */
export interface ThresholdSweep {
  name: string;
  beams: number;
  values: number[];
  lines: number[];
  runs: [number, number, string][][];
}

/**
 * The table of a sweep. axes: values of each swept threshold; columns: measures of each row.
 *
 * file: index into `files` of each row.
 */
export interface SweepTable {
  files: string[];
  axes: Record<string, number[]>;
  measures: string[];
  file: number[];
  columns: Record<string, (number | null)[]>;
}

/** The effect of thresholds on evenly spread frames of a recording; of: total number of frames. */
export interface Sampled {
  frames: number;
  of: number;
  params: Record<string, number>;
}

/** For each threshold its values, and the value of each measure there. */
export interface SampledCurves {
  frames: number;
  of: number;
  params: Record<string, number>;
  curves: Record<string, Curve>;
}

/** heights: a row for each of ys, with the measure at each of xs, null if undefined. */
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

/** score: null if there is none. */
export interface Trial {
  number: number;
  params: Record<string, number>;
  score: number | null;
}

/** The proposed thresholds, and whether they gain anything on the held-back frames. */
export interface Verdict {
  params: Record<string, number>;
  text: string;
  gained: boolean;
}

/** A step of auto-tuning: first the objective, then trials as they finish, and sometimes the importances. */
export interface Tuned {
  text?: string;
  caution?: string;
  thresholds?: string[];
  trials?: Trial[];
  importance?: Record<string, number>;
  verdict?: Verdict;
}

/**
 * How ranges scatter. edges: of bins of the range [m]; sigma: standard deviation in each bin [m], null if unknown.
 *
 * base [m], growth: σ² = base² + (growth·ρ)² through these. bend: how much walls deviate from straight [m], null if
 * unknown.
 */
export interface Noise {
  edges: number[];
  sigma: (number | null)[];
  base: number;
  growth: number;
  bend: number | null;
}

/**
 * What fits the laser. fits: values of the thresholds that depend on its noise, none if nothing can be proposed.
 *
 * better: whether they are better than the present ones; text: a sentence that says so, or why nothing can be
 * proposed. scatter: standard deviation of points from their walls [m]; noise: null if unknown.
 */
export interface Fitted {
  method?: string;
  fits?: Record<string, number>;
  better?: boolean;
  text?: string;
  scatter?: number | null;
  noise?: Noise | null;
}

/** How long a method takes for each of some frames [µs]: mean, standard deviation, least and most. */
export interface MethodTimes {
  method: string;
  frames: number[];
  us: number[];
  mean: number;
  std: number;
  least: number;
  most: number;
}

/** machine: on which the times were measured, and when. */
export interface TimesHere {
  machine: string;
  methods: MethodTimes[];
}

/** A line that was found. start, end: of it [m]. */
export interface LineToLabel {
  first: number;
  last: number;
  start: [number, number];
  end: [number, number];
}

/** Numbers of true lines, of lines found, and of matches (Eqs. 9, 10). */
export interface Counted {
  true: number;
  found: number;
  matched: number;
}

/**
 * A frame with what was found in it. x, y: of each beam [m]; known: by the known walls, null if there are none.
 */
export interface FrameToLabel {
  frame: number;
  x: (number | null)[];
  y: (number | null)[];
  lines: LineToLabel[];
  known: Counted | null;
}

/**
 * Where someone in a class is. name: chosen by themselves, or ""; follows: whether the tab mirrors the teacher's.
 *
 * lesson: its title, "" if none is open; page, pages: from 1, 0 without a lesson; recording: its label; done:
 * number of lessons.
 */
export interface PupilPlace {
  name: string;
  follows: boolean;
  lesson: string;
  page: number;
  pages: number;
  recording: string;
  frame: number;
  done: number;
}

/** Common fields of answers of long work. done: it has ended; stopped: on request; message: why it failed. */
export interface Worked {
  type: "curves" | "map" | "auto" | "fit";
  job: number;
  done?: boolean;
  stopped?: boolean;
  message?: string;
}

/** source: the laser whose scans it reads; "" if the node is on another machine. */
export interface RunningNode {
  address: string;
  source: string;
}

/**
 * What can be reached: bridges and nodes that the user named at the start, and the user's nodes of this machine.
 */
export interface Robots {
  addresses: string[];
  nodes: RunningNode[];
}

/**
 * The lines of the map on the screen.
 *
 * ends: x1, y1, x2, y2 [m]; sigma: across, at their middle [m]; seen: lines of frames on each.
 */
export interface MapLines {
  text: string;
  ends: number[][];
  sigma: number[];
  seen: number[];
}

/** Finds a decision by its properties: the nth (from 0, or negative from the end) that matches all of them. */
export interface Find {
  kind: string;
  check: string | null;
  direction: 1 | -1 | null;
  beam: number | null;
  nth: number;
}

/**
 * A decision whose numbers texts can name. params: override those of the lesson, instead of those of the text.
 *
 * method: of this method, with its default thresholds.
 */
export interface Named {
  kind: string;
  check: string | null;
  direction: 1 | -1 | null;
  beam: number | null;
  nth: number;
  method: string | null;
  params: Record<string, number> | null;
}

/**
 * What a text looks at: near: beams whose points fill the stage where no decision is shown; none: all of them.
 * names: words for beams, written beside their points.
 *
 * show: something to try in the text: points and their fits, the noise of the recording, the times of two methods,
 * another method step by step beside the one of the lesson, or frames to label (static/learn/shown.js).
 */
export interface Looked {
  near: number[];
  names: Record<string, number>;
  show: "fits" | "noise" | "times" | "beside" | "label" | null;
}

/**
 * One text and what the page shows with it: the decision found, or the whole result.
 *
 * why: a question that the text answers. params: override those of the lesson. method: shows this method with its
 * default thresholds instead of region growing, so it cannot be combined with params.
 */
export interface Step {
  near: number[];
  names: Record<string, number>;
  show: "fits" | "noise" | "times" | "beside" | "label" | null;
  text: string;
  why: string;
  method: string | null;
  find: Find | null;
  params: Record<string, number>;
  selected: number | null;
}

/**
 * Conditions that must all hold for the task to be done.
 *
 * lines: number of lines, [least, most]. together: pairs of beams in one line; either: pairs, one of which must be
 * in one line; apart: pairs in different lines; inside, outside: beams in some line, in no line. changed: the only
 * thresholds that may differ from the lesson's; at least one must. at: kind of the shown decision. selected: beams,
 * one of which must be selected. count: number of such decisions, [least, most]. labelled: number of frames of the
 * recording whose true lines must be labelled.
 */
export interface Goal {
  lines: [number, number] | null;
  together: [number, number][];
  either: [number, number][];
  apart: [number, number][];
  inside: number[];
  outside: number[];
  changed: string[];
  at: Find | null;
  selected: number[];
  count: [Find, number, number] | null;
  labelled: number | null;
}

/** An answer to choose. why: shown when it was chosen although it is not right. */
export interface Option {
  text: string;
  right: boolean;
  why: string;
}

/**
 * A number to find out. answer: with its unit, such as "45 mm"; it may be a placeholder. within: how far off an
 * answer may be.
 */
export interface Quantity {
  answer: string;
  within: number;
}

/**
 * text: what to do; hint: shown on request; done: shown when it is done.
 *
 * goal, choice, number: exactly one of them: something to do on the page, an answer to choose, a number to find
 * out.
 */
export interface Task {
  near: number[];
  names: Record<string, number>;
  show: "fits" | "noise" | "times" | "beside" | "label" | null;
  text: string;
  hint: string;
  done: string;
  goal: Goal | null;
  choice: Option[];
  number: Quantity | null;
  params: Record<string, number>;
}

/**
 * block: of the diagram, below which it is listed. params: thresholds that differ from USUAL and the defaults;
 * knobs: thresholds that the reader may change.
 *
 * recording: `lesson:NAME` or `sample:NAME` of the program, a drawn world, or `folder:FILE`, beside the file of the
 * lesson; scan: one scan instead, as in sensor_msgs/LaserScan. decisions: those that texts name.
 */
export interface Lesson {
  title: string;
  about: string;
  block: "fit" | "seed" | "growth" | "enough" | "overlap" | "endpoints" | "segments" | "methods" | null;
  recording: string;
  scan: Record<string, unknown>;
  frame: number;
  params: Record<string, number>;
  knobs: string[];
  decisions: Record<string, Named>;
  steps: Step[];
  task: Task;
}

/**
 * A lesson with everything put in. recording: the id by which the page opens it.
 *
 * accepted: of each threshold of the task, the least and the largest value that solves it. own: whether it is not
 * one of the program's.
 */
export interface NamedLesson {
  title: string;
  about: string;
  block: "fit" | "seed" | "growth" | "enough" | "overlap" | "endpoints" | "segments" | "methods" | null;
  recording: string;
  scan: Record<string, unknown>;
  frame: number;
  params: Record<string, number>;
  knobs: string[];
  decisions: Record<string, Named>;
  steps: Step[];
  task: Task;
  id: string;
  accepted: Record<string, [number, number]>;
  own: boolean;
}

/** terms: all that texts use, explained. */
export interface Lessons {
  lessons: NamedLesson[];
  terms: ExplainedTerm[];
}

/** How a kind of shape is drawn. px: the radius of points, the width of lines; shape: of points, "" for lines. */
export interface Look {
  name: string;
  kind: "points" | "lines";
  px: number;
  shape: "circle" | "square" | "diamond" | "";
}

/** xy: x, y of points, or x1, y1, x2, y2 of lines [m]; tones: the colour of each, a number of the palette. */
export interface FlatNode {
  name: string;
  kind: "points" | "lines";
  px: number;
  shape: "circle" | "square" | "diamond" | "";
  xy: number[];
  tones: number[];
}

/** palette: "#rrggbb"; nodes: each lies over those before it. */
export interface FlatPicture {
  palette: string[];
  nodes: FlatNode[];
}

/** The view of a decision. tells: which of the names tell its outcome. */
export interface Framed {
  framing: Framing;
  tells: number[];
}

/** The lines under some thresholds. moment: its picture; segments: in the pool. */
export interface Result {
  moment: number;
  segments: number[];
}

/** The results over the range of one threshold while the others stand. */
export interface Range {
  values: number[];
  results: number[];
}

/**
 * The frame under a method and its thresholds, decision by decision.
 *
 * trace: without the points, which are in the handout; framings: of each decision; first: the picture of the first
 * decision, followed by those of the others; ranges: by threshold; why: of each beam, why it is in a line or not.
 */
export interface Stand {
  method: string;
  params: Record<string, number>;
  trace: TraceColumns;
  framings: (Framed | null)[];
  first: number;
  result: number;
  ranges: Record<string, Range>;
  why: string[];
}

/**
 * A page that stands alone: a lesson, or one frame.
 *
 * lesson: its id, or "". step: the decision to begin with, or null. box: what the whole plan shows [m]; unit: of
 * the stored coordinates [m]. x, y: of every beam [m]. light, dark: the palette. pages: the view of the whole
 * result on each page of the lesson. answers: what the page would ask the server for, by address. next, index:
 * addresses of other pages, or "".
 */
export interface Handout {
  title: string;
  recording: string;
  frame: number;
  lesson: string;
  step: number | null;
  box: [number, number, number, number];
  unit: number;
  x: (number | null)[];
  y: (number | null)[];
  light: string[];
  dark: string[];
  looks: Look[];
  methods: Record<string, unknown>[];
  stands: Stand[];
  results: Result[];
  segments: Segment[];
  pages: (Framing | null)[];
  answers: Record<string, string>;
  next: string;
  index: string;
}

/**
 * A field of the View as sent to the page; see ViewField.
 *
 * default: {} where it depends on other fields. most: of a number, or of the length of a text.
 */
export interface FieldEntry {
  name: string;
  link: string | null;
  written: "text" | "whole" | "choice" | "thresholds" | "pinned" | "numbers" | "switches" | "reading" | "switch";
  default: any;
  choices: string[];
  most: number | null;
  mirrored: boolean;
  resetBy: string[];
  lasting: boolean;
}

/** The name and meaning of a measure; truth: whether it needs true lines. */
export interface Measure {
  name: string;
  label: string;
  unit: string;
  better: "higher" | "lower" | "neither";
  truth: boolean;
  help: string;
}

/**
 * The nearest value of a threshold that changes the answer for a beam; None if no value in its range does.
 *
 * segment: the beam's segment at this value; first, last: the beams of that segment; −1 for none.
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
 * One parameter: its name, the value sent, the robot's present value (None if unset), and the robot's answer.
 *
 * taken: whether the robot now has the value that was sent.
 */
export interface Sent {
  name: string;
  threshold: string;
  value: number;
  now: unknown;
  taken: boolean;
  reason: string;
}
