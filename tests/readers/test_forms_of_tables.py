"""One room in tables as loggers, spreadsheets and simulators lay them out; and what only looks like a scan."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lineseg import open_recording
from lineseg.scan import Recording

DEGREES = np.arange(-90.0, 91.0)
BEARINGS = np.deg2rad(DEGREES)
X, Y = np.cos(BEARINGS), np.sin(BEARINGS)
with np.errstate(divide="ignore"):
    NEAR = np.round(np.minimum(2.9 / X, np.minimum(np.where(Y > 0, 1.7, 2.2) / np.abs(Y), 6.0)), 3)
FAR = np.round(NEAR + 0.4, 3)
SCANS = np.array([NEAR, FAR])


def read(folder: Path, content: str | bytes, name: str = "a.csv", **given) -> Recording:
    file = folder / name
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    return open_recording(file, **given)


def lines(*columns, mark: str = ",", form: str = "{:.6g}") -> str:
    return "".join(mark.join(form.format(cell) for cell in row) + "\n" for row in zip(*columns, strict=True))


def row(values, mark: str = ",") -> str:
    return mark.join(f"{each:.6g}" for each in values)


def points(ranges) -> list[float]:
    return np.round(np.column_stack((ranges * X, ranges * Y)), 4).ravel().tolist()


FORMS = {
    "pairs of columns": "angle1,dist1,angle2,dist2\n" + lines(DEGREES, NEAR, DEGREES, FAR),
    "points in a row": "t," + ",".join(f"p{beam}_x,p{beam}_y" for beam in range(181)) + "\n"
    + "".join(f"{at},{row(points(ranges))}\n" for at, ranges in enumerate(SCANS)),
    "limits beside": "scan,angle_deg,min_range,max_range,d_err,range\n"
    + lines(np.repeat([0, 1], 181), np.tile(DEGREES, 2), np.full(362, 0.05), np.full(362, 30), np.zeros(362),
            SCANS.ravel()),
    "units alone": "scan,deg,inches\n" + lines(np.repeat([0, 1], 181), np.tile(DEGREES, 2), SCANS.ravel() / 0.0254),
    "plurals": "scan,angles,ranges\n" + lines(np.repeat([0, 1], 181), np.tile(DEGREES, 2), SCANS.ravel()),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_every_layout_gives_the_scans(tmp_path: Path, form: str):
    recording = read(tmp_path, FORMS[form])
    assert (len(recording), recording.beams) == (2, (181, 181))
    for scan, ranges in zip(recording, SCANS, strict=True):
        assert np.rad2deg(scan.bearings) == pytest.approx(DEGREES, abs=0.02)
        assert scan.ranges == pytest.approx(ranges, abs=2e-3)


def test_columns_called_after_two_lasers_are_not_mixed(tmp_path: Path):
    text = "front_angle,front_range,rear_angle,rear_range\n" + lines(DEGREES, NEAR, DEGREES, FAR)
    assert read(tmp_path, text)[0].ranges == pytest.approx(NEAR, abs=1e-5)
    assert read(tmp_path, text, frame_id="rear")[0].ranges == pytest.approx(FAR, abs=1e-5)


TIMES = np.arange(300) / 10
HEADING = np.cumsum(np.full(300, 0.004) * np.arange(300) ** 0.2)
PATH = np.cumsum(0.05 * np.column_stack((np.cos(HEADING), np.sin(HEADING))), axis=0)
PATHS = {
    "named": "t,x,y\n" + lines(TIMES, *PATH.T),
    "x and y": "x,y\n" + lines(*PATH.T),
    "seconds since the start": lines(TIMES, *PATH.T),
    "clock": lines(1.7e9 + TIMES, *PATH.T, form="{:.3f}"),
}


@pytest.mark.parametrize("form", PATHS)
def test_the_path_of_a_robot_is_no_scan_unless_said(tmp_path: Path, form: str):
    with pytest.raises(ValueError, match="has x and y along a path") as told:
        read(tmp_path, PATHS[form])
    columns = str(told.value).rpartition("--columns=")[2].rstrip(".")
    assert sum(recording_size(read(tmp_path, PATHS[form], columns=columns))) == 300


def recording_size(recording: Recording) -> list[int]:
    return [len(scan) for scan in recording]
