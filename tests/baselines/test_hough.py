"""The Hough transform sees lines through the cells of its grid."""

import numpy as np
import pytest
from scenes import room, scan_of, wall_ahead

from lineseg import EXTRACTORS, Scan
from lineseg.baselines.hough import Grid
from lineseg.baselines.sequence import sequence_of

HOUGH = EXTRACTORS["hough"]
Params = HOUGH.params_type


def grid_of(scan, **params):
    points = sequence_of(scan)
    grid = Grid(points, Params(**params))
    grid.count(points, np.arange(len(points.x)), 1)
    return points, grid


def test_every_point_votes_once_for_every_direction():
    points, grid = grid_of(room(noise=0.01), theta_step_deg=2.0)
    assert np.array_equal(grid.votes.sum(axis=1), np.full(90, len(points.x)))
    grid.count(points, np.arange(len(points.x)), -1)
    assert not grid.votes.any()


def test_a_wall_on_the_grid_has_all_the_votes_of_its_cell():
    points, grid = grid_of(wall_ahead(distance=2.0), rho_step=0.05)
    angle, cell = grid.peak()
    assert (angle, (cell - grid.middle) * grid.step) == (0, pytest.approx(2.0))
    assert grid.votes[angle, cell] == len(points.x)


@pytest.mark.parametrize("step", [1.0, 5.0])
def test_turning_by_whole_cells_turns_the_segments_and_by_half_a_cell_splits_the_votes(step):
    scan = wall_ahead(distance=2.0, beams=400)
    votes = []
    for turn in (0.0, 3.0, 2.5):
        turned = Scan(scan.ranges, scan.bearings + np.radians(turn * step))
        _, grid = grid_of(turned, theta_step_deg=step, rho_step=0.01)
        votes.append(int(grid.votes.max()))
    assert votes[0] == pytest.approx(votes[1], abs=2)
    assert votes[2] < 0.8 * votes[0]


def test_the_line_is_not_quantised_for_it_is_fitted_to_its_points():
    scan = scan_of([(2.013, -1.5, 2.113, 1.5)], field_of_view=1.0)
    (segment,) = HOUGH.extract(scan, Params(theta_step_deg=3.0)).segments
    assert segment.rms < 1e-9


def test_two_walls_on_one_line_share_a_peak_and_are_two_segments():
    scan = scan_of([(2, -2, 2, -0.5), (2, 0.6, 2, 2)], field_of_view=1.5, beams=300)
    traced = HOUGH.trace(scan, Params())
    assert len(traced.extraction.segments) == 2
    peaks = [traced[int(i)] for i in traced.indices("peak found")][:2]
    assert peaks[0].line == pytest.approx(peaks[1].line, abs=0.1)
    assert peaks[0].value > peaks[1].value


def test_a_laser_that_sees_very_far_gets_a_coarser_grid_and_no_more_memory():
    scan = Scan.regular(np.linspace(5000, 9000, 200), 0, 0.01)
    _, grid = grid_of(scan, rho_step=0.001, theta_step_deg=0.25)
    assert grid.votes.size < 8_100_000
    assert grid.step > 0.001
