"""Split-and-Merge: what the program prints, what its slips cost, and how a weighted line is fitted and merged."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import corner, scan_of, wall_ahead

from lineseg import EXTRACTORS, Scan, agreement, extract, open_recording, trace, true_lines
from lineseg.baselines.split_and_merge import SplitAndMergeParams
from lineseg.baselines.weighted_fit import Fitting, Polar, chi_squared, combined, fit_weighted

REPAIRED = SplitAndMergeParams(loses_points=False, loses_last_beam=False, unwrapped=False)


@pytest.mark.parametrize("name", ["hallway", "lab"])
def test_segments_equal_the_program_within_five_millimetres(printed, name):
    total = found = 0
    for scan, rows in printed(name, "split_and_merge"):
        ends = np.array([(*s.start, *s.end) for s in extract(scan, SplitAndMergeParams()).segments]).reshape(-1, 2, 2)
        for row in rows:
            apart = np.hypot(*(ends - np.reshape(row[:4], (2, 2))).transpose(2, 0, 1)).max(axis=1)
            total += 1
            found += bool(apart.min(initial=np.inf) < 5e-3)
    assert found >= 0.98 * total > 600


def test_each_split_loses_the_point_before_it_and_the_last_of_its_second_part():
    scan = corner(beams=400)
    first, second = extract(scan, REPAIRED).segments
    assert first.last + 1 == second.first and second.last == 399
    slipped = extract(scan, REPAIRED.but(loses_points=True)).segments
    assert (slipped[0].last, slipped[1].first, slipped[1].last) == (first.last - 1, second.first, 398)


def test_the_last_beam_is_lost():
    scan = wall_ahead(noise=0.002)
    assert extract(scan, REPAIRED).segments[0].last == 179
    assert extract(scan, REPAIRED.but(loses_last_beam=True)).segments[0].last == 178


def test_a_single_stray_point_is_an_outlier_and_splits_nothing():
    scan = wall_ahead(noise=0.002, bump={90: 0.5})
    (segment,) = extract(scan, REPAIRED).segments
    assert (segment.first, segment.last, segment.points) == (0, 179, 179)
    outliers = [decision for decision in trace(scan, REPAIRED) if decision.kind == "outlier"]
    assert [(each.beam, each.check) for each in outliers] == [(90, "outlier_distance")]
    assert len(extract(scan, REPAIRED.but(outlier_distance=1.0, merge_distance=0.0)).segments) == 2


def test_a_wall_cut_by_a_post_is_merged_by_chi_squared():
    scan = scan_of([(2, -1.5, 2, 1.5), (1.5, -0.04, 1.5, 0.04)], beams=400, field_of_view=1.2, noise=0.004, seed=2)
    (segment,) = extract(scan, REPAIRED).segments
    assert (segment.first, segment.last) == (0, 399)
    apart = extract(scan, REPAIRED.but(merge_distance=0.0)).segments
    assert len(apart) == 2
    merged = [decision for decision in trace(scan, REPAIRED) if decision.kind == "lines merged"]
    assert merged and all(0 <= each.value < 3 for each in merged)


def test_a_wall_behind_the_laser_is_merged_only_if_angles_are_wrapped():
    behind = scan_of([(2, -1.5, 2, 1.5), (1.5, -0.04, 1.5, 0.04)], beams=400, field_of_view=1.2, noise=0.004, seed=2)
    turned = Scan(behind.ranges, behind.bearings + np.pi)
    assert len(extract(turned, REPAIRED).segments) == 1


@settings(max_examples=40)
@given(angle=st.floats(-3.0, 3.0), seed=st.integers(0, 1000))
def test_with_range_noise_alone_the_weighted_line_minimises_its_sum(angle, seed):
    scan = wall_ahead(noise=0.01, seed=seed)
    how = Fitting(0.01**2, 1e-12, 1e-10, 1e-10)
    cosines, sines = scan.rays
    fit = fit_weighted(scan.ranges, cosines, sines, 0, 179, (np.cos(0.05), np.sin(0.05), -2.0), how)

    def cost(radius, turn):
        along = np.cos(turn - scan.bearings)
        return np.sum((scan.ranges * along - radius) ** 2 / (0.01 * along) ** 2)

    least = cost(fit.radius, fit.angle)
    for radius, turn in ((1e-4, 0), (-1e-4, 0), (0, 1e-4), (0, -1e-4), (1e-4 * np.cos(angle), 1e-4 * np.sin(angle))):
        assert cost(fit.radius + radius, fit.angle + turn) > least


def test_its_covariance_is_that_of_repeated_fits():
    how = Fitting(0.01**2, 1e-12, 1e-10, 1e-10)
    fits = []
    for seed in range(600):
        scan = wall_ahead(noise=0.01, seed=seed)
        fits.append(fit_weighted(scan.ranges, *scan.rays, 0, 179, (1.0, 0.0, -2.0), how))
    found = np.cov(np.array([each[:2] for each in fits]).T)
    said = np.array([[fits[0].rr, fits[0].ra], [fits[0].ra, fits[0].aa]])
    assert found[0, 0] == pytest.approx(said[0, 0], rel=0.2)
    assert found[1, 1] == pytest.approx(said[1, 1], rel=0.2)


def test_two_equal_estimates_combine_to_the_same_with_half_the_variance():
    one = Polar(2.0, 0.3, 4e-4, 1e-4, 1e-4)
    assert combined(one, one) == pytest.approx((2.0, 0.3, 2e-4, 5e-5, 5e-5))
    assert chi_squared(one, one) == 0.0


def test_repairing_the_slips_finds_more_of_the_true_lines():
    recording = open_recording("sample_scans/hallway.npz")
    scans = [recording[frame] for frame in range(0, len(recording), 40)]
    rates = []
    for params in (SplitAndMergeParams(), REPAIRED):
        found = [agreement(extract(scan, params), true_lines(scan)) for scan in scans]
        rates.append(sum(found[1:], found[0]).true_rate)
    assert rates[1] > rates[0]


@pytest.mark.parametrize("name", ["authors", "split-and-merge"])
def test_real_recordings_raise_no_error(name, data_dir):
    method = EXTRACTORS[name]
    seen = 0
    for path in sorted(data_dir.glob("*/*")):
        try:
            recording = open_recording(path)
        except ValueError:
            continue
        for frame in range(0, len(recording), max(1, len(recording) // 3)):
            result = method.extract(recording[frame], method.params_type())
            assert all(np.isfinite((*segment.line, *segment.start, *segment.end)).all() for segment in result.segments)
            seen += 1
    assert seen > 20
