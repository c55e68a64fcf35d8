"""Pages that stand alone, of a lesson and of a frame: what they hold, and the HTML file."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

from lineseg import EXTRACTORS, Params, Recording, Thresholds
from lineseg.tracing.glossary import TERMS

from ..frame.framing import framing_near
from ..frame.geometry import extent_of, united
from ..frame.lesson_shown import BESIDE, decisions_of, frames_to_label, times_here
from ..frame.state import framing_told
from ..places import data_folder
from ..shelf.lesson import Lessons, NamedLesson, Step, Task
from ..shelf.lesson_markup import MEDIA, links
from ..shelf.lesson_numbers import METHOD
from ..shelf.lesson_shelf import LessonShelf
from ..told.answers import ExplainedTerm
from ..told.drawn import Framing
from ..told.handout import Handout, Stand
from ..told.messages import MethodEntry
from ..tuning.fit import fit
from .content import Content, rounded, usual_ranges
from .packing import packed
from .page import page_of
from .pool import SCALE
from .sheet import sheet_of

LARGEST = 3_000_000
# Decisions that can be stepped through; fewer if the file would be too large.
MOST_STEPS = (8000, 3000, 1000, 300)
LISTINGS = ("learn/listing.json", "learn/splitting.json")


def frame_page(
    recording: Recording, frame: int, label: str, method: str, params: Thresholds, step: int | None = None
) -> str:
    """The HTML page of one frame.

    frame: its number; step: the decision that it shows first. Raises ValueError if the frame has no points.
    """
    title = f"{label}, frame {frame}"
    if not recording[recording.position(frame)].valid.any():
        raise ValueError(f"frame {frame} of {label} has no points; choose another frame")

    def made(most_steps: int) -> str:
        content = Content(recording, frame, most_steps)
        stand, _ = content.stand(method, params, usual_ranges(params))
        head = {"title": title, "recording": label, "frame": frame, "step": step, "pages": [], "next": "", "index": ""}
        return _page(content, [stand], Lessons(lessons=[], terms=_terms()), head)

    return small_enough(made, title)


def lesson_page(shelf: LessonShelf, lesson: NamedLesson, next: str = "", index: str = "") -> str:
    """The HTML page of a lesson of the shelf. next, index: addresses of the page that follows it, and of the list."""
    made = partial(_lesson_page, shelf, lesson, next, index)
    return small_enough(made, f"lesson {lesson.id}")


def _lesson_page(shelf: LessonShelf, lesson: NamedLesson, next: str, index: str, most_steps: int) -> str:
    content = Content(shelf.scans_of(lesson), lesson.frame, most_steps)
    stands: dict[tuple[str, Thresholds], tuple[Stand, Any]] = {}
    pages: list[Framing | None] = []
    # A page that changes thresholds shows the sliders of the lesson; the task is where all of them are tried.
    ranged = {_thresholds(lesson, page): dict.fromkeys(lesson.knobs) for page in lesson.steps if page.params}
    last = _thresholds(lesson, lesson.task)
    ranged[last] = dict.fromkeys((*usual_ranges(last[1]), *lesson.knobs))
    for page in (*lesson.steps, lesson.task):
        key = _thresholds(lesson, page)
        if key not in stands:
            stands[key] = content.stand(*key, list(ranged.get(key, ())))
        framing = framing_near(stands[key][1], page.near, page.names)
        pages.append(framing and rounded(framing_told(framing)))
    told = Lessons(lessons=[lesson], terms=_terms())
    head = {"title": lesson.title, "recording": lesson.recording, "frame": lesson.frame, "lesson": lesson.id}
    head |= {"pages": pages, "next": next, "index": index}
    answers = _pictures(shelf, lesson) | shown_in(content, lesson)
    sheet = sheet_of(shelf, lesson, lambda name: answers[f"picture:{name}"])
    return _page(content, [stand for stand, _ in stands.values()], told, head, answers, sheet)


def shown_in(content: Content, lesson: NamedLesson) -> dict[str, str]:
    """What the page would ask the server for what texts let one try, by address."""
    shows = {page.show for page in (*lesson.steps, lesson.task)}
    usual = _thresholds(lesson, lesson.task)[1]
    answers: dict[str, Any] = {}
    if "noise" in shows:
        answers["noise?session="] = next(fit(content.recording, usual, METHOD, np.zeros(1, np.bool_)))
    if "times" in shows:
        answers["times?session="] = times_here(content.recording)
    if "label" in shows:
        answers["frames?session="] = frames_to_label(content.recording, usual)
    for method in BESIDE if "beside" in shows else ():
        answers[f"decisions?session=&method={method}"] = decisions_of(content.scan, method)
    return {f"/api/lessons/{address}": json.dumps(answer, allow_nan=False) for address, answer in answers.items()}


def _pictures(shelf: LessonShelf, lesson: NamedLesson) -> dict[str, str]:
    """The pictures in the texts of a lesson, as data, by what the page asks for."""
    task = lesson.task
    texts = [*(step.text for step in lesson.steps), task.text, task.hint, task.done]
    texts += [text for option in task.choice for text in (option.text, option.why)]
    pictures = {}
    for name in {target for text in texts for is_picture, _, target in links(text) if is_picture}:
        path = shelf.picture(lesson.id, name)
        data = base64.b64encode(path.read_bytes()).decode()
        pictures[f"picture:{name}"] = f"data:{MEDIA[path.suffix.lower()]};base64,{data}"
    return pictures


def _thresholds(lesson: NamedLesson, page: Step | Task) -> tuple[str, Thresholds]:
    """The method and its thresholds on a page of a lesson."""
    if isinstance(page, Step) and page.method:
        return page.method, EXTRACTORS[page.method].params_type()
    return METHOD, Params().but(**lesson.params | page.params)


def _page(
    content: Content,
    stands: list[Stand],
    lessons: Lessons,
    head: dict[str, Any],
    answers: Mapping[str, str] = MappingProxyType({}),
    sheet: str = "",
) -> str:
    """answers: more of them than every page has. sheet: the lesson on paper."""
    light, dark = content.pool.palettes
    x1, y1, x2, y2 = united(extent_of(content.scan, content.bounds), (0.0, 0.0, 0.0, 0.0))
    methods = dict.fromkeys([METHOD, *(stand["method"] for stand in stands)])
    common: dict[str, Any] = {
        "lesson": "",
        "step": None,
        "box": (x1, y1, x2, y2),
        "unit": 1 / SCALE,
        "x": content.x,
        "y": content.y,
        "light": light,
        "dark": dark,
        "looks": content.pool.looks,
        "methods": [MethodEntry.of(EXTRACTORS[name]).model_dump(mode="json") for name in methods],
        "stands": stands,
        "results": content.results,
        "segments": content.segments,
        "answers": {
            "/api/lessons": lessons.model_dump_json(),
            **{f"lineseg:/{name}": (data_folder("static") / name).read_text("utf-8") for name in LISTINGS},
            **answers,
        },
    }
    handout: Handout = {**common, **head}  # pyright: ignore[reportAssignmentType]
    return page_of(handout["title"], packed(handout, content.pool.arrays()), sheet)


def small_enough(made: Callable[[int], str], what: str) -> str:
    """The page with as many decisions as fit."""
    for most in MOST_STEPS:
        page = made(most)
        if len(page.encode()) <= LARGEST:
            return page
    raise ValueError(f"{what} is too large for one file: it would have more than {LARGEST / 1e6:g} MB")


def _terms() -> list[ExplainedTerm]:
    return [ExplainedTerm(**term._asdict()) for term in TERMS]
