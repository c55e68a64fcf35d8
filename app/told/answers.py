"""Answers over HTTP, and over the socket for long work."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, NotRequired

from typing_extensions import TypedDict

from lineseg.what_if import WhatIf

from .drawn import Account, Agreement, Params, Point, Reference
from .typescript import As
from .words import Words

Job = Literal["curves", "map", "auto", "fit"]


class ExplainedTerm(TypedDict):
    """A term or symbol. forms: how texts write it; equation: of the paper, lesson: the id of one about it, or ""."""

    name: str
    text: str
    forms: tuple[str, ...]
    equation: str
    lesson: str


class WhatIfs(TypedDict):
    """The threshold changes that would change the answer for the selected beam, and that answer."""

    frame: int
    beam: int | None
    method: str
    params: Params
    changes: list[WhatIf]


class Judgement(TypedDict):
    """The segments of the frame compared with its true lines; null if these are not known.

    byViews: whether many views agree on these.
    """

    frame: int
    method: str
    params: Params
    agreement: Agreement | None
    byViews: bool


class Otherwise(TypedDict):
    """Values of thresholds with which two beams would be parted or joined; first, last: of their line then, or −1."""

    values: Params
    words: Words
    first: int
    last: int


class Apart(TypedDict):
    """Why two beams are in one line or in two; one, other: their segments, or −1."""

    frame: int
    selected: int
    beside: int
    method: str
    params: Params
    together: bool
    one: int
    other: int
    words: Words
    changes: list[Otherwise]


class Finding(TypedDict):
    """One thing that looks wrong in a frame. first, last: the beams concerned, or −1; ghosts: lines that it lacks."""

    score: str
    words: Words
    first: int
    last: int
    ghosts: list[tuple[float, float, float, float]]


class Whys(TypedDict):
    """What looks wrong in the requested frames, by frame number. whole: not given up because other thresholds came."""

    place: str
    method: str
    params: Params
    found: dict[int, list[Finding]]
    whole: bool


class Truth(TypedDict):
    """The agreement of the whole recording with its truth; stride: every stride-th frame was judged.

    labelled: stamp of the labels used as truth, or "".
    """

    recording: str
    method: str
    params: Params
    judgedBy: Reference
    labelled: str
    agreement: Agreement
    stride: int


class Previewed(TypedDict):
    """A recording under a Reading that someone tries. job: of the wish.

    message: why it cannot be read in this way, and `named`: the fields that it names. choices: values to choose from,
    by field, which the file has. lines: the first of a text file. scans: the points of the first scans [m]. whole:
    whether all of the file was read.
    """

    job: int
    message: str | None
    named: list[str]
    format: str
    choices: dict[str, list[str]]
    lines: list[str]
    account: Account | None
    scans: list[list[Point]]
    whole: bool


class Brief(TypedDict):
    """Summary of the labels of a frame. lines: number of true lines, null if they are not labelled."""

    revision: int
    lines: int | None
    tags: tuple[str, ...]
    note: str


class LabelsOverview(TypedDict):
    """The labels of a recording, by frame. stamp: changes with the file."""

    stamp: str
    frames: dict[int, Brief]


class Sweep(TypedDict):
    """points: of each beam [m], null if it has no return; bearings: of each beam [rad]."""

    points: list[Point | None]
    bearings: list[float]
    fullCircle: bool


class Near(TypedDict):
    """beam: whose point is nearest to a place, null if none is near."""

    beam: int | None


class ThresholdSweep(TypedDict):
    """One threshold over its range: the number of lines at each value, and the beams in them.

    runs: at each value, the stretches of beams of one line: first, last, "#rrggbb".
    """

    name: str
    beams: int
    values: list[float]
    lines: list[int]
    runs: list[list[tuple[int, int, str]]]


class SweepTable(TypedDict):
    """The table of a sweep. axes: values of each swept threshold; columns: measures of each row.

    file: index into `files` of each row.
    """

    files: list[str]
    axes: dict[str, list[float]]
    measures: list[str]
    file: list[int]
    columns: dict[str, list[float | None]]


class Sampled(TypedDict):
    """The effect of thresholds on evenly spread frames of a recording; of: total number of frames."""

    frames: int
    of: int
    params: Params


class SampledCurves(Sampled):
    """For each threshold its values, and the value of each measure there."""

    curves: Mapping[str, Annotated[Mapping[str, Sequence[float | None]], As("Curve")]]


class SampledMap(Sampled):
    """heights: a row for each of ys, with the measure at each of xs, null if undefined."""

    x: str
    y: str
    measure: str
    xs: Sequence[float]
    ys: Sequence[float]
    heights: list[list[float | None]]


class Trial(TypedDict):
    """score: null if there is none."""

    number: int
    params: Params
    score: float | None


class Verdict(TypedDict):
    """The proposed thresholds, and whether they gain anything on the held-back frames."""

    params: Params
    text: str
    gained: bool


class Tuned(TypedDict, total=False):
    """A step of auto-tuning: first the objective, then trials as they finish, and sometimes the importances."""

    text: str
    caution: str
    thresholds: list[str]
    trials: list[Trial]
    importance: dict[str, float]
    verdict: Verdict


class Noise(TypedDict):
    """How ranges scatter. edges: of bins of the range [m]; sigma: standard deviation in each bin [m], null if unknown.

    base [m], growth: σ² = base² + (growth·ρ)² through these. bend: how much walls deviate from straight [m], null
    if unknown.
    """

    edges: list[float]
    sigma: list[float | None]
    base: float
    growth: float
    bend: float | None


class Fitted(TypedDict, total=False):
    """What fits the laser. fits: values of the thresholds that depend on its noise, none if nothing can be proposed.

    better: whether they are better than the present ones; text: a sentence that says so, or why nothing can be
    proposed. scatter: standard deviation of points from their walls [m]; noise: null if unknown.
    """

    method: str
    fits: Params
    better: bool
    text: str
    scatter: float | None
    noise: Noise | None


class MethodTimes(TypedDict):
    """How long a method takes for each of some frames [µs]: mean, standard deviation, least and most."""

    method: str
    frames: list[int]
    us: list[float]
    mean: float
    std: float
    least: float
    most: float


class TimesHere(TypedDict):
    """machine: on which the times were measured, and when."""

    machine: str
    methods: list[MethodTimes]


class LineToLabel(TypedDict):
    """A line that was found. start, end: of it [m]."""

    first: int
    last: int
    start: Point
    end: Point


class Counted(TypedDict):
    """Numbers of true lines, of lines found, and of matches (Eqs. 9, 10)."""

    true: int
    found: int
    matched: int


class FrameToLabel(TypedDict):
    """A frame with what was found in it. x, y: of each beam [m]; known: by the known walls, null if there are none."""

    frame: int
    x: list[float | None]
    y: list[float | None]
    lines: list[LineToLabel]
    known: Counted | None


class PupilPlace(TypedDict):
    """Where someone in a class is. name: chosen by themselves, or ""; follows: whether the tab mirrors the teacher's.

    lesson: its title, "" if none is open; page, pages: from 1, 0 without a lesson; recording: its label; done: number
    of lessons.
    """

    name: str
    follows: bool
    lesson: str
    page: int
    pages: int
    recording: str
    frame: int
    done: int


class Worked(TypedDict):
    """Common fields of answers of long work. done: it has ended; stopped: on request; message: why it failed."""

    type: Job
    job: int
    done: NotRequired[bool]
    stopped: NotRequired[bool]
    message: NotRequired[str]


class RunningNode(TypedDict):
    """source: the laser whose scans it reads; "" if the node is on another machine."""

    address: str
    source: str


class Robots(TypedDict):
    """What can be reached: bridges and nodes that the user named at the start, and the user's nodes of this machine."""

    addresses: list[str]
    nodes: list[RunningNode]


class MapLines(TypedDict):
    """The lines of the map on the screen.

    ends: x1, y1, x2, y2 [m]; sigma: across, at their middle [m]; seen: lines of frames on each.
    """

    text: str
    ends: list[list[float]]
    sigma: list[float]
    seen: list[int]
