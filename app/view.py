"""The View: what one browser tab shows. Each field is declared once, and everything else follows from that."""

import hashlib
import json
import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cache, lru_cache
from typing import Annotated, Any, Literal, Self, TypeVar

from pydantic import Field, ValidationError

from lineseg import EXTRACTORS, Params, Thresholds
from lineseg.doubt import SCORES, Score
from lineseg.doubt.suspicion import WEIGHTS
from lineseg.failing import mistake
from lineseg.knobs import replaced
from lineseg.readers import Reading

from .bounds import Count, Message, Name, ReadingValues, RecordingId, Values, sentence
from .view_field import EACH, ViewField, patch_of, view_fields

log = logging.getLogger(__name__)

DIFFERENCE = Score(
    "difference",
    "differences from A",
    "",
    "Lines lost, gained, split and merged from the pinned result A to the present one.",
    "higher",
    least=1.0,
    weight=0.0,
)
MOST_WEIGHT = 10.0
# Of what a link says and cannot be had, so much is told.
MOST_COMPLAINTS = 3
SUSPICION = Score(
    "suspicion",
    "suspicion",
    "",
    "In how many lines the frame is probably wrong: its disputed lines, and more for whatever else has a weight and "
    "stands out from the recording and from nearby frames.",
    "higher",
    least=0.5,
    weight=0.0,
)
T = TypeVar("T")
STRIP_SCORES = {**SCORES, SUSPICION.name: SUSPICION, DIFFERENCE.name: DIFFERENCE}


@dataclass(frozen=True)
class Layers:
    """What is drawn; `replay` is the geometry of the decision on the screen, `ghosts` the missed lines in Inspect.

    In the world: `trajectory` of the laser, `past` scans, `all_lines` of the recording, and the `line_map` that they
    are merged into; `other_lasers` of the robot at the time of the frame.
    """

    points: bool = True
    invalid: bool = False
    seeds: bool = True
    segments: bool = True
    endpoints: bool = True
    normals: bool = False
    dropped: bool = True
    truth: bool = False
    verdicts: bool = False
    laser: bool = True
    grid: bool = True
    numbers: bool = False
    replay: bool = True
    ghosts: bool = True
    trajectory: bool = True
    past: bool = True
    all_lines: bool = False
    line_map: bool = False
    other_lasers: bool = False

    def but(self, /, **values: bool) -> Self:
        """A copy with some layers switched. Raises ValueError, listing the known names, for an unknown one."""
        known = [entry.name for entry in fields(self)]
        for name in values:
            if name not in known:
                raise ValueError(f"there is no layer {name!r}; choose from {', '.join(known)}")
        return replace(self, **values)


@dataclass(frozen=True)
class Against:
    """The pinned result A, for comparison with the result B of the View."""

    method: str
    params: Thresholds

    @classmethod
    def of(cls, method: str, params: Mapping[str, Any]) -> Self:
        """Raises ValueError naming any bad value."""
        if method not in EXTRACTORS:
            raise ValueError(f"there is no method {method!r}; choose from {', '.join(EXTRACTORS)}")
        return cls(method, EXTRACTORS[method].params_type().but(**params))

    def numbers(self) -> dict[str, Any]:
        """The arguments for `of`."""
        return {"method": self.method, "params": self.params.numbers()}


class Pinned(Message):
    """A in a patch."""

    method: Name
    params: Values = Field(default_factory=dict)


def all_weights(changed: tuple[tuple[str, float], ...]) -> dict[str, float]:
    """The default weights with the given changes."""
    return {**WEIGHTS, **dict(changed)}


