"""Lessons as data: every file is valid, and the decisions it shows exist."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pytest
from lineseg_app.places import data_folder
from lineseg_app.shelf.lesson import NamedLesson
from lineseg_app.shelf.lesson_numbers import found
from lineseg_app.shelf.lesson_shelf import LessonShelf
from lineseg_app.shelf.lessons import lesson_files, read_lessons, scan_of
from live import Address
from taught import taught

from lineseg import Params, trace

LESSONS = taught()


def test_every_file_is_a_lesson():
    assert LESSONS.broken == []
    assert len(LESSONS.lessons) >= 8
    assert len({lesson.title for lesson in LESSONS.lessons}) == len(LESSONS.lessons)


@pytest.mark.parametrize("lesson", LESSONS.lessons, ids=lambda lesson: lesson.id)
def test_every_decision_that_a_lesson_shows_exists(lesson: NamedLesson):
    scan, base = scan_of(lesson), Params().but(**lesson.params)
    for step in lesson.steps:
        params = base.but(**step.params)
        if step.find is not None:
            matching = found(trace(scan, params), step.find)
            assert -len(matching) <= step.find.nth < len(matching), step.text
        assert step.selected is None or step.selected < len(scan)


@pytest.mark.parametrize("lesson", LESSONS.lessons, ids=lambda lesson: lesson.id)
def test_a_task_offers_the_thresholds_it_wants_changed(lesson: NamedLesson):
    known = {name for name, _, _ in Params.knobs()}
    assert set(lesson.knobs) <= known
    assert lesson.task.goal is None or set(lesson.task.goal.changed) <= set(lesson.knobs)


def test_a_file_that_is_not_a_lesson_is_named_with_its_error(tmp_path: Path):
    good = lesson_files()[0]
    (tmp_path / "bad.json").write_text(good.read_text("utf-8").replace('"about"', '"abuot"'), "utf-8")
    (tmp_path / "worse.json").write_text("{", "utf-8")
    told = read_lessons([good, tmp_path / "bad.json", tmp_path / "worse.json"])
    assert [lesson.id for lesson in told.lessons] == [good.stem]
    assert [why.split(":")[0] for why in told.broken] == ["bad.json", "worse.json"]
    assert "abuot" in told.broken[0] or "about" in told.broken[0]


def line_with(text: str, words: str) -> int:
    """The number of the first line that has these words, from 1."""
    return next(number for number, line in enumerate(text.splitlines(), 1) if words in line)


@pytest.mark.parametrize(
    ("written", "complaint"),
    [
        ("{epsilom}", "step 1, text: {epsilom} is not known; there is delta.beam, delta.count, beams"),
        ("{beam}", "step 1, text: {beam} is not known"),
        ("{delta.bean}", "step 1, text: {delta.bean} is not known"),
        ("{epsilon:inch}", "step 1, text: {epsilon:inch} has no unit of mm, cm, deg"),
    ],
)
def test_a_number_that_cannot_be_put_in_is_named_with_what_is_known(tmp_path: Path, written: str, complaint: str):
    text = lesson_files()[0].read_text("utf-8").replace("{returns}", written)
    (tmp_path / "mine.json").write_text(text, "utf-8")
    (why,) = read_lessons([tmp_path / "mine.json"]).broken
    assert why.startswith(f"mine.json:{line_with(text, written)}: {complaint}")


def test_a_beam_that_the_scan_does_not_have_is_named_with_its_place(tmp_path: Path):
    text = lesson_files()[4].read_text("utf-8").replace('"selected": [\n        56', '"selected": [\n        111')
    (tmp_path / "mine.json").write_text(text, "utf-8")
    (why,) = read_lessons([tmp_path / "mine.json"]).broken
    line = line_with(text, '"selected"')
    assert why == f"mine.json:{line}: task.goal.selected: there is no beam 111; lesson:9_wide_corner has beams 0 to 110"


def test_the_server_offers_the_lessons_in_order(server: Address):
    told = server.get("/api/lessons").json()
    assert [lesson["id"] for lesson in told["lessons"]] == [file.stem for file in lesson_files()]


def test_the_id_of_a_lesson_is_no_path(tmp_path):
    lesson, shelf = lesson_files()[0], LessonShelf()
    assert shelf.looked_at(lesson.stem, 0) is not None
    elsewhere = shutil.copy(lesson, tmp_path / "elsewhere.json")
    path = os.path.relpath(elsewhere, lesson.parent).removesuffix(".json")
    assert shelf.looked_at(path, 0) is None
    assert shelf.looked_at(str(elsewhere).removesuffix(".json"), 0) is None


def test_the_readme_says_where_each_equation_figure_table_and_algorithm_of_the_paper_is():
    readme = (data_folder("sample_scans") / "lessons" / "README.md").read_text("utf-8")
    rows = [row.split("|")[1:3] for row in readme.splitlines() if re.match(r"\| (Eq|Alg|Fig|Tab)", row)]
    found: dict[str, set[int]] = {}
    for what, where in rows:
        for kind, numbers in re.findall(r"(Eq|Algorithm|Fig|Table)s?\.? ([\d, –]+)", what):
            for first, last in re.findall(r"(\d+)(?:–(\d+))?", numbers):
                found.setdefault(kind, set()).update(range(int(first), int(last or first) + 1))
        assert all(1 <= int(lesson) <= len(lesson_files()) for lesson in re.findall(r"\b\d+\b", where)), where
    assert found == {
        kind: set(range(1, n + 1)) for kind, n in (("Eq", 10), ("Algorithm", 3), ("Fig", 10), ("Table", 4))
    }
