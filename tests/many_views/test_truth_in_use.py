"""The truth by many views where recordings are read: asked for, kept apart from other truth, told, and refused."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main

from lineseg import Recording, open_recording, save_npz, simulate
from lineseg.poses import Track
from lineseg.simulate import UTM_30LX, box, room

WORLD = room([(0, 0), (7, 0), (7, 5), (0, 5)]) + box((3.4, 4.7), 1.2, 0.5)
LASER = replace(UTM_30LX, beams=181, angle_increment=6 * UTM_30LX.angle_increment)


@pytest.fixture(scope="module")
def drive() -> Recording:
    stamps = 0.5 * np.arange(24)
    poses = simulate.drive((1.5, 1.2, 0.0), [(8, 0.45, 0.0), (4, 0.2, 0.8)], stamps)
    return simulate.record(lambda stamp: WORLD, poses, stamps, LASER, np.random.default_rng(5), "drive")


@pytest.fixture
def file(drive, tmp_path) -> Path:
    """Scans with poses and without truth."""
    save_npz(replace(drive, wall=None, walls=None), tmp_path / "drive.npz")
    return tmp_path / "drive.npz"


def test_a_file_gets_it_only_where_it_is_asked_for_and_no_truth_is_there(drive, file, tmp_path):
    assert open_recording(file).wall is None
    made = open_recording(file, walls="by-views")
    assert made.wall is not None
    assert made.walls is not None
    assert re.match(r"\d+ walls, .* The walls hold together", made.wall_source)
    assert made.account is not None
    assert made.account.notices[0].text == f"Truth by many views: {made.wall_source}"
    save_npz(drive, tmp_path / "exact.npz")
    exact = open_recording(tmp_path / "exact.npz", walls="by-views")
    assert np.array_equal(exact.wall, drive.wall)
    assert exact.wall_source == ""


def test_a_file_keeps_what_is_said_of_it(file, tmp_path):
    made = open_recording(file, walls="by-views", frames="2:20")
    save_npz(made, tmp_path / "made.npz")
    again = open_recording(tmp_path / "made.npz")
    assert np.array_equal(again.wall, made.wall)
    assert again.wall_source == made.wall_source


def test_reading_can_be_stopped_while_it_is_made(file):
    told = []

    def stop(done: int, total: int) -> None:
        told.append((done, total))
        if len(told) > 5:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        open_recording(file, walls="by-views", progress=stop)


def test_without_poses_it_says_why_there_is_none(drive, tmp_path):
    save_npz(replace(drive, wall=None, walls=None, track=None), tmp_path / "bare.npz")
    with pytest.raises(ValueError, match=r"^bare.npz has no poses .*--poses FILE reads a trajectory"):
        open_recording(tmp_path / "bare.npz", walls="by-views")


COMMANDS = [
    ("score",),
    ("compare", "--methods", "region-growing", "--budget", "0", "--most-frames", "8"),
    ("tune", "--trials", "1", "--most-frames", "8"),
    ("sweep", "--epsilon", "0.02,0.03", "-o", "{}/sweep.csv"),
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_take_it_by_themselves_and_say_so(command, file, tmp_path, capsys):
    assert main([command[0], str(file), *(word.format(tmp_path) for word in command[1:])]) == 0
    told = capsys.readouterr()
    assert "lineseg: drive.npz: truth by many views: " in told.err
    assert ("by many views" in told.out) == (command[0] in {"score", "compare"})


@pytest.mark.parametrize("command", COMMANDS[1:])
def test_commands_go_on_without_it_if_it_is_not_wanted(command, file, tmp_path, capsys):
    words = [word.format(tmp_path) for word in command[1:]]
    assert main([command[0], str(file), *words, "--walls", "none"]) == 0
    assert "many views" not in "".join(capsys.readouterr())


def test_tuning_without_truth_makes_none(file, capsys):
    assert main(["tune", str(file), "--trials", "1", "--most-frames", "8", "--objective", "label-free"]) == 0
    assert "many views" not in capsys.readouterr().err


def test_commands_say_why_they_go_on_without_it(drive, tmp_path, capsys):
    still = replace(drive, wall=None, walls=None, track=Track.of(0 * drive.poses, drive.pose_source))
    save_npz(still, tmp_path / "still.npz")
    assert main(["compare", str(tmp_path / "still.npz"), "--methods", "region-growing", "--budget", "0"]) == 0
    assert re.search(r"still.npz: no truth by many views: .* the robot stands still", capsys.readouterr().err)
    assert main(["score", str(tmp_path / "still.npz")]) != 0
