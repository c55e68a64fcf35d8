"""Files of the kinds that people have open as they expect, or say what was guessed and how to change it.

The cases lie beside the real recordings, in `cases`; each folder is one kind.
"""

from contextlib import suppress

import numpy as np
import pytest

from lineseg import Reading, Recording, extract, open_recording

FULL, HALF, WIDE = (360, (5.9, 5.9, 3.9, 3.9)), (181, (3.9, 3.4, 3.4)), (241, (4.9, 4.2, 3.9))
BAG = (541, (6.0, 5.0, 4.0))
NO_RETURNS = (541, (5.0, 3.0))


@pytest.fixture(scope="module")
def cases(data_dir):
    folder = data_dir.parent / "cases"
    if not folder.is_dir():
        pytest.skip("the folder `cases` is not beside LINESEG_DATA")
    return folder


def walls(recording):
    """Lengths of the lines of the first scan, longest first."""
    return sorted((segment.length for segment in extract(recording[0]).segments), reverse=True)


# file, scans, (beams, lengths of the walls), what is guessed.
OPEN = [
    ("first_topic_without_messages/bag", 5, BAG, ()),
    ("quarter_millimetres/lidar.csv", 1, (360, (5.9, 5.9, 3.9, 3.9)), ("unit",)),
    ("half_circle_scans_in_columns/scans.csv", 3, HALF, ("unit",)),
    ("half_circle_scans_in_columns/scans_240deg.csv", 3, WIDE, ("unit",)),
    ("half_circle_scans_in_columns/scan_from_352_deg.txt", 1, FULL, ("unit",)),
    ("decimal_comma/columns.csv", 1, HALF, ()),
    ("decimal_comma/rows.csv", 3, HALF, ("angle_min",)),
    ("xy_points/room.xy", 1, FULL, ("columns",)),
    ("xy_points/room_named.csv", 1, FULL, ()),
    ("rplidar_three_columns/framegrabber.txt", 1, FULL, ("unit",)),
    ("rplidar_three_columns/angle_distance_quality_layer.csv", 1, FULL, ("columns", "unit")),
    ("rplidar_three_columns/ultra_simple_stdout.txt", 1, FULL, ("unit",)),
    ("range_max_for_no_return/equal.bag", 5, NO_RETURNS, ()),
    ("range_max_for_no_return/plus_one.bag", 5, NO_RETURNS, ()),
    ("range_max_for_no_return/over_65535.bag", 5, NO_RETURNS, ("no_return",)),
    ("range_max_for_no_return/equal.csv", 5, NO_RETURNS, ("range_max",)),
    ("range_max_for_no_return/over_65535.csv", 5, NO_RETURNS, ("no_return",)),
    ("foxglove_mcap/protobuf_foxglove_laserscan.mcap", 5, BAG, ()),
    ("foxglove_mcap/json_laserscan.mcap", 5, BAG, ()),
    ("mcap_of_ros1/converted.mcap", 5, BAG, ()),
    ("mcap_of_ros1/cdr_without_profile.mcap", 5, BAG, ()),
    ("split_bag_dropped/run", 5, BAG, ()),
    ("split_bag_dropped/run/metadata.yaml", 5, BAG, ()),
    ("zipped_bag/2020-09-25.zip", 5, BAG, ()),
    ("echo_yaml/ros2_topic_echo.yaml", 4, FULL, ()),
    ("echo_yaml/ros2_topic_echo_inf.yaml", 4, FULL, ()),
    ("echo_yaml/rostopic_echo.txt", 4, FULL, ()),
    ("ros2_echo_csv/scan.csv", 4, FULL, ()),
    ("bagpy_csv/scan.csv", 4, FULL, ()),
    ("rosbag_to_csv/scan.csv", 4, FULL, ()),
    ("plotjuggler_csv/scan.csv", 4, FULL, ()),
    ("stamp_columns/scan.csv", 4, FULL, ()),
    ("header_names_with_blanks/units.csv", 1, FULL, ("direction",)),
    ("header_names_with_blanks/quoted.csv", 1, FULL, ("direction",)),
    ("header_names_with_blanks/more_columns.csv", 1, FULL, ("unit",)),
    ("leading_timestamp/laser.txt", 3, (361, (3.9, 3.5, 3.5)), ("skip_columns", "stamps", "unit")),
    ("json_lines/scan.json", 1, FULL, ()),
    ("json_lines/scans.jsonl", 4, FULL, ()),
    ("json_lines/rosbridge.jsonl", 4, FULL, ()),
    ("json_lines/pairs.json", 1, FULL, ("columns", "unit")),
    ("rows_in_brackets/numpy_str.txt", 3, WIDE, ("angle_min",)),
    ("rows_in_brackets/python_lists.txt", 3, WIDE, ("angle_min",)),
    ("rows_in_brackets/tuples.txt", 1, FULL, ("columns",)),
    ("lrse_dataset/laser.txt", 3, (662, (4.4, 4.0, 3.9)), ("stamps",)),
    ("carmen_rawlaser/run.log", 3, (180, (3.9, 3.4, 3.4)), ()),
    ("carmen_flaser_1081/run.log", 2, (1081, (6.0, 5.0, 4.0)), ("angle_min",)),
    ("player_log/run.log", 3, (180, (3.9, 3.4, 3.4)), ()),
    ("gmapping_gfs/run.gfs", 3, (180, (3.9, 3.4, 3.4)), ()),
    ("multi_echo/echoes.bag", 5, BAG, ()),
    ("numpy_files/scans.npy", 5, BAG, ("angle_min", "unit")),
    ("numpy_files/unnamed.npz", 5, BAG, ("angle_min", "unit")),
    ("numpy_files/other_names.npz", 5, BAG, ("unit",)),
    ("utf16/excel_unicode.txt", 1, HALF, ("unit",)),
]


