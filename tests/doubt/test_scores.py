"""The scores that need no truth, on scenes with a known answer."""

import numpy as np
import pytest
from scenes import corner, room, scan_of, wall_ahead

from lineseg import Params, Recording, Scan, extract
from lineseg.doubt import SCORES
from lineseg.survey import survey


def scores_of(*scans, params=None):
    """The scores of the last of the scans, by name."""
    return dict(zip(SCORES, survey(Recording.from_scans(scans), params).scores[-1].tolist(), strict=True))


def test_a_single_wall_is_covered_and_not_doubtful():
    scores = scores_of(wall_ahead(distance=2.0))
    later = dict.fromkeys(("unstable", "disputed", "lapsed", "blank"), np.nan)
    assert scores == pytest.approx(
        dict.fromkeys(SCORES, 0) | {"segments": 1, "coverage": 1} | later, abs=1e-3, nan_ok=True
    )


def test_coverage_counts_valid_beams_only_and_invalid_the_rest():
    scan = wall_ahead(lost=range(45))
    assert scores_of(scan)["coverage"] == 1
    assert scores_of(scan)["invalid"] == pytest.approx(45 / 180)


def test_a_blind_frame_is_not_covered():
    scores = scores_of(Scan(np.full(20, np.nan), np.linspace(-1, 1, 20)))
    assert scores["coverage"] == 0
    assert scores["invalid"] == 1
    assert scores["segments"] == scores["rms"] == scores["gap"] == scores["change"] == 0


def test_the_largest_rms_and_widest_gap_are_those_of_the_segments():
    scan = corner(beams=60, noise=0.01)
    segments, labels = extract(scan).segments, extract(scan).labels
    steps = [np.hypot(*np.diff(scan.xy[labels == label], axis=0).T) for label in range(len(segments))]
    beside = [np.maximum(np.append(0, each[:-1]), np.append(each[1:], 0)) for each in steps]
    gaps = [(step - other)[step > 0.3] for step, other in zip(steps, beside, strict=True)]
    scores = scores_of(scan)
    assert scores["rms"] == pytest.approx(max(segment.rms for segment in segments), rel=1e-6)
    assert scores["gap"] == pytest.approx(max(each.max(initial=0) for each in gaps), rel=1e-6)
    assert scores["gap"] > 0


def test_a_gap_bridged_over_lost_beams_is_found():
    scan = wall_ahead(beams=20, lost=(9, 10))
    across, beside = (np.hypot(*(scan.xy[k] - scan.xy[8])) for k in (11, 7))
    assert scores_of(scan, params=Params(max_void=0.0))["gap"] == pytest.approx(across - beside, abs=1e-3)
    assert scores_of(scan)["gap"] == 0


def test_far_points_of_a_wall_seen_at_a_grazing_angle_bridge_nothing():
    grazing = scan_of([(1, 0.5, 30, 0.5)], beams=200, field_of_view=0.9)
    assert extract(grazing).segments[0].length > 20
    assert scores_of(grazing)["gap"] < 2
    assert max(np.hypot(*np.diff(grazing.xy[grazing.valid], axis=0).T)) > 4


def test_a_fit_near_epsilon_is_reported():
    assert scores_of(wall_ahead(noise=0.012), params=Params(epsilon=0.06))["near"] == 0
    assert scores_of(wall_ahead(noise=0.012), params=Params(epsilon=0.04, delta=0.2))["near"] == 0
    assert scores_of(wall_ahead(noise=0.02), params=Params(epsilon=0.06))["near"] == 0
    rough = Scan(wall_ahead().ranges + 0.02 * (-1.0) ** np.arange(180), wall_ahead().bearings)
    assert scores_of(rough)["near"] == 1


@pytest.mark.parametrize(("lost", "pairs"), [(5, 1), (40, 0)])
def test_neighbours_on_one_line_are_a_pair_only_if_they_are_near(lost, pairs):
    scan = wall_ahead(lost=range(88, 88 + lost), noise=0.002)
    assert scores_of(scan)["segments"] == 2
    assert scores_of(scan)["splits"] == pairs


def test_the_walls_of_a_corner_are_not_a_pair():
    scan = corner(noise=0.002)
    assert scores_of(scan)["segments"] == 2
    assert scores_of(scan)["splits"] == 0


