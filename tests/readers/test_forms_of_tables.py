"""One room in tables as loggers, spreadsheets and simulators lay them out; and what only looks like a scan."""

from __future__ import annotations

import io
import json
import pickle
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
    "columns of pandas as JSON": json.dumps({
        "scan": dict(enumerate(np.repeat([0, 1], 181).tolist())), "angle": dict(enumerate([*DEGREES.tolist()] * 2)),
        "range": dict(enumerate(SCANS.ravel().tolist())),
    }),
    "lasers in turn": "".join(f"{100 + at} {laser} {row(each + laser, ' ')}\n" for at, each in enumerate(SCANS)
                              for laser in (0, 1)),
    "lists in cells": "stamp,angle_min,angle_increment,ranges\n"
    + "".join(f"{at},{-np.pi / 2},{np.pi / 180},{row(each, ';')}\n" for at, each in enumerate(SCANS)),
    "ranges and intensities": "".join(f"{row(each)},{row(np.full(181, 120 + at))}\n" for at, each in enumerate(SCANS)),
    "two models in turn": "".join(f"{row(each)}\n{row(np.ones(300))}\n" for each in SCANS for _ in range(2)),
    "numbers beside angles": "".join(f"{beam} {angle:g} {each:g} 47\n" for ranges in SCANS for beam, angle, each in
                                     zip(range(181), DEGREES, ranges, strict=True)),
    "yaw": "frame,yaw,pitch,range\n" + lines(np.repeat([0, 1], 181), np.tile(BEARINGS, 2), np.zeros(362), SCANS.ravel(),
                                             form="{:.5f}"),
    "lists in a column of another name": "t,x,y,theta,scan\n"
    + "".join(f'{at},0,0,0,"[{row(each, " ")}]"\n' for at, each in enumerate(SCANS)),
    "numbers of points": "scan_no,point_no,distance [mm]\n"
    + lines(np.repeat([0, 1], 181), np.tile(range(181), 2), 1000 * SCANS.ravel()),
    "layers": "scan,elevation,azimuth,range\n" + lines(
        np.repeat([0, 1], 362), np.tile(np.repeat([0, 15], 181), 2), np.tile(DEGREES, 4),
        np.concatenate((NEAR, NEAR * 2, FAR, FAR * 2))),
    "fields": "".join(f"time: {at}.5\nscan: {row(each, ' ')}\npose: 1 2 0\n" for at, each in enumerate(SCANS)),
    "fields with angles": "".join(
        f"angle_min: {-np.pi / 2}\nangle_increment: {np.pi / 180}\nranges: {row(each, mark)}\n"
        for each, mark in zip(SCANS, (" ", ", "), strict=True)),
    "points in fields": "version: 2\n"
    + "".join(f"time: {at}\nrobot: 0 0 0\nsick1: {row(points(1000 * each), ' ')}\n" for at, each in enumerate(SCANS)),
    "words between": "".join(f"Scan {at} at {at}.5 s\n{row(each, ' ')}\n" for at, each in enumerate(SCANS)),
    "box": "+---+---+---+\n| scan | angle | range |\n+===+===+===+\n"
    + "".join(f"│ {line.replace(',', ' ┆ ')} │\n" for line in
              lines(np.repeat([0, 1], 181), np.tile(DEGREES, 2), SCANS.ravel()).splitlines()) + "└───┘\n",
    "node": "".join("[INFO] [17.5]: scan laser[181]:\nangle_range : [-90, 90]\n"
                    + "".join(f"angle-distance : [{angle:g}, {each:g}]\n" for angle, each in
                              zip(DEGREES, ranges, strict=True)) for ranges in SCANS),
    "lists in a log": "".join(f"[INFO] [17.5]: : [{angle:.6f}, {each:.6f}]\n" for ranges in SCANS
                              for angle, each in zip(DEGREES, ranges, strict=True)),
    "named lists of YAML": "".join(f"scan_{at}:\n" + "".join(f"- {each:g}\n" for each in ranges)
                                   for at, ranges in enumerate(SCANS)),
    "nested lists of YAML": "scans:\n"
    + "".join("- " + "  ".join(f"- {each:g}\n" for each in ranges) for ranges in SCANS),
    "objects of YAML": "".join(f"- stamp: {at}.5\n  ranges:\n" + "".join(f"  - {each:g}\n" for each in ranges)
                               for at, ranges in enumerate(SCANS)),
    "lists in JSON": json.dumps({"scans": SCANS.tolist()}),
    "lists of other quantities in JSON": json.dumps(
        [{"front": each.tolist(), "quality_data": [47] * 181, "frame_times": [0] * 181} for each in SCANS]),
    "lists of other quantities in lines": "".join(
        f"intensities: {row(np.full(181, 120.0), ' ')}\nranges: {row(each, ' ')}\n" for each in SCANS),
    "lists of other quantities in a log": "".join(
        f"[INFO] [17.{at}]: {name}: [{row(each, ', ')}]\n" for at, ranges in enumerate(SCANS)
        for name, each in (("intensities", np.full(181, 120)), ("ranges", ranges))),
    "lists of other quantities in brackets": "".join(
        f"{name}: [{row(each, ', ')}]\n" for ranges in SCANS
        for name, each in (("intensities", np.full(181, 120)), ("ranges", ranges))),
    "angles and ranges in lines": "".join(
        f"angles: {row(DEGREES, ' ')}\nranges: {row(each, ' ')}\nintensities: {row(100 * each, ' ')}\n"
        for each in SCANS),
    "angles and ranges in a log": "".join(
        f"[{('INFO', 'WARN')[at]}] [17.5]: {name}: [{row(each, ', ')}]\n" for at, ranges in enumerate(SCANS)
        for name, each in (("angles", DEGREES), ("ranges", ranges))),
    "numbered labels": "".join(f"Scan {at}: {row(each, ' ')}\n" for at, each in enumerate(SCANS)),
    "numbers beside points": "".join(f"{beam} {x:g} {y:g}\n" for beam, (x, y) in
                                     enumerate(np.array([points(each) for each in SCANS]).reshape(-1, 2))),
    "names above each row": "".join(f"angle,{','.join(f'range_{beam}' for beam in range(181))}\n0.5,{row(each)}\n"
                                    for each in SCANS),
    "the pitch of a robot": f"roll,pitch,yaw,{','.join(f'range_{beam}' for beam in range(181))}\n"
    + "".join(f"0,{at / 100},0,{row(each)}\n" for at, each in enumerate(SCANS)),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_every_layout_gives_the_scans(tmp_path: Path, form: str):
    recording = read(tmp_path, FORMS[form])
    each = 2 if form == "two models in turn" else 1
    assert (len(recording), recording.beams) == (2 * each, (181, 181))
    for scan, ranges in zip(list(recording)[::each], SCANS, strict=True):
        assert np.rad2deg(scan.bearings) == pytest.approx(DEGREES, abs=0.02)
        assert scan.ranges == pytest.approx(ranges, abs=2e-3)


