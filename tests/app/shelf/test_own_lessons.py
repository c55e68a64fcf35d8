"""Lessons of one's own: from a folder, dropped on the page, or made of what a tab shows."""

from __future__ import annotations

import asyncio
import json
import logging
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lineseg_app.places import data_folder
from lineseg_app.shelf import lesson_shelf
from lineseg_app.shelf.lesson_draft import drafted
from lineseg_app.shelf.lesson_shelf import LessonShelf
from lineseg_app.shelf.lessons import Home, read_lesson, scan_of
from lineseg_app.view import View
from live import Address

from lineseg import open_recording, save_npz, trace

PIXEL = bytes.fromhex("89504e470d0a1a0a0000000d4948445200000001000000010806000000")


def lesson(**changed: Any) -> dict[str, Any]:
    """A small lesson about two walls."""
    fields = {
        "title": "Mine",
        "about": "A corner.",
        "recording": "lesson:1_perfect_corner",
        "steps": [{"text": "There are {lines} lines."}],
        "task": {
            "text": "How many lines are there?",
            "hint": "Count them.",
            "done": "Yes.",
            "number": {"answer": "{lines}"},
        },
    }
    return fields | changed


def written(folder: Path, told: dict[str, Any] | str, name: str = "mine.json") -> Path:
    path = folder / name
    path.write_text(told if isinstance(told, str) else json.dumps(told, indent=1), "utf-8")
    return path


def complaint(folder: Path, told: dict[str, Any] | str) -> str:
    path = written(folder, told)
    with pytest.raises(ValueError, match=r"mine\.json") as wrong:
        read_lesson(path, Home(folder))
    return str(wrong.value)


def step(**fields: Any) -> dict[str, Any]:
    return lesson(steps=[{"text": "Look."}, {"text": "Here.", **fields}])


def task(**kind: Any) -> dict[str, Any]:
    return lesson(task={"text": "What?", "hint": "Look.", "done": "Yes.", **kind})


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ('{"title": "Mine",\n "about" "A corner."}', "mine.json:2: this is not JSON: expecting ':' delimiter"),
        (
            step(fidn={}),
            "step 2 has no 'fidn'; it may have near, names, show, text, why, method, find, params, selected",
        ),
        (step(find={"kind": "seed fund"}), "step 2, find.kind is 'seed fund': choose from seed rejected, seed found"),
        (step(find={"kind": "lines merged"}), "step 2, find: there is no “lines merged” with these properties"),
        (step(params={"epsilon": -1}), "step 2, params: epsilon"),
        (step(near=[4000]), "step 2, near: there is no beam 4000; lesson:1_perfect_corner has beams 0 to 120"),
        (lesson(about=""), "about is '': string should have at least 1 character"),
        (lesson(recording=""), "a lesson has either recording or scan"),
        (lesson(recording="hallway"), "recording is 'hallway'; it must be lesson:NAME or sample:NAME of the program"),
        (lesson(recording="folder:run.npz"), "recording: there is no run.npz beside the lesson; put it there"),
        (lesson(frame=3), "frame is 3, but lesson:1_perfect_corner has 1 frame"),
        (lesson(steps=[{"text": "![a wall](wall.png)"}]), "there is no wall.png beside the lesson"),
        (lesson(steps=[{"text": "[look](javascript:alert`1`)"}]), "must begin with https://, http:// or lesson:"),
        (lesson(steps=[{"text": "![](wall.png)"}]), "(wall.png) has no words in its square brackets"),
        (task(), "a task has one of goal, choice and number; this one has none"),
        (task(choice=[{"text": "1"}, {"text": "2"}]), 'some of the answers to choose must have "right": true'),
        (
            task(goal={"lines": [90, 99], "changed": ["epsilon", "delta"]}),
            "task.goal: no value of epsilon or delta alone does what is asked",
        ),
        (task(goal={"changed": ["epsilonn"]}), "task.goal.changed is 'epsilonn': choose from epsilon, delta"),
        (lesson(knobs=["epsilon"] * 99), "knobs is"),
        (lesson(decisions={"a\n" + "b" * 200: {"kind": "x"}}), f"decisions.a {'b' * 58}….kind is 'x': choose from"),
        (task(number={"answer": "many"}), "task.number.answer: 'many' does not begin with a number, such as 45 mm"),
    ],
)
def test_a_mistake_is_told_with_its_line_what_was_found_and_what_is_expected(
    tmp_path: Path, told: dict[str, Any] | str, words: str
):
    assert words in complaint(tmp_path, told)


