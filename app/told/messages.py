"""The messages from the server on /api/session."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
import numpy as np
from pydantic import BaseModel, Field, GetPydanticSchema
from pydantic_core import core_schema

from lineseg import Extractor, Knob
from lineseg.readers.reading import Reading, ReadingField

from .drawn import DrawnState, TraceColumns

Where = Literal["recording", "params", "frame", "view", "upload", "server"]
Connection = Literal["connecting", "open", "lost"]

# Not validated here, because it is sent many times a second; a test checks it.
UNCHECKED = GetPydanticSchema(lambda source, handler: core_schema.any_schema())


class RecordingEntry(BaseModel):
    """A recording in the menu; `missing` if its file no longer exists. reading: how it was last read."""

    id: str
    label: str
    group: Literal["Live", "Samples", "Lessons", "Recent", "Uploads", "Command line", "Drawn"]
    missing: bool = False
    reading: dict[str, str | int | float] = {}


class KnobEntry(BaseModel):
    """A threshold: its name and its bounds. low, high, step: of its slider; least, most: allowed range, and why."""

    name: str
    kind: Literal["float", "int", "bool"]
    symbol: str
    label: str
    unit: str
    low: float
    high: float
    step: float
    log: bool
    least: float
    most: float
    why: str
    help: str
    extension: bool
    counted: str
    floor: bool
    default: float

    @classmethod
    def of(cls, name: str, kind: type, knob: Knob, default: float) -> KnobEntry:
        return cls(
            name=name,
            kind=kind.__name__,  # type: ignore[arg-type]
            symbol=knob.symbol,
            label=knob.label,
            unit=knob.unit,
            low=knob.low,
            high=knob.high,
            step=knob.step,
            log=knob.log,
            least=knob.least,
            most=knob.most,
            why=knob.why,
            help=knob.help,
            extension=knob.extension,
            counted=knob.counted,
            floor=knob.floor,
            default=default,
        )


class MethodEntry(BaseModel):
    """begins: how a line of the method starts, in a word; ros: whether a ROS program has its thresholds."""

    name: str
    label: str
    citation: str
    begins: str
    ros: bool
    knobs: list[KnobEntry]

    @classmethod
    def of(cls, method: Extractor) -> MethodEntry:
        values = method.params_type().numbers()
        knobs = [KnobEntry.of(name, kind, knob, values[name]) for name, kind, knob in method.params_type.knobs()]
        ros = any(knob.ros for _, _, knob in method.params_type.knobs())
        texts = {name: getattr(method, name) for name in ("name", "label", "citation", "begins")}
        return cls(**texts, ros=ros, knobs=knobs)


class ReadingEntry(BaseModel):
    """A field of the Reading. choices: allowed values, [] for any; only: formats that have it, [] for all."""

    name: str
    kind: Literal["str", "int", "float"]
    label: str
    help: str
    group: Literal["scans", "numbers", "left out"]
    unit: str
    form: str
    choices: list[str]
    only: list[str]

    @classmethod
    def all(cls) -> list[ReadingEntry]:
        return [cls.of(name, entry) for name, entry in Reading.declared().items()]

    @classmethod
    def of(cls, name: str, entry: ReadingField) -> ReadingEntry:
        choices = list(Reading.choices(name))
        return cls(
            name=name,
            kind="str" if choices else Reading.type_of(name).__name__,
            label=entry.label,
            help=entry.help,
            group=entry.group,
            unit=entry.unit,
            form=entry.metavar,
            choices=choices,
            only=list(entry.only),
        )


class ScoreEntry(BaseModel):
    """A score of the strip. least: smallest difference that matters; weight: default weight in the suspicion."""

    name: str
    label: str
    unit: str
    help: str
    worse: Literal["higher", "lower"]
    least: float
    weight: float


class Welcome(BaseModel):
    """The answer to hello. viser: address of the scene; presenter: id with which others may follow this tab.

    suffixes: those by which a recording is known among other files.
    """

    type: Literal["welcome"] = "welcome"
    session: str
    resumed: bool
    viser: str
    version: str
    methods: list[MethodEntry]
    scores: list[ScoreEntry]
    reading: list[ReadingEntry]
    recordings: list[RecordingEntry]
    uploadLimit: int
    suffixes: list[str]
    presenter: str


class Recordings(BaseModel):
    """All recordings in the menu, sent when the list changes."""

    type: Literal["recordings"] = "recordings"
    recordings: list[RecordingEntry]


class Loading(BaseModel):
    """A recording is being read; note: why it takes long; behind: whether its first scans are shown already."""

    type: Literal["loading"] = "loading"
    recording: str
    label: str
    done: int
    total: int
    note: str = ""
    behind: bool = False


class LiveStatus(BaseModel):
    """Status of a live source, sent while a tab shows it, at most a few times a second.

    rate: scans per second; delay: of the last scan, from its stamp to its arrival [s]. total: scans since the source
    began; the newest `most` are kept; refused: messages that were not scans; notDrawn: scans that this tab passed over,
    because newer ones had arrived. publisher: the tab whose segments go back to the robot, if any.
    """

    type: Literal["live"] = "live"
    recording: str
    connection: Connection
    message: str
    rate: float
    delay: float | None
    total: int
    dropped: int
    refused: int
    notDrawn: int
    most: int
    publishable: bool
    publisher: Literal["", "this", "another"]
    publishTopic: str
    published: int
    publishTrouble: str


class Refused(BaseModel):
    """A recording that could not be opened as it was to be read. named: fields of the Reading in the message."""

    recording: str
    label: str
    topic: str | None
    reading: dict[str, str | int | float]
    named: list[str]


class Failure(BaseModel):
    """A failed request, and why; rev: of the change that caused it, if any. refused: the recording, if it is one."""

    type: Literal["error"] = "error"
    where: Where
    message: str
    rev: int | None = None
    refused: Refused | None = None


def _plain(value: object) -> object:
    """Numbers of numpy, which readers find in files, as Python's."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no JSON")


