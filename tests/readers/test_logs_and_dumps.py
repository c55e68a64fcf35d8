"""One room as logs, dumps and notebooks hold it; several lasers in one file of JSON."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from tests.readers.test_forms_of_tables import BEARINGS, DEGREES, FAR, NEAR, SCANS, read, row

MILLIMETRES = np.round(1000 * SCANS).astype(int)
MESSAGES = [{"angle_min": -1.0, "angle_increment": np.pi / 180, "ranges": each.tolist()} for each in SCANS]
KEYS = [f"{angle:g}" for angle in DEGREES]
BEAMS = list(zip(KEYS, NEAR, strict=True)), list(zip(KEYS, FAR, strict=True))

FORMS = {
    "topics before JSON": ("".join(f"robot/scan {json.dumps(each)}\n" for each in MESSAGES), "a.log"),
    "a log before JSON": ("".join(f"[ INFO] [17.5]: scan: {json.dumps(each)}\n" for each in MESSAGES), "a.log"),
    "pairs of JSON after topics": (
        "".join(f"lidar {json.dumps({'scan': [[float(a), d] for a, d in beams]})}\n" for beams in BEAMS), "a.log"),
    "angles as keys": (json.dumps([{**dict(beams), "-90": None} for beams in BEAMS]), "a.json"),
    "columns under angles": (json.dumps({key: {"0": n, "1": f} for key, n, f in zip(KEYS, NEAR, FAR, strict=True)}),
                             "a.json"),
    "lists beside the first and the last angle": (
        json.dumps({"angle_min": -1.0, "angle_max": -1.0 + np.pi, "scans": SCANS.tolist()}), "a.json"),
    "hexadecimal numbers": ("".join(" ".join(f"0x{each:04X}" for each in ranges) + "\n" for ranges in MILLIMETRES),
                            "a.txt"),
    "comments of C behind rows": (
        "".join(f"{angle}\t{distance} // ok\n" for beams in BEAMS for angle, distance in beams), "a.txt"),
    "totals below": ("scan,angle,range\n" + "".join(
        f"{at},{a},{d}\n" for at, beams in enumerate(BEAMS) for a, d in beams) + "Total,,990.5\nMean,,2.7\n", "a.csv"),
}  # fmt: skip


# Their angles are those that no laser has unless its file says so.
TURNED = ("topics before JSON", "a log before JSON", "lists beside the first and the last angle")


@pytest.mark.parametrize("form", FORMS)
def test_every_dump_gives_the_scans(tmp_path: Path, form: str):
    recording = read(tmp_path, *FORMS[form])
    assert [scan.ranges[1:] for scan in recording] == [pytest.approx(each[1:], abs=2e-3) for each in SCANS]
    first = -1.0 if form in TURNED else BEARINGS[0]
    assert recording[0].bearings == pytest.approx(first + BEARINGS - BEARINGS[0], abs=1e-3)


def test_what_julia_prints_for_no_number_is_no_return(tmp_path: Path):
    recording = read(tmp_path, "".join(f"Float32[{row(each[:-1], ', ')}, NaN32]\n" for each in SCANS), "a.txt")
    assert [int(scan.valid.sum()) for scan in recording] == [180, 180]


LASERS = {
    "a name beside the ranges": [{"sensor": name, **each} for each in MESSAGES for name in ("front", "rear")],
    "a name above the ranges": [{"sensor": name, "data": each} for each in MESSAGES for name in ("front", "rear")],
    "a key for each laser": [{"t": at, "front": each, "rear": each} for at, each in enumerate(MESSAGES)],
}


@pytest.mark.parametrize("form", LASERS)
def test_lasers_that_json_names_are_not_mixed(tmp_path: Path, form: str):
    recording = read(tmp_path, "".join(json.dumps(each) + "\n" for each in LASERS[form]), "a.jsonl")
    assert [scan.ranges for scan in recording] == [pytest.approx(each) for each in SCANS]
    assert recording.account is not None
    assert [(notice.kind, notice.change) for notice in recording.account.notices] == [
        ("several lasers", {"frame_id": "rear"})
    ]


def test_scans_under_their_numbers_are_not_several_lasers(tmp_path: Path):
    recording = read(tmp_path, json.dumps({f"scan_{at}": each for at, each in enumerate(MESSAGES)}), "a.json")
    assert len(recording) == 2


def test_each_topic_before_json_is_a_topic(tmp_path: Path):
    lines = [f"robot/{name} {json.dumps(each)}\n" for each in MESSAGES for name in ("front", "rear")]
    recording = read(tmp_path, "".join(lines), "a.log")
    assert [(topic.name, topic.scans) for topic in recording.topics] == [("robot/front", 2), ("robot/rear", 2)]


def test_a_comment_says_that_angles_count_clockwise(tmp_path: Path):
    rows = "".join(f"{angle} {distance}\n" for angle, distance in BEAMS[0])
    said = read(tmp_path, f"# degrees clockwise from north\n# angle distance\n{rows}", "a.txt")
    assert said[0].bearings == pytest.approx(-BEARINGS)
    other = read(tmp_path, f"# degrees counter-clockwise\n# angle distance\n{rows}", "a.txt")
    assert other[0].bearings == pytest.approx(BEARINGS)


def test_ranges_that_rise_by_chance_before_others_without_a_return_are_no_leading_columns(tmp_path: Path):
    scans = np.array([NEAR + 0.01 * at for at in range(3)])
    scans[:, 4:181:7] = scans[:, 5] = 65.533
    assert np.diff(read(tmp_path, "".join(row(each) + "\n" for each in scans)).offsets).tolist() == [181] * 3


def test_a_last_row_that_breaks_off_is_told(tmp_path: Path):
    header = ",".join(["t", *(f"ranges_{at}" for at in range(181))])
    rows = [f"{at},{row(NEAR)}" for at in range(3)]
    account = read(tmp_path, "\n".join([header, *rows[:2], rows[2][:400]])).account
    assert account is not None
    assert "breaks off" in {notice.kind for notice in account.notices}
    whole = read(tmp_path, "\n".join([header, *rows])).account
    assert whole is not None
    assert "breaks off" not in {notice.kind for notice in whole.notices}


def test_the_clock_of_a_simulator_gives_the_stamps(tmp_path: Path):
    text = "".join(f"{0.5 * at},{a},{d}\n" for at, beams in enumerate(BEAMS) for a, d in beams)
    assert np.diff(read(tmp_path, f"sim_time,angle_deg,range_m\n{text}").stamps) == pytest.approx(0.5)
