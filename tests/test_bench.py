"""The times measure what they claim, and are written as a table or JSON."""

import json

import numpy as np
import pytest
from lineseg_app.__main__ import main
from scenes import corner, room

from lineseg import Params, Recording, save_npz
from lineseg.bench import bench, floor_pass, table

NAMES = ["floor", "kernel", "extract", "trace", "survey", "survey with scores"]


@pytest.fixture(scope="module")
def recording():
    return Recording.from_scans([corner(noise=0.01), room(noise=0.01)] * 5, name="corners")


@pytest.fixture(autouse=True)
def short_survey(monkeypatch):
    """What is measured is the same."""
    monkeypatch.setattr("lineseg.bench.SURVEY_BEAMS", 40_000)


def test_everything_is_timed_beside_the_floor(recording):
    timings = bench(recording, rounds=2)
    assert [timing.name for timing in timings] == NAMES
    assert timings[0].ratio == 1
    for timing in timings:
        assert 0 < timing.min_us <= timing.median_us <= timing.p95_us <= timing.max_us
        assert timing.frames_per_s == pytest.approx(1e6 / timing.median_us)
        assert timing.ratio > 0
        assert timing.cores >= 1


def test_the_table_has_a_line_for_each(recording):
    timings = bench(recording, rounds=1)
    lines = table(timings).splitlines()
    assert len(lines) == 1 + len(NAMES)
    assert all(line.startswith(name) for line, name in zip(lines[1:], NAMES, strict=True))
    assert len({len(line) for line in lines}) == 1


def test_the_floor_of_a_scan_without_points_is_nothing():
    assert floor_pass(np.empty(0), np.empty(0)) == 0


def test_the_command_writes_a_table_or_json(recording, tmp_path, capsys):
    path = tmp_path / "corners.npz"
    save_npz(Recording.from_scans([corner(noise=0.01)] * 3), path)
    assert main(["bench", str(path)]) == 0
    heading, columns, floor, *_ = capsys.readouterr().out.splitlines()
    assert heading == "corners.npz, 180 beams"
    assert "× floor" in columns
    assert floor.startswith("floor")
    assert main(["bench", str(path), "--json"]) == 0
    (report,) = json.loads(capsys.readouterr().out)
    assert (report["file"], report["frames"], report["beams"]) == ("corners.npz", 3, [180, 180])
    assert [timing["name"] for timing in report["timings"]] == NAMES
    assert report["params"] == Params().numbers()


def test_the_thresholds_may_be_given(tmp_path, capsys):
    path = tmp_path / "corners.npz"
    save_npz(Recording.from_scans([corner(noise=0.01)] * 3), path)
    assert main(["bench", str(path), "--json", "--max-occluder", "0", "--merge-rms", "0"]) == 0
    (report,) = json.loads(capsys.readouterr().out)
    assert report["params"] == Params(max_occluder=0, merge_rms=0).numbers()


def test_a_recording_that_is_not_there_is_said_to_be_missing(tmp_path, capsys):
    assert main(["bench", str(tmp_path / "none.npz")]) == 2
    assert "there is no such file" in capsys.readouterr().err
