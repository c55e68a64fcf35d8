import gzip

import numpy as np
import pytest

from lineseg.readers import open_recording

POSES = "0.1 0.2 0.3 0.1 0.2 0.3"


def flaser(ranges, word="FLASER", stamp=12.5):
    return f"{word} {len(ranges)} {' '.join(map(str, ranges))} {POSES} {stamp} pippo {stamp}"


def robotlaser(ranges, start=-1.570796, view=3.14, increment=0.017453, longest=80.0, word="ROBOTLASER1", remissions=()):
    tail = f"{len(remissions)} {' '.join(map(str, remissions))} {POSES} 0 0 0 0 0 1211.5 x 0.01"
    return f"{word} 0 {start} {view} {increment} {longest} 0.01 0 {len(ranges)} {' '.join(map(str, ranges))} {tail}"


@pytest.fixture
def log(tmp_path):
    def write(*lines, name="corridor.log"):
        path = tmp_path / name
        data = "\n".join(lines).encode() + b"\n"
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        return path

    return write


@pytest.mark.parametrize(
    ("beams", "step", "last"), [(180, 1.0, 89.0), (181, 1.0, 90.0), (360, 0.5, 89.5), (361, 0.5, 90.0)]
)
def test_flaser_lines_without_angles_begin_at_minus_90_degrees(log, beams, step, last):
    scan = open_recording(log(flaser([1.0] * beams)))[0]
    assert np.rad2deg(scan.bearings[[0, -1]]) == pytest.approx([-90, last])
    assert np.rad2deg(np.diff(scan.bearings)) == pytest.approx(step)


def test_a_comment_with_the_word_flaser_is_not_a_scan(log):
    path = log(
        "# message formats defined: PARAM SYNC ODOM FLASER RLASER", "PARAM a b nohost 0", "", flaser([1.0] * 181)
    )
    recording = open_recording(path)
    assert (len(recording), recording.format, recording.stamps[0]) == (1, "CARMEN log", 12.5)


def test_gzip_is_unpacked_whatever_the_name(log):
    assert len(open_recording(log(flaser([1.0] * 181), flaser([2.0] * 181), name="corridor.gz"))) == 2


def test_the_angles_of_robotlaser_lines_do_not_depend_on_the_stated_field_of_view(log):
    right, wrong = (open_recording(log(robotlaser([1.0] * 181, view=view)))[0] for view in (3.14159, 3.15904))
    assert np.array_equal(right.bearings, wrong.bearings)
    assert right.bearings[-1] == pytest.approx(-1.570796 + 180 * 0.017453)


def test_remissions_are_stepped_over(log):
    assert open_recording(log(robotlaser([1.0] * 10, remissions=[7.0] * 10))).stamps[0] == 1211.5


def test_each_message_is_a_topic(log):
    path = log(flaser([1.0] * 181), flaser([2.0] * 180, "RLASER"), robotlaser([3.0] * 90, word="ROBOTLASER2"))
    recording = open_recording(path)
    assert (recording.topic, [topic.name for topic in recording.topics]) == (
        "FLASER",
        ["FLASER", "RLASER", "ROBOTLASER2"],
    )
    assert open_recording(path, topic="RLASER").beams == (180, 180)


@pytest.mark.parametrize(
    ("codes", "farthest"), [((81.91, 81.87), 79.3), ((51.16, 51.11), 49.09), ((8.191, 8.183), 7.9)]
)
def test_codes_above_what_the_laser_can_measure_are_no_returns(log, codes, farthest):
    scan = open_recording(log(flaser([1.0, farthest, *codes, *codes])))[0]
    assert scan.valid.tolist() == [True, True, False, False, False, False]


def test_readings_at_the_announced_maximum_are_no_returns(log):
    scan = open_recording(log(robotlaser([1.0, 29.99, 30.0, 30.0], longest=30.0)))[0]
    assert scan.valid.tolist() == [True, True, False, False]


def test_an_announced_maximum_that_many_readings_exceed_is_not_believed(log):
    scan = open_recording(log("PARAM robot_front_laser_max 10 nohost 0", flaser([9.0, 11.0, 12.5, 13.25, 14.75])))[0]
    assert scan.valid.all()


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("FLASER 180 1.0 2.0", "corridor.log:2: FLASER announces 180 ranges, but 2 values follow."),
        ("FLASER 3 1.0 x 3.0", "corridor.log:2: FLASER has 'x' among its ranges; they must be numbers."),
        ("FLASER many 1.0", "corridor.log:2: FLASER has 'many' instead of the number of its ranges."),
        ("FLASER", "corridor.log:2: FLASER breaks off after 1 words; its ranges begin at word 3."),
        ("FLASER 999999999999 1.0", "corridor.log:2: FLASER announces 999999999999 ranges, but 1 value follows."),
        (robotlaser([1.0], increment="x"), "corridor.log:2: ROBOTLASER1 has 'x' in its header; it must be a number."),
    ],
)
def test_a_broken_line_is_named_and_hides_no_other(log, line, sentence):
    recording = open_recording(log(flaser([1.0] * 181), line))
    (skipped,) = recording.account.skipped
    assert (len(recording), f"{skipped.place}: {skipped.why}.") == (1, sentence)
    with pytest.raises(ValueError) as raised:
        open_recording(log(line))
    assert str(raised.value) == sentence.replace(":2:", ":1:")


def test_a_log_without_a_laser_says_so(log):
    with pytest.raises(ValueError, match=r"^corridor[.]log has no laser line"):
        open_recording(log("ODOM 0 0 0 0 0 0 1.0 x 1.0"))


def test_truncated_gzip_is_read_up_to_there(log, tmp_path):
    lines = [flaser(np.round(np.random.default_rng(seed).uniform(1, 9, 181), 2)) for seed in range(300)]
    whole = log(*lines, name="corridor.log.gz").read_bytes()
    broken = tmp_path / "broken.log.gz"
    broken.write_bytes(whole[: len(whole) // 2])
    recording = open_recording(broken)
    assert 100 < len(recording) < 200
    notice, *_ = recording.account.notices
    assert notice.text.startswith("The gzip data are incomplete")


def test_laser1_lines_have_ranges_and_a_stamp_but_no_pose(log):
    recording = open_recording(log(f"LASER1 181 {'2.0 ' * 181}7.5 host 7.5", f"LASER1 181 {'3.0 ' * 181}8.5 host 8.5"))
    assert (recording.topic, recording.stamps.tolist()) == ("LASER1", [7.5, 8.5])
    assert np.rad2deg(recording[0].bearings[[0, -1]]) == pytest.approx([-90, 90])
    assert recording.track.found.source.missing == "LASER1 lines have none"
