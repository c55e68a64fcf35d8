"""Lessons: one JSON file each in sample_scans/lessons/, read again for every page, so that a teacher can add one."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from lineseg.extractors import EXTRACTORS
from lineseg.params import Params
from lineseg.readers import open_recording
from lineseg.scan import Scan
from lineseg.tracing.glossary import TERMS

from ..bounds import Name, Number, sentence
from ..places import data_folder
from ..told.answers import ExplainedTerm
from .lesson_goals import accepted
from .lesson_numbers import METHOD, Numbers

Beam = Annotated[int, Field(ge=0)]
Words = Annotated[str, Field(min_length=1, max_length=2000)]
Pair = tuple[Beam, Beam]
KINDS = tuple(dict.fromkeys(name for each in EXTRACTORS.values() for name in each.vocabulary.names))
CHECKS = tuple(dict.fromkeys(name for each in EXTRACTORS.values() for name in each.vocabulary.check_names))


def _one_of(names: tuple[str, ...]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in names:
            raise ValueError(f"choose from {', '.join(names)}")
        return name

    return AfterValidator(known)


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
    names: words for beams, written beside their points."""

    near: tuple[Beam, ...] = ()
    names: dict[Annotated[str, Field(max_length=40)], Beam] = {}


class Step(Looked):
    """One text and what the page shows with it: the decision found, or the whole result.

    params: override those of the lesson. method: shows the
    whole result of this method, with its default thresholds, instead of region growing; it cannot be combined with find
    or params.
    """

    text: Words
    method: Annotated[str, _one_of(tuple(EXTRACTORS))] | None = None
    find: Find | None = None
    params: dict[Name, Number] = {}
    selected: Beam | None = None

    @model_validator(mode="after")
    def _of_one_method(self) -> Step:
        if self.method and (self.find or self.params):
            raise ValueError("a step with a method shows its whole result; remove find and params")
        return self


class Goal(Part):
    """Conditions that must all hold for the task to be done.

    lines: number of lines, [least, most]. together: pairs of beams in one line; either: pairs, one of which must be in
    one line; apart: pairs in different lines; inside, outside: beams in some line, in no line. changed: the only
    thresholds that may differ from the lesson's; at least one must. at: kind of the shown decision. selected: beams,
    one of which must be selected. count: number of such decisions, [least, most].
    """

    lines: tuple[int, int] | None = None
    together: tuple[Pair, ...] = ()
    either: tuple[Pair, ...] = ()
    apart: tuple[Pair, ...] = ()
    inside: tuple[Beam, ...] = ()
    outside: tuple[Beam, ...] = ()
    changed: tuple[Name, ...] = ()
    at: Find | None = None
    selected: tuple[Beam, ...] = ()
    count: tuple[Find, int, int] | None = None


class Task(Looked):
    """text: what to do; hint: shown on request; done: shown when it is done."""

    text: Words
    hint: Words
    done: Words
    goal: Goal
    params: dict[Name, Number] = {}


# Lessons teach the method of the paper.
USUAL = {"max_occluder": 0.0, "merge_rms": 0.0, "max_void": 0.0, "epsilon_growth": 0.0}


class Lesson(Part):
    """params: thresholds that differ from USUAL and the defaults; knobs: thresholds that the reader may change.

    Texts write numbers as placeholders (lesson_numbers.py); decisions: those that they name.
    """

    title: Annotated[str, Field(min_length=1, max_length=60)]
    about: Annotated[str, Field(min_length=1, max_length=200)]
    recording: Name
    frame: Annotated[int, Field(ge=0)] = 0
    params: dict[Name, Number] = {}
    knobs: tuple[Name, ...] = ()
    decisions: dict[Name, Named] = {}
    steps: Annotated[tuple[Step, ...], Field(min_length=1, max_length=30)]
    task: Task


class NamedLesson(Lesson):
    """accepted: of each threshold of the task, the least and the largest value that solves it."""

    id: str
    accepted: dict[str, tuple[float, float]] = {}


