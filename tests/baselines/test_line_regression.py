"""Line regression clusters the lines of a sliding window by how significantly they differ."""

import numpy as np
import pytest
from scenes import corner, scan_of, wall_ahead

from lineseg import EXTRACTORS, Noise, Segment, covariance
from lineseg.baselines.line_regression import distance_of

REGRESSION = EXTRACTORS["line-regression"]
Params = REGRESSION.params_type


def test_the_distance_of_two_clusters_is_that_of_mahalanobis():
    scan = wall_ahead(beams=40, noise=0.01, seed=2)
    x, y = scan.xy.T.copy()
    sigma, exact = np.full(40, 0.02), np.zeros(40)
    parts, models = [(0, 14), (20, 39)], []
    for first, last in parts:
        xy = scan.xy[first : last + 1]
        normal = np.linalg.svd(xy - xy.mean(axis=0))[2][1]
        normal *= np.sign(normal @ xy.mean(axis=0))
        line = (*normal, -normal @ xy.mean(axis=0))
        segment = Segment(line, (0, 0), (0, 0), first, last, last - first + 1, 1.0, 0.0)
        models.append(([segment.rho, segment.theta], covariance(scan, segment, Noise(0.02))))
    apart = np.subtract(models[0][0], models[1][0])
    expected = apart @ np.linalg.solve(models[0][1] + models[1][1], apart)
    assert distance_of(x, y, sigma, exact, *parts[0], *parts[1]) == pytest.approx(expected, rel=1e-9)


def test_the_distance_is_the_same_for_both_forms_of_a_line_through_the_laser():
    x = np.linspace(1, 3, 20)
    for height in (1e-9, -1e-9):
        y = np.where(np.arange(20) < 10, height, -height)
        assert distance_of(x, y, np.full(20, 0.01), np.full(20, 0.001), 0, 9, 10, 19) == pytest.approx(0, abs=1e-6)


def test_windows_over_a_corner_belong_to_no_cluster():
    traced = REGRESSION.trace(corner(beams=400, noise=0.005), Params(window=11, max_spread=1.0))
    clusters = [traced[int(i)] for i in traced.indices("cluster found")]
    at_corner = int(np.argmin(np.hypot(*(traced.scan.xy - (3, 2)).T)))
    assert not any(each.first + 5 < at_corner < each.last - 5 for each in clusters)


def test_clusters_of_one_wall_merge_nearest_first_until_the_limit():
    traced = REGRESSION.trace(wall_ahead(beams=300, noise=0.02, seed=1), Params(max_spread=1.0, max_merge=9.0))
    merges = [traced[int(i)] for i in traced.indices("clusters merged")]
    assert len(traced.indices("cluster found")) > len(merges) > 0
    assert all(merge.value < merge.limit == 9.0 for merge in merges)
    ended = len(traced.extraction.segments) + len(traced.extraction.dropped)
    assert ended == len(traced.indices("cluster found")) - len(merges)


def test_a_shallow_bend_merges_only_where_the_noise_could_have_made_it():
    bend = scan_of([(2, -1.5, 2, 0), (2, 0, 1.9, 1.5)], beams=300, field_of_view=1.2, noise=0.004)
    found = {sigma: REGRESSION.extract(bend, Params(sigma=sigma)).segments for sigma in (0.006, 0.1)}
    assert (len(found[0.006]), len(found[0.1])) == (2, 1)
