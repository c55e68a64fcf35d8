"""What a page that stands alone holds (app/handout), and a Picture for a 2D canvas."""

from __future__ import annotations

from typing import Any, Literal

from typing_extensions import TypedDict

from .drawn import Box, Framing, Params, Segment, TraceColumns


class Look(TypedDict):
    """How a kind of shape is drawn. px: the radius of points, the width of lines; shape: of points, "" for lines."""

    name: str
    kind: Literal["points", "lines"]
    px: float
    shape: Literal["circle", "square", "diamond", ""]


class FlatNode(Look):
    """xy: x, y of points, or x1, y1, x2, y2 of lines [m]; tones: the colour of each, a number of the palette."""

    xy: list[float]
    tones: list[int]


class FlatPicture(TypedDict):
    """palette: "#rrggbb"; nodes: each lies over those before it."""

    palette: list[str]
    nodes: list[FlatNode]


class Framed(TypedDict):
    """The view of a decision. tells: which of the names tell its outcome."""

    framing: Framing
    tells: list[int]


class Result(TypedDict):
    """The lines under some thresholds. moment: its picture; segments: in the pool."""

    moment: int
    segments: list[int]


class Range(TypedDict):
    """The results over the range of one threshold while the others stand."""

    values: list[float]
    results: list[int]


class Stand(TypedDict):
    """The frame under a method and its thresholds, decision by decision.

    trace: without the points, which are in the handout; framings: of each decision; first: the picture of the first
    decision, followed by those of the others; ranges: by threshold; why: of each beam, why it is in a line or not.
    """

    method: str
    params: Params
    trace: TraceColumns
    framings: list[Framed | None]
    first: int
    result: int
    ranges: dict[str, Range]
    why: list[str]


class Handout(TypedDict):
    """A page that stands alone: a lesson, or one frame.

    lesson: its id, or "". step: the decision to begin with, or null. box: what the whole plan shows [m]; unit: of the
    stored coordinates [m]. x, y: of every beam [m]. light, dark: the palette.
    pages: the view of the whole result on each page of the lesson. answers: what the page would ask the server for, by
    address. next, index: addresses of other pages, or "".
    """

    title: str
    recording: str
    frame: int
    lesson: str
    step: int | None
    box: Box
    unit: float
    x: list[float | None]
    y: list[float | None]
    light: list[str]
    dark: list[str]
    looks: list[Look]
    methods: list[dict[str, Any]]
    stands: list[Stand]
    results: list[Result]
    segments: list[Segment]
    pages: list[Framing | None]
    answers: dict[str, str]
    next: str
    index: str
