"""What is answered over HTTP, and over the socket for long work."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, NotRequired

from typing_extensions import TypedDict

from lineseg.what_if import WhatIf

from .drawn import Agreement, Params, Point, Reference
from .typescript import As

Job = Literal["curves", "map", "auto"]


class WhatIfs(TypedDict):
    """What would change the answer for the selected beam, and of which answer."""

    frame: int
    beam: int | None
    method: str
    params: Params
    changes: list[WhatIf]


class Whys(TypedDict):
    """What looks wrong in the frames that were asked about, by their numbers."""

    recording: str
    method: str
    params: Params
    words: dict[int, list[str]]


class Truth(TypedDict):
    """How the whole recording agrees with its truth; stride: of so many frames one was looked at.

    labelled: stamp of the labels that are the truth, or "".
    """

    recording: str
    method: str
    params: Params
    judgedBy: Reference
    labelled: str
    agreement: Agreement
    stride: int


class Brief(TypedDict):
    """What people say of a frame, in short. lines: how many, null where nobody has said which are true."""

    revision: int
    lines: int | None
    tags: tuple[str, ...]
    note: str


class LabelsOverview(TypedDict):
    """What people say of a recording, by frame. stamp: another one whenever its file is."""

    stamp: str
    frames: dict[int, Brief]


class Sweep(TypedDict):
    """points: of each beam [m], null without a return."""

    points: list[Point | None]
    fullCircle: bool


class ThresholdSweep(TypedDict):
    """One threshold over its range, of each value how many lines there are and which beams are in them.

    runs: of each value the stretches of beams of one line: first, last, "#rrggbb".
    """

    name: str
    beams: int
    values: list[float]
    lines: list[int]
    runs: list[list[tuple[int, int, str]]]


class SweepTable(TypedDict):
    """The table of a sweep. axes: the values of each swept threshold; columns: of each row.

    file: of each row its place in files.
    """

    files: list[str]
    axes: dict[str, list[float]]
    measures: list[str]
    file: list[int]
    columns: dict[str, list[float | None]]


class Sampled(TypedDict):
    """What thresholds do to some frames of a recording, spread evenly; of: how many it has."""

    frames: int
    of: int
    params: Params


class SampledCurves(Sampled):
    """Of each threshold its values, and of each measure what it is at them."""

    curves: Mapping[str, Annotated[Mapping[str, Sequence[float | None]], As("Curve")]]


class SampledMap(Sampled):
    """heights: a row for each of ys; of each of xs what the measure is, null where it is not defined."""

    x: str
    y: str
    measure: str
    xs: Sequence[float]
    ys: Sequence[float]
    heights: list[list[float | None]]


class Trial(TypedDict):
    """score: null where there is none."""

    number: int
    params: Params
    score: float | None


class Verdict(TypedDict):
    """The thresholds that are proposed, and whether they gain anything on frames that were held back."""

    params: Params
    text: str
    gained: bool


class Tuned(TypedDict, total=False):
    """A step of auto-tuning: at first what is looked for, then trials as they come, now and then what matters."""

    text: str
    caution: str
    thresholds: list[str]
    study: str
    trials: list[Trial]
    importance: dict[str, float]
    verdict: Verdict


class Worked(TypedDict):
    """What every answer of long work has. done: it has ended; stopped: because somebody said so; message: why not."""

    type: Job
    job: int
    done: NotRequired[bool]
    stopped: NotRequired[bool]
    message: NotRequired[str]