def test_a_column_below_words_is_one_scan_in_the_unit_that_they_say(tmp_path: Path):
    for head in ("range [cm]\n", "Measured in the lab\nrange_cm\n"):
        recording = read(tmp_path, head + lines(100 * NEAR))
        assert recording[0].ranges == pytest.approx(NEAR, abs=1e-4)


def test_angles_of_an_rplidar_are_taken_for_clockwise_and_marked(tmp_path: Path):
    beams = [(angle, each) for angle, each in zip(DEGREES % 360, 1000 * NEAR, strict=True)]
    printed = "".join(f"   theta: {angle:05.2f} Dist: {each:08.2f} Q: 47 \n" for angle, each in beams)
    grabbed = "#RPLIDAR SCAN DATA\n#Angule\tDistance\tQuality\n" + "".join(f"{a}\t{d}\t47\n" for a, d in beams)
    for text in (printed, grabbed):
        recording = read(tmp_path, text, "a.txt")
        assert np.rad2deg(recording[0].bearings) == pytest.approx(-DEGREES, abs=0.01)
        assert recording.account is not None
        assert any(guess.value == "clockwise" for guess in recording.account.guesses)
        turned = read(tmp_path, text, "a.txt", direction="counter-clockwise")
        assert np.rad2deg(turned[0].bearings) == pytest.approx(DEGREES, abs=0.01)


def test_angles_of_an_rplidar_that_its_driver_for_ros_turned_are_not_turned_again(tmp_path: Path):
    recording = read(tmp_path, "# /scan of rplidar_ros\n" + lines(DEGREES, NEAR, mark=" "), "a.txt")
    assert np.rad2deg(recording[0].bearings) == pytest.approx(DEGREES, abs=0.01)


def test_names_above_each_scan_say_the_units_of_all(tmp_path: Path):
    parts = [each[60:75] for each in SCANS]
    text = "".join("distance_cm,angle_deg\n" + lines(100 * each, DEGREES[60:75]) for each in parts)
    recording = read(tmp_path, text)
    assert [scan.ranges.tolist() for scan in recording] == [pytest.approx(each, abs=1e-4) for each in parts]


def test_lists_called_after_two_lasers_are_not_mixed(tmp_path: Path):
    objects = json.dumps([{"front": each.tolist(), "rear": (each * 2).tolist()} for each in SCANS])
    assert read(tmp_path, objects, "a.json")[1].ranges == pytest.approx(FAR)
    assert read(tmp_path, objects, "a.json", frame_id="rear")[1].ranges == pytest.approx(FAR * 2)
    fields = "".join(f"front: {row(each, ' ')}\nrear: {row(each * 2, ' ')}\n" for each in SCANS)
    recording = read(tmp_path, fields)
    assert recording[1].ranges == pytest.approx(FAR)
    assert recording.account is not None
    assert any(notice.change == {"frame_id": "rear"} for notice in recording.account.notices)
    assert read(tmp_path, fields, frame_id="rear")[1].ranges == pytest.approx(FAR * 2)


