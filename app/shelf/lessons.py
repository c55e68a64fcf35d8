"""Lessons: one JSON file each in sample_scans/lessons/, read whenever a page asks, so that a teacher can add one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from lineseg.extractors import EXTRACTORS
from lineseg.region_growing.trace import VOCABULARY

from ..bounds import Name, Number, sentence
from ..places import data_folder

Beam = Annotated[int, Field(ge=0)]
Words = Annotated[str, Field(min_length=1, max_length=2000)]
Pair = tuple[Beam, Beam]


def _one_of(names: tuple[str, ...]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in names:
            raise ValueError(f"there are {', '.join(names)}")
        return name

    return AfterValidator(known)


class Part(BaseModel):
    """Unknown fields are refused, so that a misspelt one does not silently do nothing."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Find(Part):
    """A decision, by what it is and not by its number: the nth (from 0, or from the end) that agrees in all."""

    kind: Annotated[str, _one_of(VOCABULARY.names)]
    check: Annotated[str, _one_of(VOCABULARY.check_names)] | None = None
    direction: Literal[1, -1] | None = None
    beam: Beam | None = None
    nth: int = 0


class Step(Part):
    """One text, and what the page shows beside it: the decision found, or without one the whole result.

    params: on top of the lesson's own. method: whose whole result is shown, with its usual thresholds, instead of that
    of region growing; nothing of it can be searched for.
    """

    text: Words
    method: Annotated[str, _one_of(tuple(EXTRACTORS))] | None = None
    find: Find | None = None
    params: dict[Name, Number] = {}
    selected: Beam | None = None

    @model_validator(mode="after")
    def _of_one_method(self) -> Step:
        if self.method and (self.find or self.params):
            raise ValueError("a step with a method shows its whole result: without find and params")
        return self


class Goal(Part):
    """What must be so, in all its parts, for the task to be done.

    lines: how many, [least, most]. together: pairs of beams in one line; apart: in two; inside, outside: beams in some
    line, in none. changed: the only thresholds that may differ from the lesson's, and at least one of them must.
    at: the kind of decision that is shown. selected: the beam is one of these. count: how many such decisions there
    are, [least, most].
    """

    lines: tuple[int, int] | None = None
    together: tuple[Pair, ...] = ()
    apart: tuple[Pair, ...] = ()
    inside: tuple[Beam, ...] = ()
    outside: tuple[Beam, ...] = ()
    changed: tuple[Name, ...] = ()
    at: Find | None = None
    selected: tuple[Beam, ...] = ()
    count: tuple[Find, int, int] | None = None


class Task(Part):
    """text: what to do; hint: on demand; done: said when it is done."""

    text: Words
    hint: Words
    done: Words
    goal: Goal
    params: dict[Name, Number] = {}


# A lesson teaches the method of the paper.
USUAL = {"max_occluder": 0.0, "merge_rms": 0.0}


class Lesson(Part):
    """params: thresholds that differ from USUAL and the defaults; knobs: those the lesson offers to change."""

    title: Annotated[str, Field(min_length=1, max_length=60)]
    about: Annotated[str, Field(min_length=1, max_length=200)]
    recording: Name
    frame: Annotated[int, Field(ge=0)] = 0
    params: dict[Name, Number] = {}
    knobs: tuple[Name, ...] = ()
    steps: Annotated[tuple[Step, ...], Field(min_length=1, max_length=30)]
    task: Task


class NamedLesson(Lesson):
    id: str


class Lessons(BaseModel):
    """broken: one sentence for each file that is no lesson."""

    lessons: list[NamedLesson]
    broken: list[str]


def lesson_files() -> list[Path]:
    return sorted((data_folder("sample_scans") / "lessons").glob("*.json"))


def read_lessons(files: list[Path]) -> Lessons:
    """The lessons in these files, in the order of their names."""
    lessons, broken = [], []
    for file in files:
        try:
            lesson = Lesson.model_validate_json(file.read_text("utf-8"))
            usual = lesson.model_copy(update={"params": USUAL | lesson.params})
            lessons.append(NamedLesson(id=file.stem, **usual.model_dump()))
        except ValidationError as error:
            broken.append(f"{file.name}: {sentence(error)}")
        except (OSError, UnicodeDecodeError) as error:
            broken.append(f"{file.name}: {error}")
    return Lessons(lessons=lessons, broken=broken)