def test_the_line_is_that_of_the_mistake(tmp_path: Path):
    said = complaint(tmp_path, step(find={"kind": "seed found", "direction": 7}))
    line = int(said.split(":")[1])
    assert '"direction": 7' in (tmp_path / "mine.json").read_text().splitlines()[line - 1]


@pytest.mark.parametrize("name", ["../secret.png", "/etc/secret.png", "..\\secret.png", "link.png", "secret.txt"])
def test_a_picture_is_a_picture_in_the_folder_of_the_lesson(tmp_path: Path, name: str):
    folder = tmp_path / "lessons"
    folder.mkdir()
    (tmp_path / "secret.png").write_bytes(PIXEL)
    (folder / "secret.txt").write_bytes(PIXEL)
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    (folder / "wall.png").write_bytes(PIXEL)
    written(folder, lesson(steps=[{"text": "![a wall](wall.png)"}]))
    shelf = LessonShelf(folder)
    assert shelf.picture("mine", "wall.png").read_bytes() == PIXEL
    with pytest.raises(ValueError, match=r"picture|beside|folder"):
        shelf.picture("mine", name)
    assert words_of_picture(folder, name)


def words_of_picture(folder: Path, name: str) -> str:
    return complaint(folder, lesson(steps=[{"text": f"![a wall]({name})"}]))


def test_a_folder_adds_lessons_and_its_mistakes_are_told_in_the_terminal_once(tmp_path: Path, caplog):
    path = written(tmp_path, lesson())
    written(tmp_path, lesson(title=""), "wrong.json")
    written(tmp_path, lesson(), "01_seed.json")
    shelf = LessonShelf(tmp_path)
    with caplog.at_level(logging.WARNING):
        shelf.told()
        told = shelf.told()
    assert [each.id for each in told.lessons if each.own] == ["mine"]
    assert sorted(said.split(":")[0] for said in caplog.messages) == ["01_seed.json", "wrong.json"]
    # What is corrected is there without a new start.
    written(tmp_path, lesson(title="Corrected"), "wrong.json")
    path.unlink()
    told = shelf.told()
    assert [each.title for each in told.lessons if each.own] == ["Corrected"]
    shelf.close()


def test_a_lesson_is_about_a_recording_beside_it(tmp_path: Path):
    hallway = open_recording(data_folder("sample_scans") / "hallway.npz")
    save_npz(hallway, tmp_path / "run.npz")
    written(tmp_path, lesson(recording="folder:run.npz", frame=5))
    shelf = LessonShelf(tmp_path)
    found = shelf.find("mine")
    assert found is not None
    assert shelf.recording(found.recording) == tmp_path / "run.npz"
    assert (shelf.title_of(found.recording), shelf.title_of("own:none")) == ("Mine", "")
    assert found.task.number is not None
    assert found.task.number.answer == str(len(trace(hallway[5], method_of_lessons()).extraction.segments))
    shelf.close()


def method_of_lessons():
    from lineseg_app.shelf.lesson import USUAL

    from lineseg import Params

    return Params().but(**USUAL)


