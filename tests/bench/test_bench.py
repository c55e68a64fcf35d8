"""The times measure what they claim, and are written as a table or JSON."""

import json
import shlex
import sys

import numpy as np
import pytest
from lineseg_app.__main__ import main
from scenes import corner, room
from waiting import SECONDS

from lineseg import Params, Recording, save_npz
from lineseg.bench import bench, table
from lineseg.bench.against import Against, AgainstError
from lineseg.bench.timing import floor_pass

NAMES = ["floor", "kernel", "extract", "trace", "survey", "survey with scores"]


@pytest.fixture(scope="module")
def recording():
    return Recording.from_scans([corner(noise=0.01), room(noise=0.01)] * 5, name="corners")


@pytest.fixture(autouse=True)
def short_survey(monkeypatch):
    """What is measured is the same."""
    monkeypatch.setattr("lineseg.bench.timing.SURVEY_BEAMS", 40_000)


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


def program(tmp_path, body):
    """The command of a program that does `body` for each `frame` that it reads."""
    path = tmp_path / "peer.py"
    path.write_text(f"import json, sys\nfor line in sys.stdin:\n    frame = json.loads(line)\n    {body}\n")
    return f"{shlex.quote(sys.executable)} -S -u {shlex.quote(str(path))}"


def test_another_program_is_timed_on_the_same_frames(recording, tmp_path):
    tells_returns = program(tmp_path, "print(json.dumps({'us': sum(r is not None for r in frame['ranges'])}))")
    *ours, other = bench(recording, rounds=2, against=tells_returns)
    assert [timing.name for timing in ours] == NAMES
    returns = [np.count_nonzero(scan.valid) for scan in recording]
    assert (other.name, other.min_us, other.max_us) == ("against", min(returns), max(returns))


def test_without_times_of_its_own_the_time_there_and_back_counts(recording, tmp_path):
    with Against(program(tmp_path, "print(len(frame['bearings']))"), list(recording)) as other:
        assert np.all(other.run() > 0)


@pytest.mark.parametrize(
    ("body", "patience", "said"),
    [
        ("print(json.dumps({'us': -1}))", SECONDS, 'answered "us": -1; expected a time above 0'),
        ("sys.exit(3)", SECONDS, "ended with code 3; expected one line for each frame"),
        ("sys.stdin.read()", 0.3, "was silent for 0.3 s"),
    ],
)
def test_a_program_that_cannot_be_timed_is_told(body, patience, said, recording, tmp_path):
    with (
        Against(program(tmp_path, body), [recording[0]], patience=patience) as other,
        pytest.raises(AgainstError, match=said) as told,
    ):
        other.run()
    assert str(told.value).startswith("Frame 0: --against")


@pytest.mark.parametrize("command", ["", "no-such-program-here --fast", "'"])
def test_a_program_that_cannot_be_started_is_told(command, tmp_path, capsys):
    path = tmp_path / "corners.npz"
    save_npz(Recording.from_scans([corner(noise=0.01)] * 3), path)
    assert main(["bench", str(path), "--against", command]) == 2
    assert f"--against {command!r} cannot be started" in capsys.readouterr().err
