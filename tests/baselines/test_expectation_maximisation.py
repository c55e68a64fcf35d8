"""Expectation maximisation lets lines share the points until they settle."""

import numpy as np
import pytest
from scenes import corner, room, wall_ahead

from lineseg import EXTRACTORS
from lineseg.baselines.expectation_maximisation import OUTLIER, VOCABULARY, expectation, first_pieces, maximise, settled
from lineseg.baselines.found import Found
from lineseg.baselines.sequence import sequence_of

EM = EXTRACTORS["expectation-maximisation"]
Params = EM.params_type


def unheard(points):
    return Found(points, Params(), VOCABULARY, traced=False)


def likelihood(points, mixture, sigma):
    """Of the mixture, up to a constant."""
    distances = np.array([points.distances(line) for line in mixture.lines])
    return np.log(OUTLIER + mixture.shares @ np.exp(-0.5 * (distances / sigma) ** 2)).sum()


def test_no_iteration_makes_the_points_less_likely():
    scan, params = corner(beams=300, noise=0.01), Params()
    points = sequence_of(scan)
    mixture = first_pieces(points, params, unheard(points))
    known = [likelihood(points, mixture, params.sigma)]
    for _ in range(15):
        weights = expectation(points, mixture, params.sigma)
        maximise(points.x, points.y, weights, mixture.lines, mixture.shares)
        known.append(likelihood(points, mixture, params.sigma))
    assert np.all(np.diff(known) > -1e-6)
    assert known[-1] > known[0] + 10


def test_the_weights_of_a_point_and_the_outliers_are_one():
    points = sequence_of(room(noise=0.01))
    mixture = first_pieces(points, Params(), unheard(points))
    weights = expectation(points, mixture, 0.01)
    assert np.all(weights.sum(axis=1) < 1)
    assert np.all(weights >= 0)


@pytest.mark.parametrize(("scene", "lines"), [(wall_ahead, 1), (corner, 2), (room, 4)])
def test_many_initial_pieces_end_as_one_line_for_each_wall(scene, lines):
    points, params = sequence_of(scene(noise=0.01)), Params(piece=12)
    assert len(first_pieces(points, params, unheard(points)).lines) > 2 * lines
    mixture = settled(points, params, unheard(points))
    assert len(mixture.lines) == lines


def test_it_converges_before_the_last_iteration():
    scan = room(noise=0.01)
    traced = EM.trace(scan, Params(iterations=200))
    again = EM.trace(scan, Params(iterations=1000))
    assert np.array_equal(traced.log, again.log)


def test_a_line_moves_until_it_explains_the_wall():
    traced = EM.trace(wall_ahead(noise=0.01), Params())
    moves = [traced[int(i)] for i in traced.indices("line moved")]
    last = moves[-1]
    assert last.value > 150
    assert len(traced.indices("line doubled")) > 0
    assert last.line == pytest.approx(traced.extraction.segments[0].line, abs=0.01)
