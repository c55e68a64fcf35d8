"""Each procedure of the paper, on scenes built for it."""

import numpy as np
import pytest
from lineseg_app.places import data_folder
from scenes import corner, room, scan_of, wall_ahead

from lineseg import Params, Scan, extract, open_recording, trace


def test_a_bumped_point_is_named_with_the_threshold_it_broke():
    scan = wall_ahead(distance=2.0, bump={3: 0.2})
    why = trace(scan, Params(epsilon_growth=0.0)).explain(beam=3)
    assert (why.check, why.limit) == ("epsilon", 0.03)
    assert why.value == pytest.approx(0.2 * np.cos(scan.bearings[3]), abs=0.01)
    assert why.segment == -1
    assert why.margin < 0


def test_epsilon_grows_with_the_range_and_the_trace_says_what_it_was_at_the_point():
    params = Params(epsilon=0.03, epsilon_growth=0.015)
    bump = {3: 0.2}
    near, far = wall_ahead(distance=2.0, bump=bump), wall_ahead(distance=14.0, half_width=10, bump=bump)
    refused = trace(near, params).explain(3)
    joined = trace(far, params).explain(3)
    assert (refused.segment, joined.segment) == (-1, 0)
    assert refused.limit == pytest.approx(np.hypot(0.03, 0.015 * near.ranges[3]))
    assert joined.limit == pytest.approx(np.hypot(0.03, 0.015 * far.ranges[3]))
    assert all(
        each.limit == pytest.approx(float(params.epsilon_at(far.ranges[each.beam])))
        for each in trace(far, params)
        if each.kind == "point added"
    )
    assert trace(far, params.but(epsilon_growth=0.0)).explain(3).limit == 0.03


def test_a_wall_is_one_segment_from_its_first_beam_to_its_last():
    (segment,) = extract(wall_ahead()).segments
    assert (segment.first, segment.last, segment.points) == (0, 179, 180)
    assert segment.line == pytest.approx((1, 0, -2))
    assert (segment.rho, segment.theta) == pytest.approx((2, 0))
    assert segment.length == pytest.approx(2 * 2 * np.tan(0.6))


def test_a_corner_is_cut_where_the_second_wall_becomes_the_nearer_one():
    traced = trace(corner(noise=0.005))
    first, second = traced.extraction.segments
    (cut,) = [traced[i] for i in traced.indices("overlap cut")]
    assert second.first == first.last + 1 == cut.beam
    assert np.hypot(*np.subtract(first.end, (3, 2))) < 0.1
    assert cut.value >= cut.limit


def test_two_grown_lines_on_one_wall_are_merged():
    # A bump stops the first line; the second grows back over it, since by then its line is long and sure.
    walls = [(2, -3, 2, 3)]
    bend = dict.fromkeys(range(52, 55), 0.036)
    traced = trace(scan_of(walls, beams=160, field_of_view=1.8, bump=bend), Params(delta=0.02, epsilon=0.03))
    assert len(traced.extraction.segments) <= 2
    for i in traced.indices("lines merged"):
        assert traced[i].value < traced[i].limit


def test_delta_keeps_a_break_out_of_a_seed_where_epsilon_cannot_see_it():
    # Along a wall that the beams graze, a recess of 4 cm is a metre along the beam.
    walls = [(4.9, -0.2, 5, -0.2), (6, -0.24, 9, -0.24)]
    scan = scan_of(walls, beams=400, field_of_view=0.16)
    sharp, blunt = (trace(scan, Params(delta=delta, max_void=0.0)) for delta in (0.1, 1000.0))
    refused = [sharp[i] for i in sharp.indices("seed rejected")]
    assert {decision.check for decision in refused} == {"delta"}
    assert len(blunt.indices("seed rejected")) == 0
    assert sharp[sharp.indices("seed found")[0]].first > blunt[blunt.indices("seed found")[0]].first


def test_a_seed_has_exactly_s_num_points():
    traced = trace(wall_ahead(), Params(seed_points=7))
    (seed,) = [traced[i] for i in traced.indices("seed found")]
    assert seed.points == 7


@pytest.mark.parametrize(("max_dropout", "segments"), [(0, 2), (1, 2), (2, 1)])
def test_a_line_crosses_as_many_lost_beams_as_max_dropout_allows(max_dropout, segments):
    scan = wall_ahead(lost=(90, 91))
    assert len(extract(scan, Params(max_dropout=max_dropout)).segments) == segments


def test_a_beam_that_two_lines_took_says_which_kept_it_and_by_what_distance():
    traced = trace(open_recording(data_folder("sample_scans") / "lessons" / "1_perfect_corner.npz")[0])
    why = traced.explain(86)
    assert why.segment == 0
    # By the second line's growth it was 0.029 m away, but that is not the line that kept it.
    assert why.value == pytest.approx(0.0, abs=0.001)
    assert why.text.endswith("another line contained it too, and the cut at beam 87 left it to this one")
    assert "cut" not in traced.explain(60).text


def test_a_beam_of_a_merged_line_says_so():
    scan = open_recording(data_folder("sample_scans") / "lessons" / "5_shallow_corner.npz")[0]
    traced = trace(scan, Params(merge_rms=0.0))
    for beam in (20, 90):
        assert traced.explain(beam).text.endswith("then two lines merged into this one, 3.5° apart, less than 5.7°")


def test_a_lost_beam_says_so():
    why = trace(wall_ahead(lost=(7,))).explain(7)
    assert (why.segment, why.text) == (-1, "beam 7 has no return: its range is nan")


def test_readings_at_the_maximum_range_are_no_returns():
    scan = Scan.regular(np.full(50, 30.0), -0.5, 0.02, range_max=30.0)
    assert extract(scan).segments == ()
    assert "not below the laser's maximum of 30 m" in trace(scan).explain(3).text


def test_a_wall_across_the_seam_is_one_segment():
    scan = room(noise=0.005)
    segments = extract(scan).segments
    assert len(segments) == 4
    assert sum(segment.last < segment.first for segment in segments) == 1
    assert all(segment.points > 40 for segment in segments)


def test_a_short_line_is_dropped_with_the_missing_length():
    (dropped,) = extract(wall_ahead(half_width=0.2, beams=400)).dropped
    assert (dropped.check, dropped.limit) == ("min_length", 0.6)
    assert dropped.value == pytest.approx(0.4, abs=0.02)


def test_points_far_away_are_fitted_as_exactly_as_near_ones():
    near, far = (extract(wall_ahead(d, field_of_view=1.2 / d), Params(min_length=0.1)).segments[0] for d in (1.0, 60.0))
    assert near.rms < 1e-12
    assert far.rms < 1e-12
    assert far.line == pytest.approx((1, 0, -60), abs=1e-9)


@pytest.mark.parametrize("beams", [0, 1, 2, 3, 5])
def test_scans_with_fewer_beams_than_a_seed_have_no_segments(beams):
    scan = Scan.regular(np.ones(beams), 0.0, 0.01)
    assert extract(scan).segments == ()
    assert len(trace(scan)) == 0
    assert trace(scan).lines_at(-1) == ()


def test_a_scan_without_any_return_has_no_segments():
    for empty in (np.nan, np.inf, 0.0, -1.0):
        assert extract(Scan.regular(np.full(360, empty), 0.0, np.radians(1))).segments == ()


def test_equal_points_do_not_break_the_fit():
    scan = Scan(np.full(20, 2.0), np.full(20, 0.3))
    assert extract(scan, Params(min_length=0.0)).segments[0].length == pytest.approx(0)
