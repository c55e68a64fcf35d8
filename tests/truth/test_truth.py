"""The scores against the truth, on scenes with a known answer."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from scenes import chipped, corner, room, scan_of, scans, wall_ahead

from lineseg import Extraction, Params, Recording, Scan, Segment, extract, open_recording
from lineseg.truth import UNKNOWN, Agreement, agreement, agreements, match, near_lines, true_ends, true_lines

SAMPLES = Path(__file__).parents[2] / "sample_scans"


def walled(scan, wall):
    return Scan(scan.ranges, scan.bearings, wall=np.asarray(wall))


def test_true_lines_are_the_walls_that_are_long_enough_and_seen_often_enough():
    scan = corner()
    wall = np.where(np.arange(180) < 100, 0, 1)
    assert np.array_equal(true_lines(walled(scan, wall)), np.where(scan.valid, wall, -1))
    most = max(np.count_nonzero(scan.valid & (wall == each)) for each in (0, 1))
    assert true_lines(walled(scan, wall), Params(min_points=most)).max() == 0
    assert true_lines(walled(scan, wall), Params(min_length=50)).max() == -1


def test_a_beam_without_a_return_is_on_no_true_line():
    labels = true_lines(walled(wall_ahead(lost=(7,)), np.zeros(180, int)))
    assert labels[7] == -1
    assert labels.max() == 0


@pytest.mark.parametrize(("beams", "lines"), [(4, 1), (30, 2)])
def test_only_a_broad_object_splits_the_wall_behind_it(beams, lines):
    scan = wall_ahead()
    before = np.abs(np.arange(180) - 90) < beams / 2
    seen = Scan(np.where(before, 1.0, scan.ranges), scan.bearings, wall=np.where(before, -1, 0))
    assert true_lines(seen).max() + 1 == lines


def test_sparse_points_alone_do_not_split_a_wall():
    scan = scan_of([(30, -6, 30, 6)], beams=20, field_of_view=0.38)
    assert true_lines(walled(scan, np.zeros(20, int))).max() == 0


def test_a_true_line_may_cross_the_seam():
    scan = room()
    wall = np.full(360, 1)
    wall[:40] = wall[320:] = 0
    labels = true_lines(walled(scan, wall))
    assert len(set(labels[wall == 0].tolist())) == 1


def test_beams_missing_at_the_seam_cut_a_wall_only_where_a_dropout_does():
    scan = room(width=6.0, beams=720)
    wall = np.where(np.abs(scan.bearings) > 2.7, 0, -1)
    for missing, lines in ((2, 1), (9, 2)):
        chip = chipped(walled(scan, wall), missing)
        assert true_lines(chip, occlusion=0.15).max() + 1 == lines


def test_scans_of_a_real_room_are_full_circles_although_beams_are_missing_at_the_seam(data_dir):
    scan = open_recording(data_dir.parent / "truth" / "lroom_a.npz")[0]
    assert (len(scan), scan.around) == (897, 898)


@pytest.mark.parametrize(
    ("params", "near", "true"),
    [
        (Params(min_length=4.0), False, True),
        (Params(min_length=5.0), True, False),
        (Params(min_length=9.0), False, False),
    ],
)
def test_a_segment_on_a_wall_that_is_just_short_is_neither_right_nor_false(params, near, true):
    scan = walled(scan_of([(3, -2.2, 3, 2.2)], beams=180, field_of_view=2.0), np.zeros(180, int))
    assert (true_lines(scan, params).max() >= 0, near_lines(scan, params).max() >= 0) == (true, near)
    found = agreement(extract(scan), true_lines(scan, params), near=near_lines(scan, params))
    assert (found.segments, found.matches, found.neutral) == (1, int(true), int(near))
    assert found.false_rate == 1 - true
    assert near == math.isnan(found.neutral_false_rate)


def test_too_few_points_make_a_wall_near_as_too_little_length_does():
    scan = walled(wall_ahead(), np.zeros(180, int))
    seen = int(scan.valid.sum())
    assert near_lines(scan, Params(min_points=seen)).max() == -1
    assert near_lines(scan, Params(min_points=seen + 1)).max() == 0
    assert near_lines(scan, Params(min_points=int(seen / 0.69))).max() == -1


def test_a_recording_is_scored_with_its_near_lines_and_by_labels_without():
    recording = open_recording(SAMPLES / "hallway.npz").only(np.arange(0, 300, 15))
    found = Agreement.of_all(each for each in agreements(recording) if each)
    assert 0 < found.neutral < found.segments
    assert found.neutral_false_rate < found.false_rate
    by_labels = agreements(recording, truth=lambda frame: true_lines(recording[frame]))
    assert sum(each.neutral for each in by_labels if each) == 0


def test_scoring_requires_truth():
    with pytest.raises(ValueError, match="no true walls"):
        true_lines(corner())


def test_a_perfect_extraction_agrees_in_full():
    scan = corner()
    found = agreement(extract(scan), extract(scan).labels)
    assert (found.true_rate, found.false_rate, found.completeness) == (1, 0, 1)


def test_two_equal_halves_match_no_wall_and_unequal_parts_match_once():
    scan = wall_ahead(lost=range(87, 93))
    truth = true_lines(walled(scan, np.zeros(180, int)))
    assert agreement(extract(scan), truth).matches == 0
    scan = wall_ahead(lost=range(118, 123))
    found = agreement(extract(scan), true_lines(walled(scan, np.zeros(180, int))))
    assert found == Agreement(true_lines=1, segments=2, matches=1, shared=pytest.approx(118 / 175), splits=1)


def test_agreements_add_up_and_an_empty_one_has_no_rates():
    both = Agreement(4, 5, 3, 2.7) + Agreement(1, 0, 0, 0.0)
    assert (both.true_rate, both.false_rate, both.completeness) == pytest.approx((0.6, 0.4, 0.9))
    assert all(math.isnan(value) for value in (Agreement().true_rate, Agreement().false_rate, Agreement().completeness))


def test_without_segments_every_true_line_is_missed():
    blind = extract(Scan(np.full(5, np.nan), np.zeros(5)))
    assert agreement(blind, np.zeros(5, np.int32)) == Agreement(1, 0, 0, 0.0)


def found(labels) -> Extraction:
    """An extraction with these labels, its segments from (0, label) to (1, label)."""
    labels = np.asarray(labels, np.int32)
    segments = [
        Segment((0.0, 1.0, -float(k)), (0.0, float(k)), (1.0, float(k)), 0, 0, 2, 1.0, 0.0)
        for k in range(labels.max(initial=-1) + 1)
    ]
    return Extraction("by hand", Params(), tuple(segments), labels, ())


def test_unknown_beams_count_neither_for_nor_against():
    truth = np.array([0] * 6 + [UNKNOWN] * 14)
    matching = match(found([0] * 10 + [1] * 10), truth)
    assert matching.overlap[0, 0] == 1
    assert matching.unknown.tolist() == [False, True]
    assert matching.agreement == Agreement(true_lines=1, segments=1, matches=1, shared=1.0)


def test_a_line_in_two_pieces_is_a_split_and_its_larger_piece_may_match():
    matching = match(found([0] * 7 + [1] * 3), np.zeros(10, int))
    assert (matching.agreement.splits, matching.agreement.merges) == (1, 0)
    assert matching.segment_of.tolist() == [0]
    assert matching.line_of.tolist() == [0, -1]


def test_a_segment_over_two_lines_is_a_merge():
    matching = match(found([0] * 10), np.repeat((0, 1), 5))
    assert (matching.agreement.splits, matching.agreement.merges) == (0, 1)
    assert matching.segment_of.tolist() == [-1, -1]
    assert matching.line_of.tolist() == [-1]


def test_a_segment_that_only_reaches_into_the_next_line_merges_nothing():
    matching = match(found([0] * 7 + [1] * 3), np.repeat((0, 1), 5))
    assert (matching.agreement.splits, matching.agreement.merges) == (0, 0)
    assert matching.agreement.matches == 2


@given(scans(), scans())
def test_matching_is_one_to_one_in_any_order(one, other):
    n = min(len(one), len(other))
    first, second = extract(one).labels[:n], extract(other).labels[:n]
    there, back = match(found(first), second), match(found(second), first)
    assert np.allclose(there.overlap, back.overlap.T)
    for matching in (there, back):
        for line, segment in enumerate(matching.segment_of):
            assert segment < 0 or matching.line_of[segment] == line
        counts = np.count_nonzero(matching.segment_of >= 0), np.count_nonzero(matching.line_of >= 0)
        assert counts == (matching.agreement.matches,) * 2
    assert (there.agreement.splits, there.agreement.merges) == (back.agreement.merges, back.agreement.splits)


def test_the_ends_of_a_true_line_are_those_of_the_wall():
    ends = true_ends(corner(noise=0.01, beams=2000), np.where(corner(beams=2000).bearings < np.arctan2(2, 3), 0, 1))
    assert ends[0] == pytest.approx(np.array([(3, -4), (3, 2)]), abs=0.05)
    assert ends[1][0] == pytest.approx(np.array((3, 2)), abs=0.03)
    assert np.ptp(ends[0][:, 0]) < 0.003


def test_ends_are_found_across_the_seam_and_not_without_a_return():
    scan = room(width=6, depth=4)
    wall = np.where(np.abs(scan.bearings) > 2.9, 0, -1)
    assert sorted(true_ends(scan, wall)[0][:, 1]) == pytest.approx(
        [-2.7 * np.tan(np.pi - 2.9), 2.7 * np.tan(np.pi - 2.9)], abs=0.05
    )
    assert np.isnan(true_ends(Scan(np.full(4, np.nan), np.zeros(4)), np.zeros(4, int))).all()


@pytest.mark.parametrize("turned", [False, True])
def test_endpoint_errors_are_distances_whichever_end_was_drawn_first(turned):
    ends = np.array([[(0.0, 0.3), (1.4, 0.0)]])
    matching = match(found([0] * 5), np.zeros(5, int), ends[:, ::-1] if turned else ends)
    assert sorted(matching.endpoint_errors[0]) == pytest.approx([0.3, 0.4])
    assert matching.agreement.endpoint_error() == pytest.approx(0.35)
    assert matching.agreement.endpoint_error(100) == pytest.approx(0.4)


def test_without_ends_there_are_no_endpoint_errors():
    assert math.isnan(agreement(found([0] * 5), np.zeros(5, int)).endpoint_error())


def test_a_recording_is_scored_frame_by_frame_and_in_all():
    recording = open_recording(SAMPLES / "hallway.npz")
    frames = [*agreements(recording)]
    total = Agreement.of_all(frames)
    assert (len(frames), total) == (300, sum(frames, Agreement()))
    assert len(total.endpoint_errors) == 2 * total.matches
    assert 0 < total.endpoint_error() < total.endpoint_error(95) < 1


def test_frames_without_truth_are_left_out():
    scans_of_walls = [walled(wall_ahead(), np.zeros(180, int))] * 2
    truth = [None, np.zeros(180, int)]
    first, second = agreements(Recording.from_scans(scans_of_walls), truth=truth.__getitem__)
    assert first is None
    assert (second.matches, second.true_rate) == (1, 1)