@pytest.mark.parametrize(("file", "scans", "room", "guessed"), OPEN, ids=[each[0] for each in OPEN])
def test_it_opens_with_the_walls_of_the_room_and_says_what_it_guessed(cases, file, scans, room, guessed):
    recording = open_recording(cases / file)
    beams, lengths = room
    assert (len(recording), recording.beams) == (scans, (beams, beams))
    assert walls(recording)[: len(lengths)] == pytest.approx(lengths, abs=0.15)
    assert set(guessed) <= {guess.field for guess in recording.account.guesses}


# file, what is noticed, the scans and the longest walls after following the advice
ASK = [
    ("range_max_for_no_return/slightly_below.bag", "recurs", {"no_return": "9.99"}, 5, (5.0, 3.0)),
    ("range_max_for_no_return/slightly_below.csv", "recurs", {"no_return": "9.99"}, 5, (5.0, 3.0)),
    ("range_max_for_no_return/plus_one.csv", "recurs", {"no_return": "11"}, 5, (5.0, 3.0)),
    ("range_min_too_large/run.bag", "limits", {"range_min": 0.0}, 5, (6.0, 5.0, 4.0)),
    ("millimetres_in_laserscan/run.bag", "far", {"unit": "mm"}, 5, (6.0, 5.0, 4.0)),
    ("angles_in_degrees/run.bag", "field of view", {"angle_unit": "deg"}, 5, (6.0, 5.0, 4.0)),
    ("layers_on_one_topic/bag", "several lasers", {"frame_id": "world_1_1"}, 5, (4.3, 4.0, 4.0, 2.1, 0.8)),
]


@pytest.mark.parametrize(("file", "kind", "change", "scans", "lengths"), ASK, ids=[each[0] for each in ASK])
def test_what_cannot_be_is_noticed_and_the_advice_mends_it(cases, file, kind, change, scans, lengths):
    (notice,) = open_recording(cases / file).account.notices
    assert (notice.kind, notice.change) == (kind, change)
    mended = open_recording(cases / file, Reading(**notice.change))
    assert len(mended) == scans
    assert len(walls(mended)) == len(lengths)
    assert walls(mended) == pytest.approx(lengths, abs=0.15)
    assert kind not in [each.kind for each in mended.account.notices]


def test_no_guess_offers_what_is_there_already(cases):
    for file, *_ in OPEN:
        recording = open_recording(cases / file)
        for guess in recording.account.guesses:
            with suppress(ValueError):
                other = open_recording(cases / file, Reading(**guess.change)) if guess.change else None
                assert other is None or not alike(recording, other), (file, guess)


def alike(one: Recording, other: Recording) -> bool:
    """Whether two recordings have the same points, limits and stamps."""
    if len(one) != len(other) or one.ranges.shape != other.ranges.shape:
        return False
    names = ("ranges", "range_max", "stamps")
    same = all(np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True) for name in names)
    return same and np.allclose(one[0].bearings, other[0].bearings)


def test_the_angle_row_of_a_matrix_is_no_scan_and_its_first_column_is_time(cases):
    recording = open_recording(cases / "matrix_with_angle_row" / "scan_dist.csv")
    assert (len(recording), recording.stamps.tolist()) == (4, [0.0, 0.5, 1.0, 1.5])
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-120, 120], abs=0.1)
    assert not recording[0].valid[recording[0].ranges == -1].any()


def test_stamps_and_frame_ids_come_from_any_names_of_columns(cases):
    recording = open_recording(cases / "stamp_columns" / "scan.csv")
    assert recording.stamps.tolist() == pytest.approx([100.0, 100.1, 100.2, 100.3])
    assert set(recording.frame_ids) == {"laser"}


def test_one_broken_scan_is_skipped_and_said(cases):
    recording = open_recording(cases / "one_scan_with_one_beam" / "run.bag")
    assert (len(recording), recording.account.skips) == (4, 1)
    assert recording.account.line.endswith("1 skipped")
    assert "message 2 of /scan" in recording.account.skipped_text


def test_a_recording_that_breaks_off_is_read_up_to_there(cases):
    recording = open_recording(cases / "mcap_without_its_end" / "run.mcap")
    (notice,) = recording.account.notices
    assert (len(recording), notice.kind) == (4, "breaks off")


def test_rows_may_vary_in_length(cases):
    recording = open_recording(cases / "varying_rows" / "rows.csv")
    assert (len(recording), recording.beams, recording.account.skips) == (3, (239, 241), 0)


def test_a_folder_of_bags_names_them(cases):
    with pytest.raises(ValueError, match="bag_in_a_folder holds several bags: run1, run2; open one of them"):
        open_recording(cases / "bag_in_a_folder")


def test_the_other_topic_is_named_if_the_first_has_no_scans(cases):
    recording = open_recording(cases / "first_topic_without_messages" / "bag")
    (notice,) = recording.account.notices
    assert (recording.topic, notice.text) == ("/scan_filtered", "/scan has no scans, so /scan_filtered is shown.")


def test_other_echoes_are_read_on_request(cases):
    first, second = (open_recording(cases / "multi_echo" / "echoes.bag", echo=echo) for echo in (0, 1))
    assert np.isfinite(second.ranges).sum() < np.isfinite(first.ranges).sum()
