"""Windows that need no test, because three of their points fit in no seed."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from lineseg import Params
from lineseg.region_growing.limits import limits_of, unpacked
from lineseg.region_growing.points import Points
from lineseg.region_growing.seed import is_edge

# Off the normal of the line, whose direction is drawn by itself.
angles = st.lists(st.floats(-1.569, 1.569), min_size=3, max_size=3)
errors = st.lists(st.sampled_from([-1.0, -0.99, 0.0, 0.99, 1.0]), min_size=3, max_size=3)


def edge(ranges, bearings, delta):
    x, y = ranges * np.cos(bearings), ranges * np.sin(bearings)
    numbers = np.arange(3, dtype=np.int32)
    points = Points(x, y, numbers, np.zeros_like(numbers), 0, 3, False, 3)
    return is_edge(points, 1, unpacked(limits_of(Params(delta=delta))))


@settings(max_examples=5 * settings.default.max_examples)
@given(angles, errors, st.floats(-3.0, 3.0), st.floats(0.01, 20.0), st.sampled_from([0.01, 0.1, 1.0]))
@example([0.5, 0.5, 0.5], [-1.0, -0.99, 0.0], 0.0, 0.25, 0.01)
def test_points_within_delta_of_a_line_are_not_an_edge(angles, errors, direction, distance, delta):
    bearings = direction + np.array(angles)
    incidence = np.cos(bearings - direction)
    ranges = distance / incidence + delta * np.array(errors)
    assume((ranges > 0.0).all())
    assert not edge(ranges, bearings, delta)


@pytest.mark.parametrize("ranges", [(4.0, 4.6, 4.6), (4.6, 4.6, 4.0), (4.0, 4.0, 4.6), (4.6, 4.0, 4.6)])
def test_a_step_in_the_range_is_an_edge(ranges):
    assert edge(np.array(ranges), np.array([0.0, 0.01, 0.02]), 0.1)
