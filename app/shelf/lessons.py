"""Reads the files of lessons: checks them, and puts the numbers into their texts."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from lineseg.params import Params
from lineseg.readers import open_recording
from lineseg.scan import Recording, Scan
from lineseg.simulate.drawing import Drawing
from lineseg.unfinished import write_whole

from ..places import data_folder
from .lesson import USUAL, Lesson, Looked, NamedLesson, Task
from .lesson_goals import accepted
from .lesson_markup import beside, check_text
from .lesson_mistakes import MistakeError, Place, told
from .lesson_numbers import METHOD, Numbers

LARGEST = 1_000_000
T = TypeVar("T")
QUANTITY = re.compile(r"[-−]?\d+(\.\d+)?(\s*\D.*)?")


@dataclass(frozen=True)
class Home:
    """Where lessons come from: the program, or a folder.

    prefix: of their ids. scans: gives the folder for scans that they contain. paths: their recordings, by id.
    """

    folder: Path | None = None
    prefix: str = ""
    scans: Callable[[], Path] | None = None
    paths: dict[str, Path] = field(default_factory=dict)

    def place_of(self, lesson: Lesson) -> tuple[str, Path | None]:
        """Id and file of a lesson's recording; a drawn world has no file. Raises ValueError if there is none."""
        if lesson.scan:
            return self._kept(self._written(lesson.scan))
        kind, _, name = lesson.recording.partition(":")
        if kind == "drawn":
            return lesson.recording, None
        if kind == "folder":
            return self._kept(beside(self.folder, name))
        if lesson.recording in self.paths:
            return lesson.recording, self.paths[lesson.recording]
        file = data_folder("sample_scans") / ("lessons" if kind == "lesson" else "") / f"{name}.npz"
        if kind not in ("lesson", "sample") or name != Path(name).name or not file.is_file():
            raise ValueError(
                f"recording is {lesson.recording[:60]!r}; it must be lesson:NAME or sample:NAME of the program, "
                "drawn:WORLD, or folder:FILE for a file beside the lesson"
            )
        return lesson.recording, file

    def _kept(self, path: Path) -> tuple[str, Path]:
        id = f"own:{hashlib.sha256(os.fsencode(path)).hexdigest()[:12]}"
        self.paths[id] = path
        return id, path

    def _written(self, scan: dict) -> Path:
        text = json.dumps(scan)
        if self.scans is None:
            raise ValueError("this lesson cannot contain its scan; name a recording")
        path = self.scans() / f"{hashlib.sha256(text.encode()).hexdigest()[:12]}.json"
        if not path.is_file():
            write_whole(path, text)
        return path


@dataclass(frozen=True)
class ReadLessons:
    """broken: one sentence for each file that is not a valid lesson."""

    lessons: list[NamedLesson]
    broken: list[str]


def lesson_files() -> list[Path]:
    return sorted((data_folder("sample_scans") / "lessons").glob("*.json"))


def read_lessons(files: list[Path], home: Home | None = None) -> ReadLessons:
    """The lessons in these files, ordered by file name, with all numbers put in."""
    lessons, broken = [], []
    for file in files:
        try:
            lessons.append(read_lesson(file, home or Home()))
        except ValueError as error:
            broken.append(str(error))
    return ReadLessons(lessons, broken)


