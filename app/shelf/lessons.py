"""Lessons: one JSON file each in sample_scans/lessons/, read again for every page, so that a teacher can add one."""

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
            raise ValueError(f"choose from {', '.join(names)}")
        return name

    return AfterValidator(known)


class Part(BaseModel):
    """Refuses unknown fields, so that a misspelt one does not silently do nothing."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Find(Part):
    """Finds a decision by its properties: the nth (from 0, or negative from the end) that matches all of them."""

    kind: Annotated[str, _one_of(VOCABULARY.names)]
    check: Annotated[str, _one_of(VOCABULARY.check_names)] | None = None
    direction: Literal[1, -1] | None = None
    beam: Beam | None = None
    nth: int = 0


class Step(Part):
    """One text and what the page shows with it: the decision found, or the whole result.

    params: override those of the lesson. method: shows the whole result of this method, with its default thresholds,
    instead of region growing; it cannot be combined with find or params.
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

    lines: number of lines, [least, most]. together: pairs of beams in one line; apart: pairs in different lines;
    inside, outside: beams in some line, in no line. changed: the only thresholds that may differ from the lesson's;
    at least one must. at: kind of the shown decision. selected: beams, one of which must be selected. count: number of
    such decisions, [least, most].
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
    """text: what to do; hint: shown on request; done: shown when it is done."""

    text: Words
    hint: Words
    done: Words
    goal: Goal
    params: dict[Name, Number] = {}


# Lessons teach the method of the paper.
USUAL = {"max_occluder": 0.0, "merge_rms": 0.0, "max_void": 0.0, "epsilon_growth": 0.0}


class Lesson(Part):
    """params: thresholds that differ from USUAL and the defaults; knobs: thresholds that the reader may change."""

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
    """broken: one sentence for each file that is not a valid lesson."""

    lessons: list[NamedLesson]
    broken: list[str]


def lesson_files() -> list[Path]:
    return sorted((data_folder("sample_scans") / "lessons").glob("*.json"))


def read_lessons(files: list[Path]) -> Lessons:
    """The lessons in these files, ordered by file name."""
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
