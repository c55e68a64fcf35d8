"""Only small objects in front of a wall are looked past."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import room, scans, wall_ahead

from lineseg import Params, Scan, extract, trace

PAPER, PAST = Params(max_occluder=0.0), Params(max_occluder=0.3)
LEG = {88: -0.9, 89: -1.0, 90: -1.0, 91: -1.0, 92: -0.3}
LEG_BEAMS = sorted(LEG)


def spans(scan: Scan, params: Params = PAST) -> list[tuple[int, int]]:
    return [(segment.first, segment.last) for segment in extract(scan, params).segments]


def test_a_wall_behind_a_leg_with_mixed_pixels_at_its_edges_is_one_line():
    scan = wall_ahead(bump=LEG)
    assert len(spans(scan, PAPER)) == 2
    assert spans(scan) == [(0, 179)]
    (segment,) = extract(scan, PAST).segments
    assert segment.points == 175
    assert segment.rms < 1e-9


def test_the_leg_is_in_no_line_and_its_beams_say_so():
    traced = trace(wall_ahead(bump=LEG), PAST)
    assert np.flatnonzero(traced.extraction.labels == -1).tolist() == LEG_BEAMS
    said = traced.explain(90)
    assert (said.segment, said.check, said.limit) == (-1, "max_occluder", 0.3)
    assert "an object that hides at most W_max = 0.300 m of a wall, which lines pass behind" in said.text
    assert "max_occluder" not in {trace(wall_ahead(bump=LEG), PAPER).explain(beam).check for beam in LEG_BEAMS}


def test_beams_lost_beside_an_object_are_not_a_dropout():
    scan = wall_ahead(bump=LEG, lost=range(93, 99))
    assert spans(scan) == [(0, 179)]
    traced = trace(scan, PAST)
    assert np.flatnonzero(traced.looked_past).tolist() == [*LEG_BEAMS, *range(93, 99)]


@pytest.mark.parametrize(
    "bump",
    [
        dict.fromkeys(range(75, 106), -1.0),
        dict.fromkeys(range(88, 93), +1.0),
        dict.fromkeys(range(88, 93), -0.08),
    ],
    ids=["wider than W_max", "behind the wall", "not δ before it"],
)
def test_points_that_are_wide_or_behind_or_part_of_the_wall_stay(bump: dict[int, float]):
    scan = wall_ahead(bump=bump)
    assert not trace(scan, PAST).looked_past.any()
    assert spans(scan) == spans(scan, PAPER)


def test_a_partition_that_points_at_the_laser_is_not_a_thin_object():
    scan = wall_ahead(distance=6.0, beams=1081, bump={540 + k: -4.0 + 0.15 * k for k in range(25)})
    assert not trace(scan, PAST).looked_past[545:560].any()


# Two legs, the second a metre behind the first, with a mixed pixel as the last point of each.
LEGS = {86: -1.5, 87: -1.5, 88: -0.9, 89: -0.5, 90: -0.5, 91: -0.5, 92: -0.2}


def test_several_things_one_behind_the_other_are_looked_past_as_one():
    scan = wall_ahead(bump=LEGS)
    assert np.flatnonzero(trace(scan, PAST).looked_past).tolist() == sorted(LEGS)
    assert spans(scan) == [(0, 179)]


def test_what_is_large_enough_for_a_line_is_not_looked_past():
    # 12 points of a partition, 1.1 m long, which hides little of the wall because it points at the laser.
    partition = {84 + k: -1.8 + 0.1 * k for k in range(12)}
    scan = wall_ahead(bump=partition)
    assert not trace(scan, PAST).looked_past.any()
    assert trace(scan, PAST.but(min_points=13)).looked_past.sum() == 12
    assert trace(scan, PAST.but(min_length=1.5)).looked_past.sum() == 12


def test_on_a_full_circle_a_leg_may_stand_anywhere():
    plain = room(bump={40: -0.8, 41: -0.8})
    for turn in range(0, 360, 30):
        turned = Scan(np.roll(plain.ranges, turn), plain.bearings)
        assert np.flatnonzero(trace(turned, PAST).looked_past).tolist() == sorted(
            ((40 + turn) % 360, (41 + turn) % 360)
        )
        assert len(spans(turned)) == len(spans(plain)) == 4


@given(scans(), st.sampled_from([0.1, 0.3, 1.0]))
def test_points_looked_past_are_in_no_line_and_end_no_line(scan: Scan, widest: float):
    traced = trace(scan, Params(max_occluder=widest))
    past = traced.looked_past
    assert (traced.extraction.labels[past] == -1).all()
    assert not past[[end for segment in traced.extraction.segments for end in (segment.first, segment.last)]].any()
    assert not trace(scan, PAPER).looked_past.any()
