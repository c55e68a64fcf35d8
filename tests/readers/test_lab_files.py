"""One room in the forms that a laboratory has: each gives the same points, or says what it is instead."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from lineseg import open_recording

BEARINGS = np.deg2rad(np.arange(-90.0, 91.0))
RANGES = np.round(2.0 + np.where(np.arange(181) < 60, 1.0, 0.3) + 0.004 * np.arange(181), 3)
DEGREES = np.rad2deg(BEARINGS)


def beams(head: str, encoding: str = "utf-8", order=range(181), scale: float = 1.0, turn: float = 1.0) -> bytes:
    rows = [f"{turn * DEGREES[beam]:.3f},{scale * RANGES[beam]:.3f}" for beam in order]
    return "\n".join([head, *rows, ""]).encode(encoding)


def row(mark: str = ",", end: str = "") -> str:
    return mark.join(f"{each:.3f}{end}" for each in RANGES)


FORMS = {
    "japanese": beams("角度(度),距離(mm)", scale=1000),
    "of Windows in Japan": beams("角度[deg],距離[mm]", "shift_jis", scale=1000),
    "spanish": beams("ángulo (grados),distancia (m)"),
    "shuffled": beams("angle_deg,range_m", order=np.random.default_rng(1).permutation(181).tolist()),
    "list in a log": f"[INFO] [1600000000.1] [node]: ranges: [{row()}]\n".encode() * 3,
    "pairs": f"{row(',', ',47')}\n".encode() * 3,
    "columns with units": ("t," + ",".join(f"dist_{beam:03d}_mm" for beam in range(181)) + "\n"
                           + "".join(f"{t}," + ",".join(f"{1000 * each:.0f}" for each in RANGES) + "\n"
                                     for t in range(3))).encode(),
    "words for no return": re.sub(r"3\.[01][24]\d", "OL", row()).encode(),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_a_scan_gives_its_points(tmp_path: Path, form: str):
    file = tmp_path / "scan.log"
    file.write_bytes(FORMS[form])
    scan = open_recording(file)[0]
    assert len(scan) == 181
    assert np.rad2deg(scan.bearings[[0, -1]]) == pytest.approx([-90, 90], abs=0.01)
    assert scan.ranges[scan.valid] == pytest.approx(RANGES[scan.valid], abs=0.002)
    assert scan.valid.sum() >= 150


def test_gon_of_a_whole_turn_are_told_from_degrees(tmp_path: Path):
    file = tmp_path / "gon.csv"
    file.write_text("".join(f"{10 * beam / 9:.3f},{2 + 0.01 * abs(beam - 180):.3f}\n" for beam in range(360)))
    recording = open_recording(file)
    assert (len(recording), recording.beams) == (1, (360, 360))
    assert recording[0].full_circle


def test_scans_in_the_columns_of_an_npz_are_turned(tmp_path: Path):
    step = BEARINGS[1] - BEARINGS[0]
    np.savez(tmp_path / "a.npz", ranges=np.tile(RANGES[:, None], 4), angle_min=BEARINGS[0], angle_increment=step)
    recording = open_recording(tmp_path / "a.npz")
    assert (len(recording), recording.beams) == (4, (181, 181))


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"MATLAB 7.3 MAT-file, Platform: GLNXA64" + bytes(99), "a MATLAB file"),
        (b"FEA1" + bytes(99), "an Arrow table"),
        (b"\0\0\0\x20ftypisom" + bytes(99), "a video or sound"),
        (b"solid part\n facet normal 0 0 1\n  outer loop\n", "a 3D model"),
        (b"x1,y1,x2,y2\n" + b"1,2,3,4\n2,3,4,5\n" * 20, "has lines from one point to another"),
    ],
)
def test_what_is_no_recording_is_named(tmp_path: Path, content: bytes, what: str):
    file = tmp_path / "file"
    file.write_bytes(content)
    with pytest.raises(ValueError, match=what):
        open_recording(file)
