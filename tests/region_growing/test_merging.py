"""When two lines become one: by their directions, as in the paper, and by how well one line fits (an extension)."""

import numpy as np
import pytest
from scenes import wall_ahead

from lineseg import Params, Scan, extract, trace

UNASKED = Params(merge_rms=0.0)


def wall_with(offsets):
    """A wall 2 m ahead, 3.4 m long, with 1 cm of noise; offsets: {beam: added range [m]}."""
    scan = wall_ahead(noise=0.01)
    ranges = np.array(scan.ranges)
    for beam, offset in offsets.items():
        ranges[beam] += offset
    return Scan(ranges, scan.bearings)


def test_a_stray_point_does_not_split_a_wall():
    middle = len(wall_ahead().ranges) // 2
    scan = wall_with({middle: 0.08})
    assert len(extract(scan, UNASKED).segments) == 2
    (segment,) = extract(scan).segments
    assert segment.points == scan.valid.sum()
    assert [event.kind for event in trace(scan) if event.kind == "lines merged"] == ["lines merged"]


def test_more_strays_than_max_dropout_split_it():
    middle = len(wall_ahead().ranges) // 2
    scan = wall_with({middle + k: 0.05 * (-1) ** k for k in range(3)})
    assert len(extract(scan).segments) == 1
    assert len(extract(scan, Params(max_dropout=0)).segments) == 2


def test_strays_far_from_the_wall_split_it_because_one_line_would_fit_badly():
    middle = len(wall_ahead().ranges) // 2
    scan = wall_with({middle: 0.6, middle + 1: 0.6})
    params = Params(max_void=0)
    assert len(extract(scan, params).segments) == 2
    (event,) = [event for event in trace(scan, params) if event.kind == "lines kept apart"]
    assert event.check == "merge_rms"
    assert event.value > event.limit
    assert "merged, their rms would be" in event.text


@pytest.mark.parametrize("growth", [0.0, 1.2])
def test_a_wall_without_noise_stays_whole(growth):
    assert len(extract(wall_ahead(), Params(merge_rms=growth)).segments) == 1
