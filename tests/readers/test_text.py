import json

import numpy as np
import pytest

from lineseg.readers import Reading, open_recording

TURN = np.linspace(-180, 179, 360)


@pytest.fixture
def text(tmp_path):
    def write(content, name="scan.csv"):
        path = tmp_path / name
        path.write_text(content, encoding="utf-8")
        return path

    return write


def rows(beams, scans=3, separator=","):
    return "\n".join(separator.join(f"{1 + scan + beam / 1000:.3f}" for beam in range(beams)) for scan in range(scans))


@pytest.mark.parametrize("separator", [",", ";", " ", "\t", ", ", "  "])
def test_a_row_is_a_scan_whatever_separates_its_numbers(text, separator):
    recording = open_recording(text(rows(181, separator=separator)), reading=Reading(skip_columns=0))
    assert (len(recording), recording.beams, recording.format) == (3, (181, 181), "text")
    assert recording.ranges[181] == 2.0


@pytest.mark.parametrize(
    ("beams", "first", "last"), [(181, -90, 90), (361, -90, 90), (541, -135, 135), (1081, -135, 135), (682, -120, 120)]
)
def test_the_number_of_beams_tells_the_laser(text, beams, first, last):
    assert np.rad2deg(open_recording(text(rows(beams)))[0].bearings[[0, -1]]) == pytest.approx([first, last])


def test_an_unknown_number_of_beams_needs_the_angles(text):
    path = text(rows(100))
    with pytest.raises(ValueError, match=r"scan.csv: rows of 100 numbers without angles"):
        open_recording(path)
    bearings = open_recording(path, reading=Reading(angle_increment=0.01))[0].bearings
    assert bearings[[0, -1]].tolist() == pytest.approx([-0.495, 0.495])


def test_options_win_over_comments_and_comments_over_guesses(text):
    path = text("# angle_min = 0.5, angle_increment: 0.25 unit=cm\n" + rows(181))
    recording = open_recording(path)
    assert (recording.angle_min[0], recording.angle_increment[0], recording.ranges[0]) == (0.5, 0.25, 0.01)
    assert open_recording(path, reading=Reading(angle_min=1.0)).angle_min[0] == 1.0


def test_whole_numbers_too_large_for_metres_are_millimetres(text):
    numbers = " ".join(["1500"] * 180 + ["0"])
    assert open_recording(text(numbers)).ranges[0] == 1.5
    assert open_recording(text(numbers), reading=Reading(unit="m")).ranges[0] == 1500


def test_numbers_before_a_double_space_are_not_ranges(text):
    assert open_recording(text("7 8 9  " + rows(181, 1, " "))).beams == (181, 181)


def test_two_columns_are_angle_and_distance(text):
    recording = open_recording(text("0.0, 1.0\n0.1, 1.1\n0.3, 1.2\n"))
    assert (len(recording), recording.bearings.tolist()) == (1, [0.0, 0.1, 0.3])
    assert recording.ranges.tolist() == [1.0, 1.1, 1.2]


def test_columns_are_found_by_name_and_degrees_by_their_size(text):
    content = "quality angle distance_mm\n" + "\n".join(f"15 {angle} 2500" for angle in TURN)
    recording = open_recording(text(content, "rplidar.txt"))
    assert np.rad2deg(recording.bearings) == pytest.approx(TURN)
    assert set(recording.ranges) == {2.5}
    assert recording[0].full_circle


def test_an_angle_that_leaps_back_begins_the_next_scan(text):
    content = "\n".join(f"{angle} 2.5" for _ in range(3) for angle in TURN)
    assert np.diff(open_recording(text(content)).offsets).tolist() == [360, 360, 360]


def test_a_laser_that_sweeps_to_and_fro_begins_a_scan_where_it_turns_back(text):
    to = [f"angle={angle} dist={200 + angle}cm" for angle in range(0, 181, 2)]
    recording = open_recording(text("\n".join(["booting", "ready", *to, *to[::-1], *to]), "serial.txt"))
    assert np.diff(recording.offsets).tolist() == [91, 91, 91]
    assert np.rad2deg([scan.bearings[0] for scan in recording]) == pytest.approx([0, 180, 0])
    assert recording.ranges[0] == 2.0


@pytest.mark.parametrize("first", [0, 7, 100, 352])
@pytest.mark.parametrize("direction", [1, -1])
def test_turns_may_begin_anywhere(text, first, direction):
    angles = (first + direction * np.arange(3 * 360)) % 360
    recording = open_recording(text("".join(f"{angle} 2.5\n" for angle in angles)))
    assert np.diff(recording.offsets).tolist() == [360, 360, 360]
    assert all(scan.full_circle for scan in recording)


def test_angles_of_any_size_end(text):
    content = "angle,distance\n" + "".join(f"{angle},1.5\n" for angle in (0, 1e9, -1e9, 3, 1e300, 2, 5, 1e18))
    assert len(open_recording(text(content)).ranges) == 8


def test_a_table_with_lists_gives_geometry_stamp_and_frame_of_each_scan(text):
    header = "{'stamp': {'secs': 774, 'nsecs': 500000000}, 'frame_id': 'base'}"
    content = (
        "time,header,angle_min,angle_increment,range_min,range_max,ranges\n"
        f'1,"{header}",0.0,0.1,0.2,20.0,"[1.0, nan, inf]"\n2,"{header}",0.5,0.2,0.2,20.0,"[1.0, 2.0]"\n'
    )
    recording = open_recording(text(content))
    assert (recording.beams, recording.stamps[0], recording.frame_ids) == ((2, 3), 774.5, ("base", "base"))
    assert recording[0].valid.tolist() == [True, False, False]
    assert recording[1].bearings.tolist() == [0.5, 0.7]


