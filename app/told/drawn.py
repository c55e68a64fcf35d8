"""The state that was drawn, and the decisions of its frame: dictionaries, because they are sent many times a second."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NotRequired

# Of the standard library, pydantic takes that of Python 3.12 and later only.
from typing_extensions import TypedDict

from .typescript import As

Point = tuple[float, float]
# a, b, c of the line ax + by + c = 0
Line = tuple[float, float, float]
Box = tuple[float, float, float, float]
Params = dict[str, int | float]
Reference = Literal["labels", "wall"]
Presence = Literal["here", "away", "gone"]


class Topic(TypedDict):
    """A stream of scans in the recording."""

    name: str
    scans: int


class Pack(TypedDict):
    """Where the frame of a failure pack came from, counted from 0, and how it was looked at."""

    recording: str
    frame: int
    method: str
    params: Params
    note: str


class Segment(TypedDict):
    """first, last: its beams. rms: of the distances of its points [m]."""

    start: Point
    end: Point
    first: int
    last: int
    line: Line
    points: int
    length: float
    rms: float


class Dropped(TypedDict):
    """A line that was not kept; check: the threshold that it falls short of."""

    first: int
    last: int
    points: int
    length: float
    check: str
    text: str


class Decision(TypedDict):
    """The decision that the replay shows; value, limit: what was compared, null where it is no finite number."""

    index: int
    kind: str
    phase: str
    text: str
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
    """What became of the selected beam. at: its point [m]; segment: that of the beam, −1 without one."""

    beam: int
    text: str
    segment: int
    check: str
    value: float | None
    limit: float | None
    margin: float | None
    at: Annotated[list[float] | None, As("Point | null")]


class Histogram(TypedDict):
    """How often the quantity that a threshold cuts had which value, from low to high."""

    low: float
    high: float
    log: bool
    passed: tuple[int, ...]
    failed: tuple[int, ...]


class Agreement(TypedDict):
    """Segments against true lines: the numbers of the paper's Table 4 and more; null where one is not defined."""

    trueLines: float | None
    segments: float | None
    matches: float | None
    trueRate: float | None
    falseRate: float | None
    completeness: float | None
    splits: float | None
    merges: float | None
    endpointMedian: float | None
    endpointMost: float | None


class TrueLine(TypedDict):
    """A line that is there, as people say: its beams and its ends [m]."""

    first: int
    last: int
    start: Point
    end: Point


class Labelled(TypedDict):
    """What people say of a frame. lines: null where nobody has said which are true; revision: counts the savings."""

    revision: int
    lines: list[TrueLine] | None
    tags: tuple[str, ...]
    note: str


class Labels(Labelled):
    """What people say of the frame on the screen, and where it is kept.

    apart: whether that is the user's data folder, not the folder of the recording. stamp: another one whenever the file
    is; trouble: why the file cannot be read, or "".
    """

    file: str
    folder: str
    apart: bool
    stamp: str
    trouble: str


class Scene(TypedDict):
    """What is on the screen.

    view: all of it, as a patch that leads back to it. label: of the recording; pack: of a failure pack, what it says.
    topic: the one on the screen. live: whether the
    newest frame is followed, null of a recording that is not live; first: number of the first frame, of a live
    recording the oldest are gone. stamp: time since the first scan [s]. covered: how many of the `valid` beams are in
    segments. steps: decisions that there are. difference: what became of the lines of A. truth: the recording knows its
    walls. agreement: in the mode Inspect, where the truth is known; labels: there, of a recording that can have some.
    references: by what segments can be judged; judgedBy: by what they are, "" without truth. extent: box around the
    points of the frame, bounds: of the recording [m]. extractionUs: time of the extraction [µs].
    """

    view: Annotated[dict[str, Any], As("View")]
    mode: Annotated[str, As('View["mode"]')]
    recording: str
    label: str
    format: str
    pack: Pack | None
    topic: str
    topics: list[Topic]
    frame: int
    frames: int
    live: bool | None
    first: int
    stamp: float | None
    frameId: str
    beams: int
    valid: int
    covered: int
    method: str
    params: Params
    step: int | None
    steps: int
    layers: dict[str, bool]
    selected: int | None
    camera: Annotated[str, As('View["camera"]')]
    score: str
    against: Annotated[dict[str, Any] | None, As("Against | null")]
    weights: dict[str, float]
    difference: dict[str, int] | None
    extent: Box
    bounds: Box
    segments: list[Segment]
    dropped: list[Dropped]
    decision: Decision | None
    explanation: Explanation | None
    histograms: dict[str, Histogram]
    truth: bool
    agreement: Agreement | None
    labels: Labels | None
    reference: Annotated[str, As("Reference")]
    references: list[Reference]
    judgedBy: Reference | Literal[""]
    extractionUs: float


class Timings(TypedDict):
    """How long it took to make the picture, and to hand it to viser [ms]."""

    pictureMs: float
    drawMs: float


class DrawnState(Scene, Timings):
    """The state that was drawn.

    marks: decisions at which replay may halt, if the trace is another than that of the last message. following: the
    presenter that this tab mirrors.
    """

    marks: NotRequired[dict[str, list[int]]]
    following: Presence | None


class Starts(TypedDict):
    """Indices of decisions at which each phase and each line begins."""

    phase: list[int]
    line: list[int]


class TraceColumns(TypedDict):
    """The decisions of a frame as columns, one entry each, and the points they speak of.

    kinds, checks, phases: names of the numbers in the columns kind, check, phase. first, last, beam: beams, −1 none.
    text: the sentence of each. points: how many points lie from first to last. jumps: indices to which each jump of the
    method leads. total: decisions that there are, of which the columns hold the first. a, b, c: of the line; others,
    ends: of the few decisions that have them, by index: (a, b, c) of the partner's line, (x1, y1, x2, y2) of the
    endpoints. x, y: of every beam [m], null where it has no return. circle: whether the scan is a full circle.
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
