"""One room as further programs save it: columns of other names, several rows of names, lists called after lasers; and
numbers that cannot be scans."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from lineseg import open_recording
from tests.readers.test_forms_of_tables import BEARINGS, DEGREES, FAR, NEAR, SCANS, X, Y, lines, read, row

NUMBERS = ",".join(map(str, range(181)))
# What Python puts around an array that it prints in lines of 75 letters.
ARRAYS = [str(each) for each in SCANS]
BOTH = np.tile(DEGREES, 2)
AT = np.repeat([0, 1], 181)
ORDER = np.random.default_rng(1).permutation(362)
UNEVEN = DEGREES + 0.3 * (np.arange(181) % 2)

FORMS = {
    "an angle that is called after what turns": "scan,time_s,heading_deg,range_m\n"
    + lines(AT, AT, BOTH, SCANS.ravel()),
    "an angle by its unit alone": "turn,position [deg],range [m]\n" + lines(AT, BOTH, SCANS.ravel()),
    "two rows of names": f",header,info,info{',ranges' * 181}\n,stamp,angle_min,angle_increment,{NUMBERS}\n"
    + "".join(f"{at},{at}.5,{BEARINGS[0]},{np.pi / 180},{row(each)}\n" for at, each in enumerate(SCANS)),
    "names above several columns": f"header;laser{';' * 180}\nstamp;{NUMBERS.replace(',', ';')}\n"
    + "".join(f"{at};{row(each, ';')}\n" for at, each in enumerate(SCANS)),
    "lists of angles in cells": "time;angles_deg;ranges_mm\n"
    + "".join(f"{at};[{row(DEGREES, ', ')}];[{row(1000 * each, ', ')}]\n" for at, each in enumerate(SCANS)),
    "arrays that span lines": "stamp,angle_min,angle_inc,ranges\n"
    + "".join(f'{at},{BEARINGS[0]},{np.pi / 180},"{each}"\n' for at, each in enumerate(ARRAYS)),
    "settings beside the ranges": "Counter;Start angle [deg];Angular step [deg];DIST1\n"
    + "".join(f"{at};-90;1;{row(1000 * each, ';')}\n" for at, each in enumerate(SCANS)),
    "days first": f"time,{','.join(f'{angle:.1f}' for angle in DEGREES)}\n"
    + "".join(f"10.06.2024 08:13:2{at},{row(each)}\n" for at, each in enumerate(SCANS)),
    "a name with the angle and the unit": f"Date,Time,{','.join(f'Distance at {a:.1f} deg (m)' for a in DEGREES)}\n"
    + "".join(f"06/10/2024,08:13:2{at}.5 PM,{row(each)}\n" for at, each in enumerate(SCANS)),
    "uneven angles in the first row": f"angles: {row(UNEVEN, ' ')}\n"
    + "".join(f"ranges: {row(each, ' ')}\n" for each in SCANS),
    "angles that differ above each row": "".join(
        f"{row(UNEVEN + 0.01 * at)}\n{row(each)}\n" for at, each in enumerate(SCANS)),
    "a motor to and fro": lines(np.concatenate((DEGREES, DEGREES[::-1])), np.concatenate((NEAR, FAR[::-1]))),
    "a row of a table as JSON": "".join(
        json.dumps({"stamp": at, **{f"r{beam}": each for beam, each in enumerate(ranges.tolist())}}) + "\n"
        for at, ranges in enumerate(SCANS)),
    "sections": "".join(f"[scan{at}]\nangle_min={BEARINGS[0]}\nangle_increment={np.pi / 180}\nranges={row(each)}\n\n"
                        for at, each in enumerate(SCANS)),
    "a list of messages": "scans:\n" + "".join(
        f"  - stamp: {at}.5\n    angle_min: {BEARINGS[0]}\n    angle_increment: {np.pi / 180}\n"
        f"    ranges: [{row(each, ', ')}]\n" for at, each in enumerate(SCANS)),
    "rows in no order": "scan,angle,distance\n"
    + lines(*(each[ORDER] for each in (AT, BOTH, SCANS.ravel()))),
    "a flag": "".join(f"{at % 2},{row(SCANS[at // 4])}\n" for at in range(8)),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_every_export_gives_the_scans(tmp_path: Path, form: str):
    recording = read(tmp_path, FORMS[form])
    assert len(recording) == (8 if form == "a flag" else 2)
    angles = UNEVEN if "uneven" in form or "differ" in form else DEGREES
    for scan, ranges in ((recording[0], NEAR), (recording[-1], FAR)):
        order = np.argsort(scan.bearings)
        assert np.rad2deg(scan.bearings[order]) == pytest.approx(angles, abs=0.02)
        assert scan.ranges[order] == pytest.approx(ranges, abs=2e-3)


@pytest.mark.parametrize(
    ("form", "seconds"),
    [("days first", 1), ("a name with the angle and the unit", 1), ("two rows of names", 1)],
)
def test_times_in_words_are_read(tmp_path: Path, form: str, seconds: float):
    assert np.diff(read(tmp_path, FORMS[form]).stamps) == pytest.approx(seconds)


def test_a_date_that_may_begin_with_the_day_or_the_month_gives_the_time_of_day(tmp_path: Path):
    evening = read(tmp_path, FORMS["a name with the angle and the unit"]).stamps[0]
    assert evening == pytest.approx(20 * 3600 + 13 * 60 + 20.5)


LASERS = {
    "brackets": lambda name, each: f"[{name}]: {row(each, ' ')}\n",
    "a log": lambda name, each: f"[INFO] [17.25] [{name}_scan]: ranges: [{row(each, ', ')}]\n",
    "arrays over lines": lambda name, each: f"{name}: {np.array2string(each)}\n",
    "the first column": lambda name, each: f"{name},17.25,{row(each)}\n",
    "after a time": lambda name, each: f"17.25 {name} {row(each, ' ')}\n",
}


@pytest.mark.parametrize("form", LASERS)
@pytest.mark.parametrize("names", [("front", "rear"), ("laser1", "laser2")])
def test_lists_of_two_lasers_are_never_mixed(tmp_path: Path, form: str, names: tuple[str, str]):
    text = "".join(LASERS[form](name, each * factor) for each in np.tile(SCANS, (2, 1))
                   for name, factor in zip(names, (1, 2), strict=True))  # fmt: skip
    recording = read(tmp_path, text, "a.log")
    assert [scan.ranges[0] for scan in recording] == pytest.approx([NEAR[0], FAR[0]] * 2, abs=1e-3)
    assert recording.account is not None
    (change,) = [notice.change for notice in recording.account.notices if notice.kind == "several lasers"]
    other = read(tmp_path, text, "a.log", **change)
    assert [scan.ranges[0] for scan in other] == pytest.approx([2 * NEAR[0], 2 * FAR[0]] * 2, abs=1e-3)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (
            "x,y\n" + lines(11.57 + 1e-5 * X, 48.13 + 1e-5 * Y, form="{:.9g}"),
            "far from zero.*Save x and y as the laser",
        ),
        ("x,y,z,theta,depth\n" + lines(X, Y, np.linspace(-2, 2, 181), 0 * X, 0 * X), "a scan lies in one plane"),
        ("theta,depth\n" + lines(0 * X + 3, NEAR), "column 1, of angles, has 3 in all rows.*--columns"),
        ("frame,x1,y1,x2,y2,theta\n" + lines(AT[:90], *(AT[:90] + 1.0,) * 5), "lines from one point to another"),
        ("beam,s1,s2,theta\n" + lines(DEGREES, NEAR, FAR, 0 * X), "column 4, of angles, has 0 in all rows"),
        (f"{row(np.repeat([-1, 0, 100], 60))}\n" * 40, "has only the numbers -1, 0, 100, as a map of cells has"),
        ("stamp,ranges,angles\n" + f"0,[{row(NEAR, ' ')}],[{row(DEGREES[:90], ' ')}]\n", "90 angles, but 181 ranges"),
    ],
)
def test_what_cannot_be_a_scan_is_refused(tmp_path: Path, content: str, sentence: str):
    with pytest.raises(ValueError, match=sentence):
        read(tmp_path, content)


def test_rows_of_few_numbers_are_ranges_if_that_is_said(tmp_path: Path):
    text = f"{row(np.repeat([-1, 0, 100], 60))}\n" * 40
    assert len(read(tmp_path, text, columns="ranges")) == 40


def test_arrays_of_points_and_of_unnamed_angles_beside_others_are_read(tmp_path: Path):
    points = np.stack([SCANS * X, SCANS * Y, 0 * SCANS], axis=-1)
    np.savez(tmp_path / "a.npz", points=points, t=[10.5, 10.75])
    recording = open_recording(tmp_path / "a.npz")
    assert [scan.ranges for scan in recording] == [pytest.approx(each, abs=1e-3) for each in SCANS]
    assert np.diff(recording.stamps) == pytest.approx(0.25)
    np.savez(tmp_path / "b.npz", SCANS, BEARINGS + 0.5)
    assert open_recording(tmp_path / "b.npz")[1].bearings == pytest.approx(BEARINGS + 0.5)


def test_angles_that_the_columns_of_a_table_give_in_degrees_are_degrees(tmp_path: Path):
    text = "stamp,angle_min_deg,angle_step_deg,ranges\n" + "".join(f'{at},-90,1,"[{row(NEAR)}]"\n' for at in range(3))
    recording = read(tmp_path, text)
    assert np.rad2deg(recording[0].bearings) == pytest.approx(DEGREES)
    assert recording.account is not None
    assert [guess.field for guess in recording.account.guesses] == ["unit"]


STATED = {
    "in comments": (f"# start angle [deg]: -60\n# step [deg]: 0.5\n{row(NEAR)}\n{row(FAR)}\n", "a.csv"),
    "above the table": ("angle_min,-1.0471976\nangle_increment,0.00872665\nunit,m\n" + f"{row(NEAR)}\n" * 6, "a.csv"),
    "above a list": ("angle_min: -1.0471976\nangle_increment: 0.00872665\nscans:\n"
                     + "".join(f"  - [{row(each, ', ')}]\n" for each in (NEAR,) * 6), "a.yaml"),
    "once in JSON": (json.dumps({"start_angle_deg": -60, "step_deg": 0.5, "scans": [{"ranges": NEAR.tolist()}] * 2}),
                     "a.json"),
    "in an object of JSON": (json.dumps({"meta": {"angle_min": -1.0471976, "angle_step": 0.00872665},
                                         "scans": [{"ranges": NEAR.tolist()}]}), "a.json"),
}  # fmt: skip


@pytest.mark.parametrize("form", STATED)
def test_angles_that_are_stated_once_are_no_guess(tmp_path: Path, form: str):
    recording = read(tmp_path, *STATED[form])
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-60, 30], abs=1e-3)
    assert recording.account is not None
    assert "angle_min" not in {guess.field for guess in recording.account.guesses}


def test_angles_in_degrees_beside_an_array_are_no_guess(tmp_path: Path):
    np.savez(tmp_path / "a.npz", scan=SCANS, start_angle_deg=-60.0, step_deg=0.5)
    recording = open_recording(tmp_path / "a.npz")
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-60, 30], abs=1e-3)
    again = open_recording(tmp_path / "a.npz", angle_min=-1.0)
    assert again[0].bearings[0] == pytest.approx(-1.0)


def test_rows_that_do_not_close_a_circle_are_half_of_one(tmp_path: Path):
    beams = np.linspace(2, 4, 360)
    recording = read(tmp_path, "".join(row(beams + 0.001 * at) + "\n" for at in range(5)))
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-90, 89.5])
    around = read(tmp_path, "".join(row(np.r_[beams[::2], beams[::-2]] + 0.001 * at) + "\n" for at in range(5)))
    assert np.rad2deg(around[0].bearings[[0, -1]]) == pytest.approx([-180, 179])


def test_rows_of_a_laser_that_stands_still_are_a_circle_also_if_an_edge_lies_at_the_seam(tmp_path: Path):
    beams = np.r_[np.full(120, 4.0), np.full(60, 2.0), np.linspace(3, 2, 180)]
    recording = read(tmp_path, "".join(row(beams + 0.001 * at) + "\n" for at in range(5)))
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-180, 179])


@pytest.mark.filterwarnings("error")
def test_rows_without_any_return_are_scans_in_which_nothing_is_seen(tmp_path: Path):
    around = [row(np.linspace(2, 2.2, 360))] * 5
    assert len(read(tmp_path, "\n".join([*around, row(np.full(360, np.nan)), row(np.full(360, np.inf))]))) == 7


def test_angles_of_the_robot_beside_ranges_are_not_those_of_beams(tmp_path: Path):
    scans, turning = np.tile(SCANS, (10, 1)), np.random.default_rng(1).normal(size=20)
    np.savez(tmp_path / "a.npz", scans=scans, angular_velocity=turning)
    np.savez(tmp_path / "b.npz", scans=scans, angular_velocity=turning, angles=BEARINGS)
    for name in ("a.npz", "b.npz"):
        assert [len(scan) for scan in open_recording(tmp_path / name)] == [181] * 20
    assert open_recording(tmp_path / "b.npz")[0].bearings == pytest.approx(BEARINGS)


@pytest.mark.parametrize(
    "said", ["# angle_min: -1.5708\n# angle_increment: 0.01745\n", "# Start angle [deg]: -90\n# Step [deg]: 1\n"]
)
def test_beams_below_the_angles_of_their_laser_are_beams(tmp_path: Path, said: str):
    beams = "".join(f"{degree} {metres:.3f}\n" for degree, metres in zip(DEGREES, NEAR, strict=True))
    recording = read(tmp_path, said + beams)
    assert len(recording) == 1
    assert recording[0].ranges == pytest.approx(NEAR, abs=1e-3)


def test_notes_beside_the_one_bag_of_a_folder_do_not_hide_it(tmp_path: Path):
    np.savez(tmp_path / "a.npz", ranges=SCANS, angle_min=-1.5, angle_increment=0.01)
    (tmp_path / "notes.txt").write_text("second floor\n")
    (tmp_path / "params.yaml").write_text("laser:\n  port: /dev/ttyUSB0\n")
    assert len(open_recording(tmp_path)) == 2
