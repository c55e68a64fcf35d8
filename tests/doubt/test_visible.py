"""A line that only this frame lacks is a failure if the frame shows enough of it."""

import numpy as np
import pytest
from scenes import wall_ahead

from lineseg import Recording, extract
from lineseg.doubt.visible import is_there, shows_enough
from lineseg.survey import survey

WALL = wall_ahead(distance=2.0)


def asked(ranges, points=10, length=0.6):
    """Whether a wall from (2, −1) to (2, 1) should have been found; 139 beams point at it."""
    ends = (2.0, -1.0, 2.0, 1.0)
    return bool(shows_enough(ends, np.ravel(WALL.rays), np.asarray(ranges), 0.0, np.inf, float(points), length))


@pytest.mark.parametrize("lost", [0, 60, 180])
def test_a_wall_that_is_in_view_should_be_found_also_where_returns_are_lost(lost):
    ranges = WALL.ranges.copy()
    middle = len(ranges) // 2
    ranges[middle - lost // 2 : middle + lost - lost // 2] = np.nan
    assert asked(ranges)


def test_rough_points_still_show_a_wall():
    assert asked(WALL.ranges + np.random.default_rng(1).normal(0, 0.04, len(WALL.ranges)))


def hidden(count):
    """The wall with something nearer before as many beams in its middle."""
    ranges = WALL.ranges.copy()
    middle = len(ranges) // 2
    ranges[middle - count // 2 : middle + count - count // 2] = 1.0
    return ranges


def test_a_wall_hidden_in_part_comes_and_goes_and_one_hidden_at_once_does_not():
    assert not asked(hidden(110))
    assert asked(hidden(30))
    assert asked(hidden(180))


def test_a_wall_that_is_barely_long_enough_or_seen_by_few_beams_comes_and_goes():
    assert not asked(WALL.ranges, points=100)
    assert not asked(WALL.ranges, length=1.5)


def test_points_beyond_the_line_show_that_it_ended():
    assert not asked(np.where(WALL.ranges > 0, WALL.ranges + 1.0, WALL.ranges))


def shown(ends):
    """Whether a wall ahead of the laser, from (2, −1) to (2, 1) and beyond, shows a line between these ends."""
    segments = survey(Recording.from_scans([WALL])).segments
    assert len(segments) == len(extract(WALL).segments) == 1
    return bool(is_there(ends, segments, np.ravel(WALL.rays), WALL.ranges))


def test_a_wall_that_is_cut_or_placed_otherwise_is_there():
    assert shown((2.0, -1.0, 2.0, 1.0))
    assert shown((2.3, -1.0, 2.3, 1.0))
    assert not shown((3.0, -1.0, 2.2, 1.0))
