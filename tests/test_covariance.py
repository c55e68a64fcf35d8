"""Whether the covariance of a line matches its distance from the truth."""

import numpy as np
import pytest
from scenes import room, scan_of, wall_ahead

from lineseg import Noise, Params, Scan, Segment, covariance, covariances, extract

RUNS = 400
# Everything the noise can do stays within ε: what is tested is the fit, not the choice of points.
LOOSE = Params(epsilon=0.2, delta=100.0, min_length=0.05, min_points=3, seed_points=3)


def simulated(scene, noise, seed):
    """Measure a scene with noisy bearings and ranges."""
    rng = np.random.default_rng(seed)
    reported = scene(0).bearings
    true = scene(rng.normal(0, noise.bearing, len(reported)) if noise.bearing else 0)
    return Scan(true.ranges + rng.normal(0, noise.range, len(reported)), reported)


def seen(*walls, beams, bearings):
    """A scene of infinite walls x·cos θ + y·sin θ = ρ, as seen along `bearings` that may be off."""

    def scene(error):
        angles = np.linspace(*bearings, beams) + error
        with np.errstate(divide="ignore"):
            ranges = np.array([rho / np.cos(angles - theta) for rho, theta in walls])
        return Scan(np.min(np.where(ranges > 0, ranges, np.inf), axis=0), np.linspace(*bearings, beams))

    return scene


def mean_nees(scene, truth, noise, believed=None):
    """The normalised estimation error squared of (ρ, θ), averaged over the runs: near 2 if the covariance is true."""
    total = 0.0
    for seed in range(RUNS):
        scan = simulated(scene, noise, seed)
        extraction = extract(scan, LOOSE)
        thetas = np.array([segment.theta for segment in extraction.segments])
        nearest = int(np.argmin(np.abs((thetas - truth[1] + np.pi) % (2 * np.pi) - np.pi)))
        segment = extraction.segments[nearest]
        turn = (segment.theta - truth[1] + np.pi) % (2 * np.pi) - np.pi
        error = np.array([segment.rho - truth[0], turn])
        matrix = covariances(scan, extraction, believed or noise)[nearest]
        total += error @ np.linalg.solve(matrix, error)
    return total / RUNS


def band(runs=RUNS):
    """Interval that holds the mean of `runs` values of χ² with 2 degrees of freedom in 95 % of cases."""
    return 2 - 1.96 * 2 / np.sqrt(runs), 2 + 1.96 * 2 / np.sqrt(runs)


SCENES = {
    "a near wall": ((0.6, 0.2), 120, (-0.5, 0.7), Noise(0.01)),
    "a far wall": ((25.0, 0.0), 160, (-0.15, 0.15), Noise(0.02)),
    "a grazing wall": ((0.8, 0.0), 90, (1.2, 1.45), Noise(0.005)),
    "few points": ((2.0, -0.4), 5, (-0.6, 0.4), Noise(0.01)),
    "many points": ((3.0, 0.3), 2000, (-0.5, 1.0), Noise(0.01)),
    "noisy bearings": ((4.0, 0.1), 150, (-0.4, 0.9), Noise(0.0, 0.002)),
    "both noises": ((2.0, 0.5), 150, (-0.4, 1.2), Noise(0.01, 0.003)),
}


@pytest.mark.parametrize(("wall", "beams", "bearings", "noise"), SCENES.values(), ids=SCENES.keys())
def test_errors_are_as_large_as_the_covariance_says(wall, beams, bearings, noise):
    low, high = band()
    assert low < mean_nees(seen(wall, beams=beams, bearings=bearings), wall, noise) < high


def test_errors_of_a_wall_across_the_seam_are_as_large_as_the_covariance_says():
    walls = [(2.0, 0.0), (1.5, np.pi / 2), (2.5, np.pi), (1.8, -np.pi / 2)]
    scene = seen(*walls, beams=360, bearings=(-np.pi, np.pi - np.radians(1)))
    segments = extract(simulated(scene, Noise(0.01), 0), LOOSE).segments
    assert sum(segment.last < segment.first for segment in segments) == 1
    low, high = band()
    assert low < mean_nees(scene, walls[2], Noise(0.01)) < high


