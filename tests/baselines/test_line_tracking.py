"""Line tracking goes from point to point, and never back."""

import numpy as np
import pytest
from scenes import corner, wall_ahead

from lineseg import EXTRACTORS, Scan

TRACKING = EXTRACTORS["line-tracking"]
Params = TRACKING.params_type


def spans(scan, **params):
    return [(each.first, each.last) for each in TRACKING.extract(scan, Params(**params)).segments]


def test_the_points_at_a_corner_go_to_the_line_that_comes_first():
    scan = corner(beams=400, noise=0.004)
    backward = Scan(scan.ranges[::-1].copy(), scan.bearings[::-1].copy())
    (_, forward_ends), _ = spans(scan, epsilon=0.06)
    _, (backward_begins, _) = spans(backward, epsilon=0.06)
    # Counted in the same direction, the line behind the corner ends later where it came first.
    assert forward_ends > 399 - backward_begins


def test_a_bump_ends_the_line_and_is_named():
    traced = TRACKING.trace(wall_ahead(bump={90: 0.2}), Params())
    assert spans(traced.scan)[0] == (0, 89)
    refused = traced[int(traced.indices("point refused")[0])]
    assert (refused.beam, refused.check, refused.limit) == (90, "epsilon", 0.04)
    assert refused.value == pytest.approx(0.2, abs=0.01)


@pytest.mark.parametrize(("lost", "lines"), [(3, 1), (30, 2)])
def test_a_gap_ends_the_line_only_if_it_is_wide(lost, lines):
    scan = wall_ahead(lost=range(80, 80 + lost))
    assert len(spans(scan, max_gap=0.3)) == lines


def test_a_start_with_large_errors_ends_soon():
    lines = [
        sum(
            len(TRACKING.trace(wall_ahead(noise=0.02, seed=seed), Params(start_points=n)).jump("seed"))
            for seed in range(9)
        )
        for n in (2, 8)
    ]
    assert lines[0] > lines[1]


def test_a_start_over_a_corner_hides_it():
    whole = corner(beams=60)
    scan = Scan(whole.ranges[35:], whole.bearings[35:])
    begun = {n: TRACKING.trace(scan, Params(start_points=n))[0] for n in (4, 12)}
    assert begun[4].line == pytest.approx((1, 0, -3), abs=1e-6)
    assert abs(begun[12].line[1]) > 0.05
    assert begun[12].last > int(np.argmin(np.hypot(*(scan.xy - (3, 2)).T)))