def read_lesson(file: Path, home: Home) -> NamedLesson:
    """Raises ValueError, with the file, the line, what was found and what was expected."""
    text = ""
    try:
        if file.stat().st_size > LARGEST:
            raise ValueError(f"a lesson has at most {LARGEST / 1e6:g} MB; put its recording into a file beside it")
        text = file.read_text("utf-8-sig")
        # pydantic says where a text ceases to be JSON, but not in which line of a file.
        json.loads(text)
        return _filled(home, f"{home.prefix}{file.stem}", Lesson.model_validate_json(text))
    except RecursionError:
        raise ValueError(f"{file.name}: this is nested too deeply to be a lesson") from None
    except OSError as error:
        raise ValueError(f"{file.name} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ValueError(told(file.name, text, error, Lesson)) from None


def scan_of(lesson: Lesson, home: Home | None = None) -> Scan:
    """The scan that a lesson is about. Raises ValueError if there is none."""
    return _scan(lesson, (home or Home()).place_of(lesson)[1])


def _scan(lesson: Lesson, path: Path | None) -> Scan:
    recording = recording_of(lesson, path)
    if lesson.frame >= len(recording):
        frames = f"{len(recording)} frame{'s' * (len(recording) > 1)}"
        raise ValueError(f"frame is {lesson.frame}, but {lesson.recording or 'scan'} has {frames}")
    return recording[lesson.frame]


def recording_of(lesson: Lesson, path: Path | None) -> Recording:
    """The recording of a lesson. path: None for a drawn world."""
    if path is None:
        return Drawing.parse(lesson.recording.removeprefix("drawn:")).recording()
    return open_recording(path)


def _filled(home: Home, id: str, lesson: Lesson) -> NamedLesson:
    """The lesson with its recording looked up, its numbers put in, and everything checked."""
    try:
        recording, path = home.place_of(lesson)
        scan = _scan(lesson, path)
    except (ValueError, OSError) as error:
        raise MistakeError(("scan" if lesson.scan else "recording",), str(error)) from None
    _check_beams(lesson, scan)
    lesson = lesson.model_copy(update={"recording": recording, "scan": {}, "params": USUAL | lesson.params})
    usual = _params(Params(), lesson.params, ("params",))
    steps = []
    for k, step in enumerate(lesson.steps):
        params = _params(usual, step.params, ("steps", k, "params"))
        numbers = Numbers(scan, usual, params, step.find, lesson.decisions, step.method or METHOD)
        if step.find is not None:
            _at(("steps", k, "find"), numbers.shown_decision)
        steps.append(step.model_copy(update={"text": _text(numbers, step.text, ("steps", k, "text"), home)}))
    task = lesson.task
    params = _params(usual, task.params, ("task", "params"))
    numbers = Numbers(scan, usual, params, task.goal.at if task.goal else None, lesson.decisions)
    lesson = lesson.model_copy(update={"steps": tuple(steps), "task": _filled_task(task, numbers, home)})
    ranges = accepted(task.goal, scan, params) if task.goal else {}
    if task.goal and task.goal.changed and not ranges:
        raise MistakeError(("task", "goal"), f"no value of {' or '.join(task.goal.changed)} alone does what is asked")
    return NamedLesson(id=id, accepted=ranges, own=home.folder is not None, **lesson.model_dump())


def _filled_task(task: Task, numbers: Numbers, home: Home) -> Task:
    filled: dict[str, Any] = {
        name: _text(numbers, getattr(task, name), ("task", name), home) for name in ("text", "hint", "done")
    }
    filled["choice"] = tuple(
        option.model_copy(
            update={
                name: _text(numbers, getattr(option, name), ("task", "choice", k, name), home)
                for name in ("text", "why")
            }
        )
        for k, option in enumerate(task.choice)
    )
    if task.number is not None:
        place = ("task", "number", "answer")
        answer = _text(numbers, task.number.answer, place, home)
        if not QUANTITY.fullmatch(answer):
            raise MistakeError(place, f"{answer!r} does not begin with a number, such as 45 mm")
        filled["number"] = task.number.model_copy(update={"answer": answer})
    return task.model_copy(update=filled)


def _params(usual: Params, values: dict[str, float], place: Place) -> Params:
    return _at(place, lambda: usual.but(**values))


def _text(numbers: Numbers, text: str, place: Place, home: Home) -> str:
    """The text with its numbers, after a look at its links and pictures."""
    _at(place, lambda: check_text(text, home.folder))
    return _at(place, lambda: numbers.fill(text))


def _at(place: Place, work: Callable[[], T]) -> T:
    """The result of the work; what it complains of is said of this place."""
    try:
        return work()
    except ValueError as error:
        raise MistakeError(place, str(error)) from None


def _check_beams(lesson: Lesson, scan: Scan) -> None:
    """Raises MistakeError for a beam that the scan does not have."""
    beams = len(scan)
    for place, beam in _beams_of(lesson):
        if beam >= beams:
            raise MistakeError(
                place, f"there is no beam {beam}; {lesson.recording or 'the scan'} has beams 0 to {beams - 1}"
            )


def _beams_of(lesson: Lesson) -> Iterator[tuple[Place, int]]:
    """All beams that a lesson names, each with its place."""
    looked: list[tuple[Place, Looked]] = [(("steps", k), step) for k, step in enumerate(lesson.steps)]
    for place, each in [*looked, (("task",), lesson.task)]:
        for beam in each.near:
            yield (*place, "near"), beam
        for name, beam in each.names.items():
            yield (*place, "names", name), beam
    for k, step in enumerate(lesson.steps):
        if step.selected is not None:
            yield ("steps", k, "selected"), step.selected
    goal = lesson.task.goal
    if goal is None:
        return
    for name in ("together", "either", "apart"):
        for pair in getattr(goal, name):
            yield from ((("task", "goal", name), beam) for beam in pair)
    for name in ("inside", "outside", "selected"):
        yield from ((("task", "goal", name), beam) for beam in getattr(goal, name))