def test_half_the_true_noise_is_detected_as_too_small():
    wall, beams, bearings, noise = SCENES["both noises"]
    nees = mean_nees(seen(wall, beams=beams, bearings=bearings), wall, noise, Noise(noise.range / 2, noise.bearing / 2))
    assert nees > 3 * band()[1]


def fitted(scan):
    (segment,) = extract(scan, LOOSE).segments
    return segment


def test_the_derivatives_are_those_of_the_fit():
    scan = wall_ahead(beams=9, noise=0.02, seed=4)
    step, gradients = 1e-7, []
    for beam in range(9):
        high, low = (
            fitted(Scan(scan.ranges + sign * step * (np.arange(9) == beam), scan.bearings)) for sign in (1, -1)
        )
        gradients.append(np.array([high.rho - low.rho, high.theta - low.theta]) / (2 * step))
    expected = sum(np.outer(each, each) for each in gradients)
    assert covariance(scan, fitted(scan), Noise(1.0)) == pytest.approx(expected, rel=1e-5)


def test_a_segment_alone_and_among_all_has_the_same_covariance():
    scan, noise = room(noise=0.01, lost=(3, 40, 41)), Noise(0.01, 0.001)
    extraction = extract(scan)
    assert len(extraction.segments) == 4
    for segment, matrix in zip(extraction.segments, covariances(scan, extraction, noise), strict=True):
        assert covariance(scan, segment, noise) == pytest.approx(matrix)


def test_each_beam_may_have_a_noise_of_its_own():
    scan = wall_ahead(noise=0.01)
    segment = fitted(scan)
    one, proportional = Noise(0.02), Noise(0.01 * scan.ranges)
    assert covariance(scan, segment, Noise(np.full(180, 0.02))) == pytest.approx(covariance(scan, segment, one))
    assert covariance(scan, segment, proportional)[0, 0] > covariance(scan, segment, one)[0, 0]


def test_turning_the_laser_leaves_the_covariance_and_a_mirror_turns_its_sign_off_the_diagonal():
    scan, noise = scan_of([(1, -1, 3, 2)], noise=0.01, field_of_view=1.0), Noise(0.01, 0.002)
    matrix = covariance(scan, fitted(scan), noise)
    turned, mirrored = Scan(scan.ranges, scan.bearings + 1.1), Scan(scan.ranges, -scan.bearings)
    assert covariance(turned, fitted(turned), noise) == pytest.approx(matrix)
    assert covariance(mirrored, fitted(mirrored), noise) == pytest.approx(matrix * [[1, -1], [-1, 1]])


def test_nothing_is_singular_where_the_wall_points_at_the_laser():
    bearings = np.full(50, 0.0)
    scan = Scan(np.linspace(1, 3, 50), bearings)
    matrix = covariance(scan, fitted(scan), Noise(0.01, 0.001))
    assert np.isfinite(matrix).all()
    assert matrix[1, 1] > 0
    assert fitted(scan).rho == pytest.approx(0, abs=1e-12)


def test_points_without_a_direction_have_no_covariance():
    scan = Scan(np.full(20, 2.0), np.full(20, 0.3))
    segment = Segment((1.0, 0.0, -2.0), (2.0, 0.0), (2.0, 0.0), 0, 19, 20, 0.0, 0.0)
    assert np.isnan(covariance(scan, segment, Noise(0.01))).all()


def test_a_scan_without_segments_has_no_covariances():
    scan = Scan(np.full(20, np.nan), np.linspace(0, 1, 20))
    assert covariances(scan, extract(scan), Noise(0.01)).shape == (0, 2, 2)


@pytest.mark.parametrize("sigma", [-0.1, np.nan, np.inf])
def test_an_invalid_standard_deviation_is_refused(sigma):
    with pytest.raises(ValueError, match=f"the noise of a range is {sigma:g}; a standard deviation is 0 m or more"):
        Noise(sigma)
    with pytest.raises(ValueError, match="the noise of a bearing"):
        Noise(0.01, np.array([0.0, sigma]))
