"""What crosses the network: the messages of /api/session and their bounds."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from lineseg import Extraction, Extractor, Knob, Recording

Name = Annotated[str, Field(max_length=300)]
# The id of a drawn world holds all of its walls.
RecordingId = Annotated[str, Field(max_length=8000)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Where = Literal["recording", "params", "frame", "view", "upload", "server"]
Connection = Literal["connecting", "open", "lost"]
Count = Annotated[int, Field(ge=0, le=2**31)]


class Message(BaseModel):
    """Unknown fields are refused: a misspelt name must not pass silently."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Pinned(Message):
    method: Name
    params: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}


class ViewPatch(Message):
    """Some fields of a View; those that were not sent stay as they are."""

    recording: RecordingId = ""
    topic: Name | None = None
    frame: Count = 0
    method: Name = ""
    params: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}
    step: Count | None = None
    layers: Annotated[dict[Name, bool], Field(max_length=64)] = {}
    selected: Count | None = None
    camera: Literal["plan", "free"] = "plan"
    dark: bool = False
    mode: Literal["tune", "learn", "inspect"] = "tune"
    score: Name = ""
    against: Pinned | None = None
    weights: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}
    reference: Literal["labels", "wall"] = "labels"
    live: bool = True

    def changes(self) -> dict[str, Any]:
        return self.model_dump(exclude_unset=True)


class Hello(Message):
    """The first message: which session to take up again, if it is still there, and what to look at."""

    type: Literal["hello"]
    session: Annotated[str, Field(max_length=64)] | None = None
    view: ViewPatch | None = None
    rev: Count | None = None
    follow: Annotated[str, Field(max_length=64)] | None = None


class Change(Message):
    type: Literal["view"]
    rev: Count
    patch: ViewPatch


class Cancel(Message):
    type: Literal["cancel"]


class Close(Message):
    type: Literal["close"]


class Follow(Message):
    """Mirror the tab that shows itself under this id; null: no more."""

    type: Literal["follow"]
    id: Annotated[str, Field(max_length=64)] | None


Incoming = Annotated[Hello | Change | Cancel | Close | Follow, Field(discriminator="type")]
_INCOMING: TypeAdapter[Hello | Change | Cancel | Close | Follow] = TypeAdapter(Incoming)
LONGEST_MESSAGE = 64 * 1024


class BadMessageError(ValueError):
    """A message that cannot be taken; `where` and `rev` as in Failure."""

    def __init__(self, sentence: str, where: Where = "view", rev: int | None = None) -> None:
        super().__init__(sentence)
        self.where: Where = where
        self.rev = rev


def parse(text: str) -> Hello | Change | Cancel | Close | Follow:
    """A message of the page; BadMessageError with one sentence if it is none."""
    if len(text) > LONGEST_MESSAGE:
        raise BadMessageError(f"a message of {len(text)} characters; {LONGEST_MESSAGE} are the most")
    try:
        return _INCOMING.validate_json(text)
    except ValidationError as error:
        where = "params" if "params" in error.errors()[0]["loc"] else "view"
        raise BadMessageError(sentence(error), where, _rev_of(text)) from None


def _rev_of(text: str) -> int | None:
    """The revision of a message that is bad elsewhere, so that the page learns which of its changes failed."""
    try:
        rev = json.loads(text)["rev"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return rev if type(rev) is int and 0 <= rev <= 2**31 else None


def sentence(error: ValidationError) -> str:
    """The first complaint of a validation, with its place and what was found."""
    first = error.errors(include_url=False, include_context=False)[0]
    place = ".".join(str(part) for part in first["loc"]) or "the message"
    found = repr(first["input"])
    shown = found if len(found) <= 60 else found[:57] + "…"
    return f"{place} is {shown}: {first['msg'][:1].lower()}{first['msg'][1:]}"


class RecordingEntry(BaseModel):
    """A recording on offer; `missing` if its file is no longer there."""

    id: str
    label: str
    group: Literal["Live", "Samples", "Lessons", "Recent", "Uploads", "Command line", "Drawn"]
    missing: bool = False


class KnobEntry(BaseModel):
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
            default=default,
        )


class MethodEntry(BaseModel):
    """begins: how a line of the method begins, in a word; ros: whether a ROS program knows its thresholds."""

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


class ScoreEntry(BaseModel):
    name: str
    label: str
    unit: str
    help: str
    worse: Literal["higher", "lower"]
    least: float
    weight: float


class Welcome(BaseModel):
    type: Literal["welcome"] = "welcome"
    session: str
    resumed: bool
    viser: str
    version: str
    methods: list[MethodEntry]
    scores: list[ScoreEntry]
    recordings: list[RecordingEntry]
    uploadLimit: int  # noqa: N815
    presenter: str


class Recordings(BaseModel):
    type: Literal["recordings"] = "recordings"
    recordings: list[RecordingEntry]


class Loading(BaseModel):
    type: Literal["loading"] = "loading"
    recording: str
    label: str
    done: int
    total: int
    note: str = ""


class LiveStatus(BaseModel):
    """How a live source fares; told while a tab shows it, at most a few times a second.

    rate: scans a second; delay: of the last scan, from its stamp to its arrival [s]. total: scans since the beginning,
    of which the oldest were dropped, so that at most `most` are kept; refused: messages that were no scans.
    publisher: which tab's segments go back to the robot, if any.
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
    most: int
    publishable: bool
    publisher: Literal["", "this", "another"]
    publishTopic: str  # noqa: N815
    published: int
    publishTrouble: str  # noqa: N815


class Failure(BaseModel):
    type: Literal["error"] = "error"
    where: Where
    message: str
    rev: int | None = None


class Traced(BaseModel):
    """Every decision of the frame that the next `drawn` shows; see stepping.py."""

    type: Literal["trace"] = "trace"
    trace: dict[str, Any]


class Drawn(BaseModel):
    """`origin` says whose input it answers: "page", or "scene" for viser's sliders and clicks in the scene."""

    type: Literal["drawn"] = "drawn"
    rev: int
    origin: Literal["page", "scene"]
    state: dict[str, Any]


class Surveyed(BaseModel):
    """The scores of every stride-th frame under these thresholds, or a message why there are none.

    Crosses the network as one binary frame: the length of the rest of the head (uint32), the head in JSON, filled up
    with blanks to a multiple of 4 bytes, and `values`: float32, score after score in the order of Welcome.scores, each
    of ⌈frames / stride⌉ frames. All little-endian. The last of the scores, the differences from A, is there, and totals
    of every fate, if there is an A and every frame is known. first: number of the first frame, as in the state.
    """

    type: Literal["survey"] = "survey"
    rev: int
    recording: str
    topic: str
    method: str
    params: dict[str, int | float]
    frames: int
    first: int = 0
    stride: int
    message: str | None
    totals: dict[str, int] | None = None
    values: bytes = Field(exclude=True)

    def as_bytes(self) -> bytes:
        head = self.model_dump_json().encode()
        head += b" " * (-len(head) % 4)
        return len(head).to_bytes(4, "little") + head + self.values


def segments_json(extraction: Extraction) -> list[dict[str, Any]]:
    return [
        {
            "start": segment.start,
            "end": segment.end,
            "first": segment.first,
            "last": segment.last,
            "line": segment.line,
            "points": segment.points,
            "length": segment.length,
            "rms": segment.rms,
        }
        for segment in extraction.segments
    ]


def topics_json(recording: Recording) -> list[dict[str, Any]]:
    return [{"name": topic.name, "scans": topic.scans} for topic in recording.topics]
