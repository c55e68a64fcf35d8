"""RANSAC draws random samples, the same every time, and ignores outliers."""

import numpy as np
import pytest
from scenes import room, wall_ahead

from lineseg import EXTRACTORS, Scan
from lineseg.baselines.ransac import below, best_pair
from lineseg.kernel import entry_kernel

RANSAC = EXTRACTORS["ransac"]
Params = RANSAC.params_type


@entry_kernel
def draw(n, state, numbers):
    for k in range(len(numbers)):
        numbers[k] = below(n, state)


def drawn(n, seed, count=10_000):
    numbers = np.empty(count, np.int64)
    draw(n, np.array([seed], np.uint64), numbers)
    return numbers


def test_the_numbers_are_those_of_splitmix64():
    # The first outputs of the published generator for the state 0.
    first = [0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F]
    assert drawn(1 << 31, 0, 3).tolist() == [(each >> 33) % (1 << 31) for each in first]


def test_every_number_is_drawn_about_as_often():
    counts = np.bincount(drawn(10, 7), minlength=10)
    assert counts.min() > 850
    assert counts.max() < 1150


def test_the_same_seed_finds_the_same_and_another_draws_other_samples():
    scan = room(noise=0.02)
    one, again, other = (RANSAC.trace(scan, Params(seed=seed)) for seed in (1, 1, 2))
    assert one.extraction.segments == again.extraction.segments
    assert np.array_equal(one.log, again.log)
    samples = [trace.log[trace.indices("best sample")]["line"] for trace in (one, other)]
    assert samples[0].tolist() != samples[1].tolist()


def test_the_best_pair_has_as_many_votes_as_its_line_has_near_points():
    rng = np.random.default_rng(3)
    x, y = rng.normal(0, 1, (2, 60))
    i, j, votes = best_pair(x, y, 50, 59, 0.1, np.array([5], np.uint64))
    direction = np.array([x[j] - x[i], y[j] - y[i]]) / np.hypot(x[j] - x[i], y[j] - y[i])
    distances = np.abs(direction[0] * (y - y[i]) - direction[1] * (x - x[i]))
    assert votes == np.count_nonzero(distances < 0.1)


@pytest.mark.parametrize("share", [0.1, 0.3])
def test_outliers_do_not_turn_the_line(share):
    scan = wall_ahead(distance=3.0, beams=300, half_width=3, noise=0.005)
    rng = np.random.default_rng(8)
    outlying = rng.random(300) < share
    spoiled = Scan(np.where(outlying, rng.uniform(0.5, 2.5, 300), scan.ranges), scan.bearings)
    segments = RANSAC.extract(spoiled, Params(bridge=20)).segments
    longest = max(segments, key=lambda segment: segment.points)
    assert longest.rho == pytest.approx(3.0, abs=0.01)
    assert longest.theta == pytest.approx(0.0, abs=0.01)
    assert longest.points > 0.9 * np.count_nonzero(~outlying)


def test_few_samples_miss_what_many_find():
    scan = room(beams=720, noise=0.01)
    covered = [np.mean([RANSAC.extract(scan, Params(trials=n, seed=s)).covered for s in range(6)]) for n in (1, 200)]
    assert covered[1] > covered[0]