def test_a_lesson_made_of_what_a_tab_shows_contains_its_scan_and_finds_its_decision(tmp_path: Path):
    scan = open_recording(data_folder("sample_scans") / "hallway.npz")[7]
    traced = trace(scan)
    for index in (3, len(traced) // 2, len(traced) - 1):
        for id in ("upload:x", "sample:hallway"):
            view = View().patched({"recording": id, "frame": 7, "step": index})
            made = drafted(view, scan, traced, None)
            told = lesson(**{"params": {}, "recording": "", **made})
            told["steps"][0]["text"] = "It is beam {first}."
            home = Home(tmp_path, scans=lambda: tmp_path)
            read = read_lesson(written(tmp_path, told), home)
            again = trace(scan_of(read, home), type(traced.params)().but(**read.params))
            assert [each.text for each in again] == [each.text for each in traced]
            assert read.steps[0].text == f"It is beam {traced[index].first}."


def test_the_part_of_the_plan_that_was_looked_at_is_kept():
    scan = open_recording(data_folder("sample_scans") / "hallway.npz")[7]
    view = View().patched({"recording": "sample:hallway", "frame": 7})
    x, y = scan.xy[100]
    (step,) = drafted(view, scan, trace(scan), (x - 1, y - 1, x + 1, y + 1))["steps"]
    assert np.abs(scan.xy[step["near"]] - (x, y)).max() < 1
    (step,) = drafted(view, scan, trace(scan), (-99, -99, 99, 99))["steps"]
    assert "near" not in step


def test_dropped_files_are_a_lesson_with_its_pictures_until_one_has_a_mistake(server: Address):
    def drop(name: str, content: bytes, into: str = "") -> str:
        return server.post(f"/api/lessons/file?name={name}&into={into}", content=content).json()["folder"]

    folder = drop("mine.json", json.dumps(lesson(steps=[{"text": "![a wall](wall.png)"}])).encode())
    drop("wall.png", PIXEL, folder)
    (opened,) = server.post(f"/api/lessons/open?folder={folder}").json()
    assert server.get("/api/lessons/one", params={"id": opened["id"]}).json() == opened
    picture = server.get("/api/lessons/picture", params={"id": opened["id"], "name": "wall.png"})
    assert (picture.content, picture.headers["content-type"]) == (PIXEL, "image/png")
    assert server.get("/api/lessons/picture", params={"id": opened["id"], "name": "mine.json"}).status_code == 404
    # Others are not offered it.
    assert opened["id"] not in [each["id"] for each in server.get("/api/lessons").json()["lessons"]]
    wrong = drop("mine.json", json.dumps(lesson(title="")).encode())
    answer = server.post(f"/api/lessons/open?folder={wrong}")
    assert answer.status_code == 400
    assert answer.json()["message"].startswith("mine.json:1: title is ''")


def test_of_dropped_lessons_that_others_have_replaced_nothing_is_kept(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(lesson_shelf, "MOST_DROPPED", 2)
    scan = {"angle_min": -0.5, "angle_increment": 0.01, "range_min": 0.0, "range_max": 30.0}
    shelf, files = LessonShelf(), []

    async def drop(number: int) -> None:
        async def content():
            ranges = (2.0 / np.cos(np.arange(-0.5, 0.5, 0.01)) + number).tolist()
            told = lesson(scan=scan | {"ranges": ranges})
            del told["recording"]
            yield json.dumps(told).encode()

        (opened,) = shelf.open_dropped(await shelf.receive("mine.json", None, content(), ""))
        assert shelf.find(opened.id) == opened
        files.append(shelf.recording(opened.recording))

    for number in range(4):
        asyncio.run(drop(number))
    assert [file.exists() for file in files] == [False, False, True, True]
    assert len(shelf._paths) == 2
    assert len(shelf._known) <= 2
    shelf.close()


def test_a_missing_file_is_told_with_those_that_may_have_been_meant(tmp_path: Path):
    for name in ("other.json", "b.png", "a.txt"):
        (tmp_path / name).touch()
    told = complaint(tmp_path, lesson(steps=[{"text": "![a wall](wall.png)"}]))
    assert told.endswith("there is no wall.png beside the lesson; there is b.png, a.txt")


def test_a_beam_that_is_not_there_is_told_of_the_recording_that_the_author_named(tmp_path: Path):
    shutil.copy(data_folder("sample_scans") / "lessons" / "1_perfect_corner.npz", tmp_path / "run.npz")
    near = step(near=[4000]) | {"recording": "folder:run.npz"}
    assert "there is no beam 4000; folder:run.npz has beams 0 to 120" in complaint(tmp_path, near)
