"""The textbook's Split-and-Merge and the iterative end-point fit."""

from __future__ import annotations

import numpy as np
from scenes import corner, scan_of, wall_ahead

from lineseg import extract, trace
from lineseg.baselines.iterative_end_point_fit import EndPointFitParams
from lineseg.baselines.split_and_merge_textbook import TextbookParams


def spans(scan, params):
    return [(s.first, s.last) for s in extract(scan, params).segments]


def test_the_end_point_fit_draws_its_line_through_the_first_and_the_last_point():
    scan = wall_ahead(noise=0.01)
    (segment,) = extract(scan, EndPointFitParams(split_distance=0.1)).segments
    assert np.allclose((segment.start, segment.end), scan.xy[[0, -1]])
    assert abs(segment.distance(scan.xy[[0, -1]])).max() < 1e-12


def test_the_textbook_fits_all_points():
    scan = wall_ahead(noise=0.01)
    (segment,) = extract(scan, TextbookParams(split_distance=0.1)).segments
    (chord,) = extract(scan, EndPointFitParams(split_distance=0.1)).segments
    assert segment.rms < chord.rms


def test_the_textbook_measures_a_line_between_its_projected_ends():
    # Its last point lies 7 cm behind the wall: to it the way is longer than the line is.
    scan = wall_ahead(beams=100, field_of_view=0.3, bump={99: 0.07})
    params = TextbookParams(split_distance=0.1, min_length=0.1)
    (segment,) = extract(scan, params).segments
    ends = float(np.hypot(*(scan.xy[99] - scan.xy[0])))
    assert segment.length < ends - 1e-3
    assert spans(scan, params.but(min_length=segment.length - 1e-6)) == [(0, 99)]
    assert spans(scan, params.but(min_length=ends - 1e-6)) == []


def test_both_split_a_corner_at_its_farthest_point():
    scan = corner(beams=400)
    for params in (EndPointFitParams(), TextbookParams()):
        (first, last), (start, _) = spans(scan, params)
        assert start == last + 1 and first < start
        seams = [decision for decision in trace(scan, params) if decision.kind == "split"]
        assert start in [decision.beam for decision in seams]
        assert all(decision.value >= decision.limit for decision in seams)


def test_only_the_textbook_puts_back_together_what_a_bend_of_the_noise_split():
    bend = dict.fromkeys(range(88, 93), 0.05)
    scan = wall_ahead(half_width=9.0, bump=bend)
    limit = 0.045
    assert len(spans(scan, EndPointFitParams(split_distance=limit))) > 1
    assert spans(scan, TextbookParams(split_distance=0.06)) == [(0, 179)]
    kinds = [decision.kind for decision in trace(scan, TextbookParams(split_distance=limit))]
    assert "lines kept apart" in kinds or "lines merged" in kinds


def test_a_gap_parts_two_walls_of_one_line():
    scan = scan_of([(2, -1.5, 2, -0.4), (2, 0.4, 2, 1.5)], beams=400, field_of_view=1.2)
    for params in (EndPointFitParams, TextbookParams):
        assert len(spans(scan, params(max_gap=0.5))) == 2
        assert len(spans(scan, params(max_gap=1.0))) == 1