def test_uneven_angles_are_read_whatever_other_lists_stand_beside(tmp_path: Path):
    angles = DEGREES + 0.3 * (np.arange(181) % 2)
    recording = read(tmp_path, json.dumps({"tags": ["a"], "angles": angles.tolist(), "distances": NEAR.tolist()}))
    assert np.rad2deg(recording[0].bearings) == pytest.approx(angles, abs=0.01)


def test_coordinates_that_are_read_as_ranges_are_noticed(tmp_path: Path):
    recording = read(tmp_path, f"{row(NEAR * X)}\n{row(NEAR * Y)}\n" * 3)
    assert recording.account is not None
    assert any("below 0, as no distance is" in notice.text for notice in recording.account.notices)


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


def test_a_row_that_counts_is_no_scan_and_its_angles_are_a_guess(tmp_path: Path):
    wide = np.concatenate((NEAR, NEAR, NEAR[:179]))  # as many as a laser of 270° by half a degree has
    for ranges, view in ((NEAR, "0…180°"), (wide, "−135…135°")):
        text = f",{row(range(len(ranges)))}\n0,{row(ranges)}\n1,{row(ranges)}\n"
        recording = read(tmp_path, text)
        assert recording_size(recording) == [len(ranges)] * 2
        assert recording[0].ranges == pytest.approx(ranges, abs=1e-5)
        assert recording.account is not None
        assert view in recording.account.line
        assert any(guess.field == "angle_min" for guess in recording.account.guesses)


def test_points_of_numpy_are_scans_without_those_that_are_nowhere(tmp_path: Path):
    flat = np.array([np.column_stack((each * X, each * Y, 0 * X)) for each in SCANS])
    flat[0, 7] = np.nan
    files = [io.BytesIO() for _ in range(3)]
    np.save(files[0], flat)
    np.savez(files[1], points=flat)
    np.savez(files[2], scan_1=flat[0, :, :2], scan_2=flat[1, :, :2])
    for name, file in zip(("a.npy", "b.npz", "c.npz"), files, strict=True):
        recording = read(tmp_path, file.getvalue(), name)
        assert recording_size(recording) == [180, 181]
        assert recording[1].ranges == pytest.approx(FAR, abs=1e-5)


def test_tables_of_x_and_y_are_scans_and_not_ranges(tmp_path: Path):
    file = io.BytesIO()
    np.savez(file, xs=SCANS * X, ys=SCANS * Y)
    recording = read(tmp_path, file.getvalue(), "a.npz")
    assert recording_size(recording) == [181, 181]
    assert recording[1].ranges == pytest.approx(FAR, abs=1e-5)


def test_seconds_and_nanoseconds_beside_each_other_are_one_stamp(tmp_path: Path):
    head = "sec,nanosec," + ",".join(f"range_{beam}" for beam in range(181)) + "\n"
    recording = read(tmp_path, head + "".join(f"1700000000,{at * 100_000_000},{row(NEAR)}\n" for at in range(3)))
    assert recording.stamps - recording.stamps[0] == pytest.approx([0, 0.1, 0.2], abs=1e-6)


def test_uneven_angles_of_json_are_kept(tmp_path: Path):
    uneven = DEGREES + np.where(np.arange(181) % 3 == 1, 0.4, 0)
    text = json.dumps({"angles": uneven.tolist(), "ranges": NEAR.tolist()})
    assert np.rad2deg(read(tmp_path, text, "a.json")[0].bearings) == pytest.approx(uneven, abs=1e-6)


def test_a_first_angle_that_is_given_is_the_one_of_json_without_angles(tmp_path: Path):
    recording = read(tmp_path, json.dumps({"ranges": NEAR.tolist()}), "a.json", angle_min=0.5)
    assert recording[0].bearings[0] == pytest.approx(0.5)
    assert recording.account is not None
    assert "28.65…208.6° is a guess" in recording.account.guesses[0].text


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("a.p", pickle.dumps({"ranges": [1.5] * 99}, protocol=0), "is a Python pickle"),
        ("a.p", pickle.dumps({"ranges": [1.5] * 99}, protocol=1), "is a Python pickle"),
        ("a.g2o", b"VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n" * 20, "is a pose graph"),
        ("a.mat", bytes(40), "is a MATLAB file of another version; save it in MATLAB with save"),
        ("a.txt", b"ans =\n\n  Columns 1 through 3\n\n    1.5    1.6   1.7\n", "is what MATLAB shows in its window"),
        ("a.csv", b"epoch,loss\n" + b"1,2\n" * 20, "which names no column angle"),
    ],
)
def test_what_is_no_scan_is_refused_with_what_it_is(tmp_path: Path, name: str, content: bytes, sentence: str):
    with pytest.raises(ValueError, match=sentence):
        read(tmp_path, content, name)
