import csv
import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import wall_ahead

from lineseg import Extraction, Noise, Params, Recording, Scan, Segment, covariance, extract, survey
from lineseg.writers import SEGMENT_WRITERS, segment_lines, write_segments
from lineseg.writers.whole import SURVEY_WRITERS

WALL = Segment((0.6, 0.8, -2.0), (1.0, 1.75), (2.0, 1.0), 3, 88, 85, 1.25, 0.1 + 0.2)


def row(frame, *segments, stamp=12.5, frame_id="laser"):
    scan = Scan(np.ones(4), np.arange(4.0), stamp=stamp, frame_id=frame_id)
    return frame, scan, Extraction("region-growing", Params(), segments, np.full(4, -1, np.int32), ())


def test_a_line_of_json_is_a_scan_with_its_segments():
    lines = list(segment_lines("jsonl", [row(0, WALL), row(1)]))
    assert [json.loads(line) for line in lines] == [
        {
            "frame": 0,
            "stamp": 12.5,
            "frame_id": "laser",
            "segments": [
                {
                    "start": [1.0, 1.75],
                    "end": [2.0, 1.0],
                    "first": 3,
                    "last": 88,
                    "line": [0.6, 0.8, -2.0],
                    "points": 85,
                    "length": 1.25,
                    "rms": 0.30000000000000004,
                }
            ],
        },
        {"frame": 1, "stamp": 12.5, "frame_id": "laser", "segments": []},
    ]


def test_a_row_of_csv_is_a_segment_with_every_digit():
    text = "".join(segment_lines("csv", [row(0, WALL, WALL, frame_id='a,"b"'), row(1)]))
    table = list(csv.DictReader(io.StringIO(text)))
    assert len(table) == 2
    assert table[1]["frame_id"] == 'a,"b"'
    assert float(table[0]["rms"]) == WALL.rms
    assert (float(table[0]["start_x"]), float(table[0]["end_y"]), table[0]["last"]) == (1.0, 1.0, "88")


@pytest.mark.parametrize("format", SURVEY_WRITERS)
def test_the_text_of_a_survey_is_that_of_its_frames(format):
    ahead = wall_ahead(distance=2.0, noise=0.01)
    # A wall along an axis has a normal of 0 or 1e-17, which needs an exponent.
    scans = [ahead, wall_ahead(distance=2.0), Scan(np.full(30, np.nan), np.arange(30) / 99)] * 20
    told = [
        replace(scan, stamp=math.nan if k % 3 else k / 7, frame_id=f'{"="[k % 2 :]}a,"{k}"')
        for k, scan in enumerate(scans)
    ]
    recording = replace(Recording.from_scans(told), numbers=np.arange(60) + 100)
    rows = [(100 + k, scan, extract(scan)) for k, scan in enumerate(recording)]
    about = {"file": "a"}
    text = "".join(SURVEY_WRITERS[format](recording, survey(recording, scores=False), about))
    assert text == "".join(segment_lines(format, rows, about=about))


@pytest.mark.parametrize("frame_id", ["=cmd()", "+1", "-1", "@SUM(A1)", "\t=1"])
def test_a_spreadsheet_computes_no_name_of_a_frame(frame_id: str):
    text = "".join(segment_lines("csv", [row(0, WALL, frame_id=frame_id)]))
    assert next(csv.DictReader(io.StringIO(text)))["frame_id"] == f"'{frame_id}"


def test_values_of_numpy_are_written_as_numbers():
    three, one = tuple(np.float64([0.6, 0.8, -2.0])), np.float64(1)
    wall = Segment(three, (one, one), (3.0, 4.0), np.int64(1), np.int64(2), np.int64(2), one, one)
    for format in SEGMENT_WRITERS:
        assert "np." not in "".join(segment_lines(format, [row(0, wall)]))


def test_a_stamp_that_is_not_a_number_is_null():
    (line,) = segment_lines("jsonl", [row(0, stamp=math.nan)])
    assert json.loads(line)["stamp"] is None


def test_the_suffix_of_the_path_chooses_the_format(tmp_path):
    for suffix, writer in SEGMENT_WRITERS.items():
        write_segments(tmp_path / f"out.{suffix}", None, [row(0, WALL)])
        assert (tmp_path / f"out.{suffix}").read_text() == "".join(writer([row(0, WALL)]))
    with pytest.raises(ValueError, match="cannot be written as 'txt'; choose from jsonl, csv"):
        write_segments(tmp_path / "out.txt", None, [])


def test_rows_are_written_as_they_come():
    stream = io.StringIO()

    def rows():
        for frame in range(3):
            assert stream.getvalue().count("\n") == frame
            yield row(frame)

    write_segments(stream, "jsonl", rows())
    assert stream.getvalue().count("\n") == 3


def test_an_existing_file_stays_when_writing_is_stopped(tmp_path):
    path = tmp_path / "out.jsonl"
    path.write_text("before")

    def rows():
        yield row(0, WALL)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_segments(path, None, rows())
    assert [each.name for each in tmp_path.iterdir()] == ["out.jsonl"]
    assert path.read_text() == "before"


def test_with_the_noise_given_each_segment_has_its_polar_form_and_covariance():
    scan, noise = wall_ahead(noise=0.01), Noise(0.01, 0.001)
    (segment,) = extract(scan).segments
    matrix = covariance(scan, segment, noise)
    (line,) = segment_lines("jsonl", [(0, scan, extract(scan))], noise)
    (written,) = json.loads(line)["segments"]
    assert (written["rho"], written["theta"]) == (segment.rho, segment.theta)
    assert written["covariance"] == matrix.tolist()
    (record,) = csv.DictReader(io.StringIO("".join(segment_lines("csv", [(0, scan, extract(scan))], noise))))
    numbers = [float(record[name]) for name in ("rho", "theta", "var_rho", "cov_rho_theta", "var_theta")]
    assert numbers == [segment.rho, segment.theta, matrix[0, 0], matrix[0, 1], matrix[1, 1]]


def test_a_missing_covariance_is_null():
    scan = Scan(np.full(20, 2.0), np.full(20, 0.3))
    (line,) = segment_lines("jsonl", [(0, scan, extract(scan, Params(min_length=0)))], Noise(0.01))
    assert json.loads(line)["segments"][0]["covariance"] == [[None, None], [None, None]]


def test_geojson_is_a_line_for_each_segment_with_the_rest_as_its_properties():
    tree = json.loads("".join(segment_lines("geojson", [row(0, WALL, WALL), row(1), row(2, WALL)])))
    assert tree["type"] == "FeatureCollection"
    about = [(each["properties"]["frame"], each["properties"]["segment"]) for each in tree["features"]]
    assert about == [(0, 0), (0, 1), (2, 0)]
    (feature, *_) = tree["features"]
    assert feature["geometry"] == {"type": "LineString", "coordinates": [[*WALL.start], [*WALL.end]]}
    assert feature["properties"]["rms"] == WALL.rms
    assert json.loads("".join(segment_lines("geojson", [])))["features"] == []
