"""The drawn state and the decisions of its frame, as dictionaries because they are sent many times a second."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NotRequired

# pydantic accepts the TypedDict of the standard library from Python 3.12 on only.
from typing_extensions import TypedDict

from .typescript import As
from .words import Words

Point = tuple[float, float]
# a, b, c of the line ax + by + c = 0
Line = tuple[float, float, float]
Box = tuple[float, float, float, float]
Params = dict[str, int | float]
Reading = dict[str, str | int | float]
Reference = Literal["labels", "wall"]
Presence = Literal["here", "away", "gone"]


class Topic(TypedDict):
    """A stream of scans in the recording."""

    name: str
    scans: int


class Pack(TypedDict):
    """The origin of a failure pack's frame, counted from 0, and how it was viewed."""

    recording: str
    frame: int
    method: str
    params: Params
    note: str


class Segment(TypedDict):
    """first, last: its beams. rms: root mean square distance of its points [m]. colour: "#rrggbb"."""

    start: Point
    end: Point
    first: int
    last: int
    line: Line
    points: int
    length: float
    rms: float
    colour: str


class Dropped(TypedDict):
    """A dropped line; check: the threshold that it missed; start, end: its outermost points [m].

    beam: to ask about it, in no segment if possible.
    """

    start: Point
    end: Point
    beam: int
    first: int
    last: int
    points: int
    length: float
    check: str
    text: str


class Decision(TypedDict):
    """The decision that the replay shows; value, limit: the compared numbers, null if not finite.

    words: its sentence in parts.
    """

    index: int
    kind: str
    phase: str
    text: str
    words: Words
    beam: int
    first: int
    last: int
    check: str
    direction: int
    points: int
    candidate: int
    value: float | None
    limit: float | None
    line: tuple[float | None, float | None, float | None]


class Explanation(TypedDict):
    """The explanation of the selected beam. words: its sentence in parts; at: its point [m]; segment: or −1."""

    beam: int
    text: str
    words: Words
    segment: int
    check: str
    value: float | None
    limit: float | None
    margin: float | None
    at: Annotated[list[float] | None, As("Point | null")]


class Histogram(TypedDict):
    """Histogram, from low to high, of the quantity that a threshold limits."""

    low: float
    high: float
    log: bool
    passed: tuple[int, ...]
    failed: tuple[int, ...]


class Agreement(TypedDict):
    """Segments compared with true lines: the numbers of the paper's Table 4 and more; null if undefined."""

    trueLines: float | None
    segments: float | None
    matches: float | None
    trueRate: float | None
    falseRate: float | None
    neutral: float | None
    neutralFalseRate: float | None
    completeness: float | None
    splits: float | None
    merges: float | None
    endpointMedian: float | None
    endpointMost: float | None


class TrueLine(TypedDict):
    """A labelled true line: its beams and its ends [m]."""

    first: int
    last: int
    start: Point
    end: Point


class Labelled(TypedDict):
    """The labels of a frame. lines: null if its true lines are not labelled; revision: number of saves."""

    revision: int
    lines: list[TrueLine] | None
    tags: tuple[str, ...]
    note: str


class Labels(Labelled):
    """The labels of the frame on the screen, and where they are kept.

    apart: whether that is the user's data folder, not the folder of the recording. stamp: changes with the file;
    trouble: why the file cannot be read, or "".
    """

    file: str
    folder: str
    apart: bool
    stamp: str
    trouble: str


class Guess(TypedDict):
    """Something that the file does not say. change: other values of the Reading to try."""

    field: str
    value: str
    why: str
    change: Reading


class Notice(TypedDict):
    """Something odd about the file. change: of the Reading, that would mend it; {} if none would."""

    kind: str
    text: str
    change: Reading


class Account(TypedDict):
    """What a file was taken for.

    line: one line that says it; used: the Reading with all that was found or guessed. skipped: a sentence about scans
    that could not be read, or "". believable: whether the stamps can be believed.
    """

    line: str
    used: Reading
    guesses: list[Guess]
    notices: list[Notice]
    skipped: str
    believable: bool


class Named(TypedDict):
    """A name at a place of the scan [m]."""

    text: str
    at: Point


class Measured(TypedDict):
    """A distance between two places [m]. beside: drawn beside them."""

    text: str
    start: Point
    end: Point
    beside: bool


class Framing(TypedDict):
    """The part of the plan that shows a decision.

    box: as drawn [m]. factor: distances along the unit vector `normal` are drawn so many times as long, about `at`.
    """

    box: Box
    factor: int
    normal: Point
    at: Point
    names: list[Named]
    measures: list[Measured]


class Beside(TypedDict):
    """Another laser of the robot. why: why its scan is not shown, "" if it is, null while it is being read."""

    topic: str
    colour: str
    why: str | None


