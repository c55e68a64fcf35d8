"""LaserScan as JSON from rosbridge, Foxglove or any program that posts it."""

import json

import numpy as np
import pytest

from lineseg.readers.laser_scan import decode_json

PLAIN = {"angle_min": -1.0, "angle_increment": 0.5, "ranges": [1.0, 2.0, 3.0]}


def test_null_means_no_return_and_the_stamp_is_kept_to_the_nanosecond():
    header = {"stamp": {"sec": 1_700_000_000, "nanosec": 123_456_789}, "frame_id": "laser"}
    scan = decode_json(PLAIN | {"header": header, "ranges": [1.5, None, 2.5], "range_max": None})
    np.testing.assert_array_equal(scan.ranges, np.array([1.5, np.nan, 2.5], np.float32))
    assert (scan.seconds, scan.nanoseconds, scan.frame_id) == (1_700_000_000, 123_456_789, "laser")
    assert (scan.range_min, scan.range_max) == (0.0, np.inf)


def test_the_names_of_ros_1_are_known():
    scan = decode_json(PLAIN | {"header": {"seq": 3, "stamp": {"secs": 7, "nsecs": 5}, "frame_id": "laser"}})
    assert (scan.seconds, scan.nanoseconds) == (7, 5)


def test_the_increment_follows_from_the_last_angle():
    scan = decode_json({"angle_min": -1.0, "angle_max": 1.0, "ranges": [1.0, 2.0, 3.0]})
    assert scan.angle_increment == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("message", "sentence"),
    [
        ([1.0], "a LaserScan is an object with ranges"),
        ({"data": "hello"}, "ranges is missing"),
        (PLAIN | {"ranges": "1 2 3"}, "ranges is '1 2 3'"),
        (PLAIN | {"ranges": [1.0, "far"]}, "neither a number nor null"),
        (PLAIN | {"ranges": [[1.0, 2.0]]}, "neither a number nor null"),
        (PLAIN | {"angle_min": "left"}, "angle_min is 'left'"),
        (PLAIN | {"angle_min": None}, "its angle_min is nan"),
        (PLAIN | {"angle_increment": True}, "angle_increment is True"),
        ({"angle_min": 0.0, "ranges": [1.0]}, "angle_increment .* is missing"),
        (PLAIN | {"header": {"stamp": {"sec": -1}}}, "the stamp's sec is -1"),
    ],
)
def test_a_message_that_is_not_a_scan_is_named(message, sentence):
    with pytest.raises(ValueError, match=sentence):
        decode_json(message)


def test_half_a_character_in_a_name_can_be_sent_on():
    scan = decode_json(PLAIN | {"header": {"frame_id": json.loads('"la\\ud800ser"')}})
    assert scan.frame_id.encode() == b"la?ser"
