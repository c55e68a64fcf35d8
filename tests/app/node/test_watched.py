"""A file of thresholds that changes while a node runs."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest
from lineseg_app.node import watched
from lineseg_app.node.watched import WatchedParams

from lineseg import Params
from lineseg.writers import params_text


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    monkeypatch.setattr(watched, "WRITING_SECONDS", -1.0)
    return []


def test_a_new_value_is_there_at_the_next_look(tmp_path: Path, told: list[str]):
    file = tmp_path / "tuned.yaml"
    file.write_text(params_text(Params(), "ros2"))
    watching = WatchedParams(file, Params, told.append)
    assert not watching.changed()
    file.write_text(params_text(Params(epsilon=0.05, min_points=20), "ros2"))
    assert watching.changed()
    assert Params(**watching.given) == Params(epsilon=0.05, min_points=20)
    assert told == [f"{file}: epsilon 0.03 → 0.05, min_points 10 → 20"]
    assert not watching.changed()


def test_every_beginning_of_a_file_leaves_the_old_values(tmp_path: Path, told: list[str]):
    file = tmp_path / "tuned.yaml"
    whole = params_text(Params(epsilon=0.05, epsilon_growth=0.0015), "ros2")
    file.write_text(params_text(Params(), "ros2"))
    watching = WatchedParams(file, Params, told.append)
    lines = [each.start() + after for each in re.finditer("\n", whole[:-1]) for after in (0, 1)]
    for end in (*lines, *range(0, len(whole), 29), len(whole) - 1):
        file.write_text(whole[:end])
        assert not watching.changed()
        assert Params(**watching.given) == Params()
    file.write_text(whole)
    assert watching.changed()
    assert Params(**watching.given).epsilon_growth == 0.0015


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("least_thresh: -1\n", "line 1: epsilon is -1"),
        ("min_line_points: 12\n", "it no longer has epsilon; write every threshold that it had"),
        ("", "the text is empty"),
        ("x" * (5 << 20), "it has more than 4 MB"),
        (Path.unlink, "No such file"),
        (lambda file: (file.unlink(), file.mkdir()), "it is no longer a file"),
        (lambda file: (file.unlink(), os.mkfifo(file)), "it is no longer a file"),
        (lambda file: (file.unlink(), file.symlink_to(file)), "Too many levels of symbolic links"),
    ],
)
def test_a_file_that_stays_unusable_is_told_once(tmp_path: Path, told: list[str], text: Any, words: str):
    file = tmp_path / "tuned.yaml"
    file.write_text("least_thresh: 0.05\n")
    watching = WatchedParams(file, Params, told.append)
    text(file) if callable(text) else file.write_text(text)
    assert [watching.changed() for _ in range(3)] == [False] * 3
    assert watching.given == {"epsilon": 0.05}
    (line,) = told
    assert words in line and line.endswith("; the old values stay")
    new = tmp_path / "new.yaml"
    new.write_text("least_thresh: 0.06\n")
    file.rmdir() if file.is_dir() else None
    new.replace(file)  # as many editors do
    assert watching.changed()


def test_a_file_that_cannot_be_used_at_the_start_is_an_error(tmp_path: Path, told: list[str]):
    file = tmp_path / "tuned.yaml"
    file.write_text("least_thres: 0.05\n")
    with pytest.raises(ValueError, match=r"tuned.yaml: line 1: there is no threshold 'least_thres'"):
        WatchedParams(file, Params, told.append)