class Lessons(BaseModel):
    """broken: one sentence for each file that is not a valid lesson. terms: all that texts use, explained."""

    lessons: list[NamedLesson]
    broken: list[str]
    terms: list[ExplainedTerm]


def lesson_files() -> list[Path]:
    return sorted((data_folder("sample_scans") / "lessons").glob("*.json"))


def read_lessons(files: list[Path]) -> Lessons:
    """The lessons in these files, ordered by file name, with all numbers put in."""
    lessons, broken = [], []
    for file in files:
        try:
            lessons.append(_read(file.stem, file.read_text("utf-8")))
        except ValidationError as error:
            broken.append(f"{file.name}: {sentence(error)}")
        except (OSError, ValueError) as error:
            broken.append(f"{file.name}: {error}")
    terms = [ExplainedTerm(**term._asdict()) for term in TERMS]
    return Lessons(lessons=lessons, broken=broken, terms=terms)


def looked_at(id: str, page: int) -> tuple[str, Looked] | None:
    """The recording of a lesson, and what one of its pages looks at; the task comes after the steps."""
    # Looked up, not made from the id, which comes from a link.
    file = next((file for file in lesson_files() if file.stem == id), None)
    if file is None:
        return None
    try:
        lesson = _read(file.stem, file.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return lesson.recording, lesson.steps[page] if page < len(lesson.steps) else lesson.task


@lru_cache(maxsize=64)
def _read(id: str, text: str) -> NamedLesson:
    lesson = Lesson.model_validate_json(text)
    lesson = lesson.model_copy(update={"params": USUAL | lesson.params})
    scan, task, usual = scan_of(lesson), lesson.task, Params().but(**lesson.params)
    _check_beams(lesson, len(scan))
    steps = []
    for number, step in enumerate(lesson.steps, 1):
        params = usual.but(**step.params)
        numbers = Numbers(scan, usual, params, step.find, lesson.decisions, step.method or METHOD)
        steps.append(step.model_copy(update={"text": _filled(numbers, step.text, f"step {number}")}))
    params = usual.but(**task.params)
    numbers = Numbers(scan, usual, params, task.goal.at, lesson.decisions)
    words = {name: _filled(numbers, getattr(task, name), name) for name in ("text", "hint", "done")}
    lesson = lesson.model_copy(update={"steps": tuple(steps), "task": task.model_copy(update=words)})
    return NamedLesson(id=id, accepted=accepted(task.goal, scan, params), **lesson.model_dump())


def _check_beams(lesson: Lesson, beams: int) -> None:
    """Raises ValueError, naming the place, for a beam that the scan does not have."""
    goal = lesson.task.goal
    pairs = [beam for pair in (*goal.together, *goal.either, *goal.apart) for beam in pair]
    looked = {f"step {k}": step for k, step in enumerate(lesson.steps, 1)} | {"task": lesson.task}
    places = {place: [*each.near, *each.names.values()] for place, each in looked.items()}
    places |= {f"step {k}": [*places[f"step {k}"], step.selected or 0] for k, step in enumerate(lesson.steps, 1)}
    places["goal"] = [*pairs, *goal.inside, *goal.outside, *goal.selected]
    for place, named in places.items():
        for beam in named:
            if beam >= beams:
                raise ValueError(f"{place}: there is no beam {beam}; {lesson.recording} has beams 0 to {beams - 1}")


def _filled(numbers: Numbers, text: str, place: str) -> str:
    try:
        return numbers.fill(text)
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from None


def scan_of(lesson: Lesson) -> Scan:
    """The scan that a lesson is about. Raises ValueError if it is none of the samples."""
    kind, _, name = lesson.recording.partition(":")
    folder = data_folder("sample_scans") / ("lessons" if kind == "lesson" else "")
    file = folder / f"{name}.npz"
    if kind not in ("lesson", "sample") or not file.is_file():
        raise ValueError(
            f"recording is {lesson.recording!r}; it must be lesson:NAME or sample:NAME of an NPZ file there"
        )
    recording = open_recording(file)
    if lesson.frame >= len(recording):
        raise ValueError(f"frame is {lesson.frame}, but {lesson.recording} has {len(recording)} frames")
    return recording[lesson.frame]
