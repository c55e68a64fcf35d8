"""Messages to a robot: rosbags, another implementation, reads what is written."""

from __future__ import annotations

import base64
import json
import math
from typing import Any

import numpy as np
import pytest
from lineseg_app.bridges.cloud import POINT, Cloud, own_noise
from lineseg_app.bridges.markers import Markers
from lineseg_app.bridges.outgoing import as_json, encoded
from robots import wall
from rosbags.typesys import Stores, get_typestore

from lineseg import Extraction, Params, Scan, extract
from lineseg.covariance import covariances
from lineseg.readers.laser_scan import LaserScan


def found(ranges: list[float]) -> tuple[Extraction, LaserScan, Scan]:
    received = LaserScan(5, 6, "laser/ü", -math.pi / 4, math.pi / 180, 0.0, math.inf, np.float32(ranges))
    return extract(received.beams(), Params()), received, received.beams()


SCANS = {"two": [*wall(2.0)[:45], *[3.0] * 5, *wall(4.0)[50:]], "none": [1.0] * 5}


@pytest.mark.parametrize("ranges", SCANS.values(), ids=SCANS)
@pytest.mark.parametrize("encoding", ["cdr", "ros1"])
def test_both_versions_of_ros_read_the_fields(ranges: list[float], encoding: str):
    extraction, received, scan = found(ranges)
    for message in (Markers(extraction, received), Cloud(extraction, received, scan)):
        package, name = message.type.split("/")
        data, type = encoded(message, encoding), f"{package}/msg/{name}"
        if encoding == "cdr":
            read = get_typestore(Stores.ROS2_HUMBLE).deserialize_cdr(data, type)
        else:
            read = get_typestore(Stores.ROS1_NOETIC).deserialize_ros1(data, type)
        assert_same(read, message.fields())


def assert_same(read: Any, fields: Any) -> None:
    """Every field that is written is read; numbers as the message has them."""
    if isinstance(fields, dict):
        for name, value in fields.items():
            assert_same(getattr(read, {"sec": "sec", "nanosec": "nanosec"}.get(name, name)), value)
    elif isinstance(fields, list):
        assert len(read) == len(fields)
        for one, other in zip(read, fields, strict=True):
            assert_same(one, other)
    elif isinstance(fields, bytes):
        assert read.tobytes() == fields
    else:
        assert read == (pytest.approx(fields, rel=1e-6) if isinstance(fields, float) else fields)


def test_json_has_bytes_in_base64_and_the_names_of_either_version():
    extraction, received, scan = found(SCANS["two"])
    cloud = Cloud(extraction, received, scan)
    fields = json.loads(as_json(cloud.fields(ros1=True)))
    assert fields["header"] == {"stamp": {"secs": 5, "nsecs": 6}, "frame_id": "laser/ü"}
    points = np.frombuffer(base64.b64decode(fields["data"]), POINT)
    assert points["first"].tolist() == [segment.first for segment in extraction.segments]


def test_without_a_known_noise_the_covariance_follows_the_rms_of_each_segment():
    rng = np.random.default_rng(3)
    ranges = np.array(wall(2.0)) + rng.normal(0, 0.01, 91)
    extraction, received, scan = found(ranges.tolist())
    (segment,) = extraction.segments
    (matrix,) = covariances(scan, extraction, own_noise(extraction, scan))
    (point,) = Cloud(extraction, received, scan).points()
    assert point["var_rho"] == pytest.approx(matrix[0, 0], rel=1e-6)
    # Points all around the foot of the perpendicular: the variance of ρ is that of a mean.
    assert math.sqrt(point["var_rho"]) == pytest.approx(segment.rms / math.sqrt(segment.points), rel=0.05)