def test_output_of_rostopic_echo_opens(text):
    content = (
        "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angle_min,field.angle_increment,"
        "field.range_min,field.range_max,field.ranges0,field.ranges1,field.intensities0\n"
        "1500000000,0,1500000000,laser,-0.5,0.25,0.1,10.0,1.5,2.5,47\n"
    )
    scan = open_recording(text(content))[0]
    assert (scan.ranges.tolist(), scan.bearings.tolist(), scan.frame_id) == ([1.5, 2.5], [-0.5, -0.25], "laser")
    assert (scan.stamp, scan.range_min, scan.range_max) == (1.5, 0.1, 10.0)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("0.0, 1.0\n0.1\n", r"scan.csv:2: 1 of 2 columns \(angle, distance\); is the line complete\?"),
        ("1.0, 2.0, x\n", "scan.csv:1: 'x' is not a number; use one scan per row"),
        ("Dear reader,\nthis is a letter.\n", "scan.csv begins with 'dear reader', and has no table of numbers below"),
        ("# nothing but words\n", "scan.csv has no line of numbers"),
        ("angle,distance\n", "scan.csv has column names, but no line of numbers"),
        ('time,ranges\n1,"[1.0]"\n', "scan.csv:2: angle_min is missing; give it in a column or an option"),
        ("# unit = ell\n1 2 3\n", "scan.csv: unit is 'ell'; choose from m, cm, mm"),
        ("# angle_min = left\n1 2 3\n", "scan.csv: its comments say angle_min = 'left'; it must be a number"),
    ],
)
def test_a_table_without_scans_is_named_with_its_line(text, content, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        open_recording(text(content))


@pytest.mark.parametrize("form", ["x y heading", "time x y heading", "x y degrees", "time x y heading speed"])
def test_odometry_without_a_header_is_named_as_poses(text, form):
    time = np.arange(200) / 10
    heading = 0.8 * np.sin(time)
    x, y = np.cumsum(0.05 * np.cos(heading)), np.cumsum(0.05 * np.sin(heading))
    columns = {"time": time, "x": x, "y": y, "heading": heading, "degrees": np.rad2deg(heading), "speed": 0 * x + 0.5}
    rows = np.column_stack([columns[name] for name in form.split()])
    with pytest.raises(ValueError, match=r"has poses, not scans; .* as its trajectory\. If it has beams after all"):
        open_recording(text("\n".join(",".join(f"{value:.5f}" for value in row) for row in rows)))


def test_points_around_the_laser_with_their_bearing_are_no_poses(text):
    bearings = np.linspace(-3.1, 3.1, 200)
    rows = np.column_stack([2 * np.cos(bearings), 2 * np.sin(bearings), bearings])
    recording = open_recording(text("\n".join(",".join(f"{value:.5f}" for value in row) for row in rows)))
    assert recording.ranges == pytest.approx(2.0, abs=1e-4)


def test_a_row_that_breaks_off_is_skipped_and_named(text):
    recording = open_recording(text(rows(181) + "\n1.0, 2.0"))
    (skipped,) = recording.account.skipped
    assert (len(recording), skipped.place) == (3, "scan.csv:4")
    assert skipped.why == "2 ranges, but other scans have 181; is the line complete?"


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"unit": "yd"}, "unit is 'yd'"),
        ({"angle_increment": 0.0}, "one ray"),
        ({"skip_columns": -1}, "never negative"),
        ({"angle_min": np.inf}, "finite"),
    ],
)
def test_options_without_sense_are_refused(options, sentence):
    with pytest.raises(ValueError, match=sentence):
        Reading(**options)


@pytest.mark.parametrize("beam", ["angle_deg", "beam"])
@pytest.mark.parametrize("alternating", [False, True])
def test_lasers_named_in_a_column_are_not_mixed(text, beam, alternating):
    rows = [("front", k, 2.0 + k / 100) for k in range(60)] + [("rear", k, 5.0 + k / 100) for k in range(60)]
    if alternating:
        rows.sort(key=lambda row: row[1])
    lines = "".join(f"{laser},{k},{distance}\n" for laser, k, distance in rows)
    path = text(f"laser,{beam},distance_m\n{lines}")
    wanted = {} if beam == "angle_deg" else {"angle_min": 0.0, "angle_increment": 0.01}
    front = open_recording(path, Reading(**wanted))
    assert (len(front), front.frame_ids, front.ranges[0]) == (1, ("front",), 2.0)
    assert front.account is not None
    (notice,) = [each for each in front.account.notices if each.kind == "several lasers"]
    assert "front (60 beams), rear (60 beams)" in notice.text and notice.change == {"frame_id": "rear"}
    assert open_recording(path, Reading(frame_id="rear", **wanted)).ranges[0] == 5.0
    with pytest.raises(ValueError, match="no frame_id 'left'; it has 'front', 'rear'"):
        open_recording(path, Reading(frame_id="left", **wanted))


def test_lasers_named_in_objects_of_beams_are_not_mixed(text):
    beams = [{"laser": name, "angle": k, "distance": far} for k in range(60) for name, far in (("a", 2.0), ("b", 5.0))]
    path = text(json.dumps(beams), "beams.json")
    assert open_recording(path).frame_ids == ("a",)
    assert set(open_recording(path, Reading(frame_id="b")).ranges.tolist()) == {5.0}