def test_neighbours_on_parallel_lines_are_not_a_pair():
    step = scan_of([(2, -1.5, 2, 0), (2.2, 0, 2.2, 1.5)], field_of_view=1.2)
    assert scores_of(step)["segments"] == 2
    assert scores_of(step)["splits"] == 0


def test_a_pair_may_lie_at_the_seam_of_a_full_circle():
    scan = room(lost=(0, 1, 357, 358, 359), noise=0.002)
    assert scores_of(scan)["splits"] == 1


def test_a_wall_that_is_noisier_than_epsilon_is_a_probable_miss():
    noisy = wall_ahead(noise=0.02, seed=3)
    params = Params(epsilon=0.025)
    assert scores_of(noisy, params=params)["segments"] == 0
    assert scores_of(noisy, params=params)["misses"] == 1
    assert scores_of(wall_ahead(noise=0.005), params=params)["misses"] == 0


def test_clutter_is_not_a_probable_miss():
    rng = np.random.default_rng(5)
    clutter = Scan(rng.uniform(1, 5, 300), np.linspace(-2, 2, 300))
    assert scores_of(clutter)["misses"] == 0


def test_misses_are_found_between_segments_and_at_both_ends():
    scan, beam = scan_of([(2, -3, 2, 3)], beams=120, field_of_view=1.6), np.arange(120)
    rough = 0.024 * (-1.0) ** beam / np.cos(scan.bearings)
    for first, last in ((0, 40), (40, 80), (80, 120)):
        part = (beam >= first) & (beam < last)
        scores = scores_of(
            Scan(np.where(part, scan.ranges + rough, scan.ranges), scan.bearings), params=Params(epsilon=0.02)
        )
        assert scores["misses"] == 1
        assert scores["coverage"] == pytest.approx(2 / 3, abs=0.05)


def test_nothing_changes_between_equal_frames():
    assert scores_of(room(noise=0.01), room(noise=0.01))["change"] == 0


def test_the_first_frame_has_no_change():
    assert scores_of(corner())["change"] == 0


def test_all_changes_where_segments_come_or_go():
    blind = Scan(np.full(180, np.nan), corner().bearings)
    assert scores_of(corner(), blind)["change"] == 1
    assert scores_of(blind, corner())["change"] == 1


def test_change_is_the_share_of_bearings_that_left_their_segment():
    whole = wall_ahead(noise=0.001)
    half = Scan(np.where(whole.bearings < 0.3, whole.ranges, np.nan), whole.bearings)
    assert scores_of(whole, half)["change"] == pytest.approx(0.25, abs=0.01)
    # Of two parts only the one that has more than half of the wall is the same segment.
    cut = Scan(np.where((whole.bearings > 0.2) & (whole.bearings < 0.25), np.nan, whole.ranges), whole.bearings)
    assert scores_of(whole, cut)["change"] == pytest.approx(0.4 / 1.2, abs=0.01)


def test_change_does_not_depend_on_the_seam():
    scan = room(noise=0.005)
    turned = Scan(np.roll(scan.ranges, 50), scan.bearings - np.deg2rad(50))
    assert scores_of(scan, turned)["change"] < 0.02


def test_change_is_the_same_wherever_a_full_circle_is_opened():
    # The farthest point and the widest gap lie where a door stands open; it tells where the circle is opened.
    before, now = room(bump={0: 3.0}), room(bump={95: 3.0})
    turned = [Scan(np.roll(scan.ranges, 90), scan.bearings) for scan in (before, now)]
    assert scores_of(before, now)["change"] == pytest.approx(scores_of(*turned)["change"])


def test_scores_are_the_same_for_a_mirrored_scan():
    scan = corner(beams=400, noise=0.01)
    mirrored = Scan(scan.ranges, -scan.bearings)
    assert scores_of(scan, scan) == pytest.approx(scores_of(mirrored, mirrored), abs=1e-6, nan_ok=True)


def test_every_score_says_what_it_is():
    for name, score in SCORES.items():
        assert score.name == name
        assert score.label
        assert score.help.endswith(".")
        assert score.worse in ("higher", "lower")
        assert score.least > 0
        assert score.weight >= 0
