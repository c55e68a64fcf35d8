"""What the file of a lesson may say; sample_scans/lessons/README.md tells its author."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from lineseg.extractors import EXTRACTORS
from lineseg.params import Params

from ..bounds import Name, Number, RecordingId
from ..told.answers import ExplainedTerm
from ..told.typescript import As

Beam = Annotated[int, Field(ge=0)]
Words = Annotated[str, Field(min_length=1, max_length=2000)]
Pair = tuple[Beam, Beam]
# The blocks of the method (Fig. 3), and beside them the comparison with other methods.
Block = Literal["fit", "seed", "growth", "enough", "overlap", "endpoints", "segments", "methods"]
KINDS = tuple(dict.fromkeys(name for each in EXTRACTORS.values() for name in each.vocabulary.names))
CHECKS = tuple(dict.fromkeys(name for each in EXTRACTORS.values() for name in each.vocabulary.check_names))


def _one_of(names: tuple[str, ...]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in names:
            raise ValueError(f"choose from {', '.join(names)}")
        return name

    return AfterValidator(known)


Thresholds = Annotated[tuple[Annotated[str, _one_of(Params.names())], ...], Field(max_length=len(Params.names()))]


class Part(BaseModel):
    """Refuses unknown fields, so that a misspelt one does not silently do nothing."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Find(Part):
    """Finds a decision by its properties: the nth (from 0, or negative from the end) that matches all of them."""

    kind: Annotated[str, _one_of(KINDS)]
    check: Annotated[str, _one_of(CHECKS)] | None = None
    direction: Literal[1, -1] | None = None
    beam: Beam | None = None
    nth: int = 0


class Named(Find):
    """A decision whose numbers texts can name. params: override those of the lesson, instead of those of the text.

    method: of this method, with its default thresholds.
    """

    method: Annotated[str, _one_of(tuple(EXTRACTORS))] | None = None
    params: dict[Name, Number] | None = None


class Looked(Part):
    """What a text looks at: near: beams whose points fill the stage where no decision is shown; none: all of them.
    names: words for beams, written beside their points.

    show: something to try in the text: points and their fits, the noise of the recording, the times of two methods,
    another method step by step beside the one of the lesson, or frames to label (static/learn/shown.js).
    """

    near: tuple[Beam, ...] = ()
    names: dict[Annotated[str, Field(max_length=40)], Beam] = {}
    show: Literal["fits", "noise", "times", "beside", "label"] | None = None


class Step(Looked):
    """One text and what the page shows with it: the decision found, or the whole result.

    why: a question that the text answers. params: override those of the lesson. method: shows this method with its
    default thresholds instead of region growing, so it cannot be combined with params.
    """

    text: Words
    why: Annotated[str, Field(max_length=100)] = ""
    method: Annotated[str, _one_of(tuple(EXTRACTORS))] | None = None
    find: Find | None = None
    params: dict[Name, Number] = {}
    selected: Beam | None = None

    @model_validator(mode="after")
    def _of_one_method(self) -> Step:
        if self.method and self.params:
            raise ValueError("a step with a method shows it with its default thresholds; remove params")
        return self


class Goal(Part):
    """Conditions that must all hold for the task to be done.

    lines: number of lines, [least, most]. together: pairs of beams in one line; either: pairs, one of which must be in
    one line; apart: pairs in different lines; inside, outside: beams in some line, in no line. changed: the only
    thresholds that may differ from the lesson's; at least one must. at: kind of the shown decision. selected: beams,
    one of which must be selected. count: number of such decisions, [least, most]. labelled: number of frames of the
    recording whose true lines must be labelled.
    """

    lines: tuple[int, int] | None = None
    together: tuple[Pair, ...] = ()
    either: tuple[Pair, ...] = ()
    apart: tuple[Pair, ...] = ()
    inside: tuple[Beam, ...] = ()
    outside: tuple[Beam, ...] = ()
    changed: Thresholds = ()
    at: Find | None = None
    selected: tuple[Beam, ...] = ()
    count: tuple[Find, int, int] | None = None
    labelled: Annotated[int, Field(ge=1)] | None = None


class Option(Part):
    """An answer to choose. why: shown when it was chosen although it is not right."""

    text: Annotated[str, Field(min_length=1, max_length=300)]
    right: bool = False
    why: Annotated[str, Field(max_length=600)] = ""


class Quantity(Part):
    """A number to find out. answer: with its unit, such as "45 mm"; it may be a placeholder. within: how far off an
    answer may be."""

    answer: Annotated[str, Field(min_length=1, max_length=80)]
    within: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0


class Task(Looked):
    """text: what to do; hint: shown on request; done: shown when it is done.

    goal, choice, number: exactly one of them: something to do on the page, an answer to choose, a number to find out.
    """

    text: Words
    hint: Words
    done: Words
    goal: Goal | None = None
    choice: Annotated[tuple[Option, ...], Field(max_length=8)] = ()
    number: Quantity | None = None
    params: dict[Name, Number] = {}

    @model_validator(mode="after")
    def _of_one_kind(self) -> Task:
        given = [name for name in ("goal", "choice", "number") if getattr(self, name)]
        if len(given) != 1:
            raise ValueError(f"a task has one of goal, choice and number; this one has {' and '.join(given) or 'none'}")
        if self.choice and not 0 < sum(option.right for option in self.choice) < len(self.choice):
            raise ValueError('some of the answers to choose must have "right": true, and some not')
        return self


# Lessons teach the method of the paper.
USUAL = {"max_occluder": 0.0, "merge_rms": 0.0, "max_void": 0.0, "epsilon_growth": 0.0}


class Lesson(Part):
    """block: of the diagram, below which it is listed. params: thresholds that differ from USUAL and the defaults;
    knobs: thresholds that the reader may change.

    recording: `lesson:NAME` or `sample:NAME` of the program, a drawn world, or `folder:FILE`, beside the file of the
    lesson; scan: one scan instead, as in sensor_msgs/LaserScan. decisions: those that texts name.
    """

    title: Annotated[str, Field(min_length=1, max_length=60)]
    about: Annotated[str, Field(min_length=1, max_length=200)]
    block: Block | None = None
    recording: RecordingId = ""
    scan: Annotated[dict[str, Any], As("Record<string, unknown>")] = {}
    frame: Annotated[int, Field(ge=0)] = 0
    params: dict[Name, Number] = {}
    knobs: Thresholds = ()
    decisions: Annotated[dict[Name, Named], Field(max_length=100)] = {}
    steps: Annotated[tuple[Step, ...], Field(min_length=1, max_length=30)]
    task: Task

    @model_validator(mode="after")
    def _of_one_recording(self) -> Lesson:
        if bool(self.recording) == bool(self.scan):
            raise ValueError("a lesson has either recording or scan")
        return self


class NamedLesson(Lesson):
    """A lesson with everything put in. recording: the id by which the page opens it.

    accepted: of each threshold of the task, the least and the largest value that solves it. own: whether it is not one
    of the program's.
    """

    id: str
    accepted: dict[str, tuple[float, float]] = {}
    own: bool = False


class Lessons(BaseModel):
    """terms: all that texts use, explained."""

    lessons: list[NamedLesson]
    terms: list[ExplainedTerm]