class World(TypedDict):
    """The laser in the world. pose: x, y [m] and heading [rad], null if it is not known at this frame.

    upsideDown: whether its beams turn clockwise seen from above. map: what is said of the line map, "" while it is made
    and if it is not shown; mapPercent: how much of it is made. lasers: the others of the robot, none if not shown.
    """

    pose: list[float] | None
    upsideDown: bool
    map: str
    mapPercent: int
    lasers: list[Beside]


class OfView(TypedDict):
    """What the View says, by itself for the parts of the page that need little of it.

    view: the whole View, as a patch that restores it. frame: its number in the file or source, counted from 0.
    """

    view: Annotated[dict[str, Any], As("View")]
    mode: Annotated[str, As('View["mode"]')]
    frame: int
    method: str
    params: Params
    step: int | None
    layers: dict[str, bool]
    selected: int | None
    camera: Annotated[str, As('View["camera"]')]
    score: str
    against: Annotated[dict[str, Any] | None, As("Against | null")]
    weights: dict[str, float]
    reference: Annotated[str, As("Reference")]


class OfRecording(TypedDict):
    """The recording on the screen.

    pack: description in a failure pack. place: equal for states of the same scans. readAs: the Reading that was asked
    for, with the topic. account: what the file was taken for, null if there is no file. live: whether the newest frame
    is followed, null if the recording is not live. frames: how many there are, of which the first has the number
    `first`, the next `first + every`; growing: whether more of them are being read. mayHavePoses: whether poses were or
    can be looked for; poses: what is said of them, "" if nobody asked. truth: whether the recording has its true walls;
    byViews: what is said of walls that many views agree on, "" for others.
    """

    recording: str
    label: str
    format: str
    pack: Pack | None
    topic: str
    topics: list[Topic]
    place: str
    readAs: Reading
    account: Account | None
    frames: int
    live: bool | None
    first: int
    every: int
    growing: bool
    mayHavePoses: bool
    poses: str
    truth: bool
    byViews: str


class Scene(OfView, OfRecording):
    """What is on the screen.

    stamp: of the scan [s]; since: time since the first scan of the file [s], null if the stamps cannot be believed.
    covered: number of `valid` beams in segments. steps: number of decisions. difference: fates of the lines of A.
    agreement: in the mode Inspect if the truth is known; labels: in the mode Inspect if the recording can have labels.
    framing: of the decision on the screen, ahead: of the next one without its outcome; null where the whole plan is
    shown. nodes: what the scene shows. references: available references; judgedBy: the one in use, "" without truth.
    world: null if the scene shows the frame of the laser. extent: box around the points of the frame, bounds: of what
    the scene shows [m].
    extractionUs: time of the extraction [µs].
    """

    stamp: float | None
    since: float | None
    frameId: str
    beams: int
    valid: int
    covered: int
    steps: int
    difference: dict[str, int] | None
    extent: Box
    bounds: Box
    segments: list[Segment]
    dropped: list[Dropped]
    decision: Decision | None
    framing: Framing | None
    ahead: Framing | None
    nodes: list[str]
    world: World | None
    explanation: Explanation | None
    histograms: dict[str, Histogram]
    agreement: Agreement | None
    labels: Labels | None
    references: list[Reference]
    judgedBy: Reference | Literal[""]
    extractionUs: float


class Timings(TypedDict):
    """Time to make the picture, and to pass it to viser [ms]."""

    pictureMs: float
    drawMs: float


class DrawnState(Scene, Timings):
    """The drawn state.

    marks: decisions at which the replay may pause, sent if the trace differs from the last message. following: the
    presenter that this tab mirrors.
    """

    marks: NotRequired[dict[str, list[int]]]
    following: Presence | None


class Starts(TypedDict):
    """Indices of the decisions at which each phase and each line starts."""

    phase: list[int]
    line: list[int]


class TraceColumns(TypedDict):
    """The decisions of a frame as columns, one entry each, and the points they refer to.

    kinds, checks, phases: names of the numbers in the columns kind, check, phase. first, last, beam: beams, −1 if none.
    text: the sentence of each. points: number of points from first to last. jumps: indices for each jump of the method.
    total: number of all decisions; the columns hold the first ones. a, b, c: of the line; others, ends: by index, for
    the few decisions that have them: (a, b, c) of the partner's line, (x1, y1, x2, y2) of the endpoints. x, y: of
    every beam [m], null if it has no return. circle: whether the scan is a full circle.
    """

    kinds: tuple[str, ...]
    checks: tuple[str, ...]
    phases: tuple[str, ...]
    jumps: dict[str, list[int]]
    starts: Starts
    total: int
    circle: bool
    kind: list[int]
    check: list[int]
    phase: list[int]
    direction: list[int]
    candidate: list[int]
    first: list[int]
    last: list[int]
    beam: list[int]
    points: list[int]
    a: list[float | None]
    b: list[float | None]
    c: list[float | None]
    others: dict[int, Line]
    ends: dict[int, tuple[float, float, float, float]]
    value: list[float | None]
    limit: list[float | None]
    text: list[str]
    x: list[float | None]
    y: list[float | None]