class Quick(BaseModel):
    """A message that is sent many times a second."""

    def as_json(self) -> str:
        """Much faster than pydantic's, which asks the type of everything."""
        return msgspec.json.encode(vars(self), enc_hook=_plain).decode()


class Traced(Quick):
    """All decisions of the frame in the next `drawn` message."""

    type: Literal["trace"] = "trace"
    trace: Annotated[TraceColumns, UNCHECKED]


class Times(BaseModel):
    """When each frame of a recording was taken, sent before its first picture.

    since: time since the first scan of the file [s]; null if the stamps cannot be believed, and why, in a few words.
    """

    type: Literal["times"] = "times"
    place: str
    since: list[float] | None
    why: str


class Drawn(Quick):
    """origin: the source of the input: "page", or "scene" for viser's sliders and clicks in the scene."""

    type: Literal["drawn"] = "drawn"
    rev: int
    origin: Literal["page", "scene"]
    state: Annotated[DrawnState, UNCHECKED]


class Surveyed(BaseModel):
    """The scores of every stride-th frame under these thresholds, or a message why there are none.

    Sent as one binary frame: the length of the head (uint32); the head in JSON, padded with spaces to a multiple of 4
    bytes; and `values`: float32, score after score in the order of Welcome.scores, each with ⌈frames / stride⌉ frames.
    All little-endian. The last score, the differences from A, and the totals of every fate are present only if there is
    an A and every frame is known. place, first, every: as in the state.
    """

    type: Literal["survey"] = "survey"
    rev: int
    recording: str
    place: str
    method: str
    params: dict[str, int | float]
    frames: int
    first: int = 0
    every: int = 1
    stride: int
    message: str | None
    totals: dict[str, int] | None = None
    values: bytes = Field(exclude=True)

    def as_bytes(self) -> bytes:
        head = self.model_dump_json().encode()
        head += b" " * (-len(head) % 4)
        return len(head).to_bytes(4, "little") + head + self.values