def _changed_weights(values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
    for name, weight in values.items():
        if name not in WEIGHTS:
            raise ValueError(f"weights has no {name!r}; it has {', '.join(WEIGHTS)}")
        if not 0 <= weight <= MOST_WEIGHT:
            raise ValueError(f"the weight of {name} is {weight}; allowed: 0 to {MOST_WEIGHT:g}")
    return tuple(sorted((name, float(weight)) for name, weight in values.items() if weight != WEIGHTS[name]))


# The topic is a field of its own, because it is chosen so often.
REREAD = tuple(name for name in Reading.declared() if name != "topic")


def reread(reading: Reading, values: Mapping[str, Any]) -> Reading:
    """A copy with some fields changed; links give numbers as text."""
    poses = values.get("poses")
    if isinstance(poses, str) and set(poses) & {"/", "\\", ":"}:
        raise ValueError(
            f"poses is {poses!r:.60}; a page reads a trajectory that lies beside its recording: give its name"
        )
    return reading.but(**{name: _typed(name, value) for name, value in values.items()})


def _without_topic(reading: Reading) -> Reading:
    if reading.topic is not None:
        raise ValueError("reading has no topic in a view; set the topic of the view")
    return reading


def _typed(name: str, value: Any) -> Any:
    number = name in REREAD and Reading.type_of(name) in (int, float)
    try:
        return float(value) if number and isinstance(value, str) else value
    except ValueError:
        return value


def told_reading(reading: Reading) -> dict[str, Any]:
    """All fields in a patch, None for those that are not given."""
    return {name: getattr(reading, name) for name in REREAD}


PLACE = ("recording", "topic", "reading")


@dataclass(frozen=True)
class View:
    """The whole state of a tab. It is hashable, and equal Views are drawn the same.

    A field comes after the fields that reset it or switch it off. Links list the fields in this order.

    reading: how the file is read, apart from the topic.
    step: the decision that the replay shows, or None for the whole result.
    lesson: its id, or None; page: of the lesson, from 0. selected: the beam to explain, or None; beside: another, to
    explain why both are in one line, or not. closeup: whether Learn shows each decision from near by.
    score: shown in the strip. against: the result to compare with.
    weights: of the suspicion, if not the defaults.
    reference: the truth to use if both exist: "labels" made by people, or the "wall" of the recording.
    space: whether the scene shows the frame of the laser or the world; past: which other scans the world shows: none,
    the last so many, or all. ride: whether the picture moves with the robot.
    live: whether to follow the newest frame of a live recording; if not, the recording stays frozen.
    dark: whether the page has dark colours.
    """

    mode: Annotated[Literal["tune", "learn", "inspect"], ViewField(link="mode", mirrored=True)] = "tune"
    recording: Annotated[
        RecordingId,
        # An empty id is what a page says that knows of no recording yet.
        ViewField(link="recording", mirrored=True, take=lambda view, id: id or view.recording),
    ] = ""
    topic: Annotated[
        Name | None,
        ViewField(
            link="topic",
            mirrored=True,
            reset_by=("recording",),
            take=lambda view, name: name if name and name.strip() else None,
        ),
    ] = None
    reading: Annotated[
        Reading,
        ViewField(
            link="reading",
            mirrored=True,
            reset_by=("recording", "topic"),
            patch=ReadingValues,
            take=lambda view, values: _without_topic(reread(view.reading, values)),
            tell=told_reading,
            written="reading",
        ),
    ] = field(default_factory=Reading)
    frame: Annotated[Count, ViewField(link="frame", mirrored=True, reset_by=PLACE, lasting=False)] = 0
    method: Annotated[Name, ViewField(link="method", mirrored=True, choices=EXTRACTORS)] = "region-growing"
    params: Annotated[
        Thresholds,
        ViewField(
            link=EACH,
            mirrored=True,
            reset_by=("method",),
            fresh=lambda view: EXTRACTORS[view.method].params_type(),
            patch=Values,
            take=lambda view, values: view.params.but(**values),
            tell=lambda params: params.numbers(),
            written="thresholds",
        ),
    ] = field(default_factory=Params)
    step: Annotated[Count | None, ViewField(link="step", mirrored=True, reset_by=(*PLACE, "method"))] = None
    lesson: Annotated[Name | None, ViewField(link="lesson", mirrored=True)] = None
    page: Annotated[Count, ViewField(link="page", mirrored=True, reset_by=("lesson",))] = 0
    selected: Annotated[Count | None, ViewField(link="beam", mirrored=True, reset_by=PLACE)] = None
    beside: Annotated[Count | None, ViewField(link="beside", mirrored=True, reset_by=(*PLACE, "selected"))] = None
    closeup: Annotated[Literal["on", "off"], ViewField(link="closeup", mirrored=True)] = "on"
    camera: Annotated[Literal["plan", "free"], ViewField(link="camera", mirrored=False)] = "plan"
    speed: Annotated[Literal["0.5", "1", "2", "4", "8"], ViewField(link="speed", mirrored=False)] = "1"
    score: Annotated[Name, ViewField(link="score", mirrored=True, choices=STRIP_SCORES)] = "coverage"
    against: Annotated[
        Against | None,
        ViewField(
            link="against",
            mirrored=True,
            patch=Pinned | None,
            take=lambda view, pinned: pinned and Against.of(pinned["method"], pinned.get("params", {})),
            tell=lambda against: against and against.numbers(),
            written="pinned",
        ),
    ] = None
    weights: Annotated[
        tuple[tuple[str, float], ...],
        ViewField(
            link="weights",
            mirrored=True,
            patch=Values,
            take=lambda view, values: _changed_weights({**view.all_weights, **values}),
            tell=all_weights,
            written="numbers",
            most=MOST_WEIGHT,
        ),
    ] = ()
    reference: Annotated[Literal["labels", "wall"], ViewField(link="reference", mirrored=True)] = "labels"
    layers: Annotated[
        Layers,
        ViewField(
            link="layers",
            mirrored=False,
            patch=Annotated[dict[Name, bool], Field(max_length=64)],
            take=lambda view, switched: view.layers.but(**switched),
            tell=lambda layers: dict(vars(layers)),
            written="switches",
        ),
    ] = field(default_factory=Layers)
    space: Annotated[Literal["laser", "world"], ViewField(link="space", mirrored=True)] = "laser"
    past: Annotated[Literal["none", "10", "100", "all"], ViewField(link="past", mirrored=True)] = "all"
    ride: Annotated[Literal["on", "off"], ViewField(link="ride", mirrored=True)] = "off"
    live: Annotated[bool, ViewField(link=None, mirrored=True, reset_by=PLACE, off_by=("frame", "step"))] = True
    dark: Annotated[bool, ViewField(link=None, mirrored=False)] = False

    def patched(self, patch: Mapping[str, Any]) -> Self:
        """A copy with some fields changed; `reading`, `params`, `layers` and `weights` may be given in part.

        A change resets other fields unless the patch sets them: another recording, topic or reading starts at frame 0,
        another method with its defaults. Choosing a frame or a step stops following live frames. Raises ValueError
        naming any bad value.
        """
        declared = view_fields(type(self))
        for name in patch:
            if name not in declared:
                raise ValueError(f"a view has no {name!r}; it has {', '.join(sorted(declared))}")
        view, usual = self, _usual(type(self))
        changed, chosen = set[str](), set[str]()
        for name, entry in _concerned(type(self), frozenset(patch)):
            value = was = getattr(view, name)
            if changed and not changed.isdisjoint(entry.reset_by):
                value = entry.fresh(view) if entry.fresh else getattr(usual, name)
            elif chosen and not chosen.isdisjoint(entry.off_by):
                value = False
            if name in patch:
                value = entry.taken(name, replaced(view, {name: value}), patch[name])
            if value is not was:
                view = replaced(view, {name: value})
                if value != was:
                    changed.add(name)
                    chosen.update([name] if value is not None else [])
        return view

    def salvaged(self, said: Mapping[str, Any]) -> tuple[Self, str | None]:
        """A copy with the valid part of a link, and an error about the rest."""
        try:
            return self._checked(said), None
        except Exception:
            view, complaints = self, list[str]()
        for part in _parts(said, list(view_fields(type(self)))):
            try:
                view = view._checked(part)
            except ValueError as error:
                complaints.append(str(error))
            except Exception as error:
                # Else the page would connect, fail and connect again for ever.
                log.exception("a link failed")
                complaints.append(mistake(error))
        more = len(complaints) - MOST_COMPLAINTS
        told = complaints[:MOST_COMPLAINTS] + ([f"and {more} more"] if more > 0 else [])
        return view, "; ".join(told) or None

    def _checked(self, said: Mapping[str, Any]) -> Self:
        """Same as `patched`, for values of any type."""
        try:
            patch = patch_of(type(self)).model_validate(dict(said))
        except ValidationError as error:
            raise ValueError(sentence(error)) from None
        return self.patched(patch.changes())

    @property
    def read_as(self) -> Reading:
        """The Reading with the topic. Raises ValueError for a bad topic."""
        return self.reading if self.topic is None else self.reading.but(topic=self.topic)

    @property
    def place(self) -> str:
        """A short text that is equal for Views of the same scans."""
        return _place(self.recording, self.topic, self.reading)

    @property
    def all_weights(self) -> dict[str, float]:
        """The weight of every score in the suspicion."""
        return all_weights(self.weights)

    def as_json(self) -> dict[str, Any]:
        """A patch that restores this View."""
        return {name: entry.tell(getattr(self, name)) for name, entry in view_fields(type(self)).items()}


@lru_cache(maxsize=256)
def _place(recording: str, topic: str | None, reading: Reading) -> str:
    said = json.dumps([recording, topic, reading.given()])
    return hashlib.sha256(said.encode()).hexdigest()[:16]


@cache
def _usual(view: type[T]) -> T:
    """A View with its defaults."""
    return view()


@lru_cache(maxsize=256)
def _concerned(view: type[View], patched: frozenset[str]) -> tuple[tuple[str, ViewField], ...]:
    """The fields that a patch of these may change, in order: a slider's is one of more than twenty."""
    declared = view_fields(view)
    reached = set(patched)
    for name, entry in declared.items():
        if not reached.isdisjoint((*entry.reset_by, *entry.off_by)):
            reached.add(name)
    return tuple((name, entry) for name, entry in declared.items() if name in reached)


def _parts(said: Mapping[str, Any], order: list[str]) -> Iterator[dict[str, Any]]:
    """The patch in pieces, with fields that reset others first."""
    for name in sorted(said, key=lambda name: order.index(name) if name in order else len(order)):
        value = said[name]
        if isinstance(value, Mapping) and name != "against":
            yield from ({name: {key: each}} for key, each in value.items())
        else:
            yield {name: value}
