"""The authors' program: what it prints, and the effect of each of its slips."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from scenes import corner, scan_of, scans, wall_ahead

from lineseg import Params, extract, trace
from lineseg.baselines.authors import AuthorsParams

SLIPS = [name for name, kind, _ in AuthorsParams.knobs() if kind is bool]
REPAIRED = AuthorsParams(ends_early=False, two_more_points=False, skips_after_erased=False)
PAPER = AuthorsParams(**dict.fromkeys(SLIPS, False))


@pytest.mark.parametrize("name", ["hallway", "lab"])
@pytest.mark.parametrize(("program", "params"), [("authors", AuthorsParams()), ("authors_repaired", REPAIRED)])
def test_index_ranges_equal_the_program_and_endpoints_lie_within_a_millimetre(printed, name, program, params):
    equal = 0
    for scan, rows in printed(name, program):
        segments, rows = extract(scan, params).segments, sorted(rows, key=lambda row: row[4:])
        if [[s.first, s.last] for s in segments] == [row[4:] for row in rows]:
            equal += 1
            for segment, row in zip(segments, rows, strict=True):
                assert np.abs(np.subtract((*segment.start, *segment.end), row[:4])).max() < 1e-3
    assert equal >= 99


def spans(scan, **switched):
    return [(s.first, s.last) for s in extract(scan, PAPER.but(**switched)).segments]


def test_a_line_over_the_whole_scan_lacks_its_last_beam():
    scan = wall_ahead(half_width=9.0)
    assert spans(scan) == [(0, 179)]
    assert spans(scan, ends_early=True) == [(0, 178)]


def test_a_line_that_grows_back_to_the_first_beam_starts_at_the_second():
    scan = wall_ahead(half_width=9.0, bump={2: 0.2, 3: 0.02})
    found = [spans(scan, ends_early=on) for on in (False, True)]
    assert [first for ((first, _),) in [f[-1:] for f in found]] == [3, 3]
    scan = wall_ahead(half_width=9.0, bump={0: 0.028})
    assert spans(scan) == [(0, 179)]


def test_a_line_needs_p_min_plus_two_points():
    scan = scan_of([(1.0, -0.5, 1.0, 0.5)], beams=60, field_of_view=2.0)
    points = int(scan.valid.sum())
    assert len(spans(scan, min_points=points)) == 1
    assert spans(scan, min_points=points, two_more_points=True) == []
    assert len(spans(scan, min_points=points - 2, two_more_points=True)) == 1


def test_a_lost_beam_ends_a_line_that_takes_dropouts_for_points():
    scan = wall_ahead(half_width=9.0, lost=[90])
    assert spans(scan) == [(0, 179)]
    assert spans(scan, every_beam=True) == [(0, 89), (91, 179)]


def test_a_wall_straight_ahead_is_upright_and_one_across_becomes_so_in_slope_form():
    beside = scan_of([(-1.5, 2.0, 1.5, 2.0)], beams=181, field_of_view=np.pi * 1.2)
    (segment,) = extract(beside, PAPER).segments
    assert abs(segment.line[1]) == pytest.approx(1.0)


def test_the_trace_ends_with_the_lines_of_the_result():
    scan = corner(noise=0.01)
    traced = trace(scan, AuthorsParams())
    assert traced.extraction.segments == extract(scan, AuthorsParams()).segments
    last = sorted((line.first, line.last) for line in traced.lines_at(len(traced) - 1))
    assert last == [(s.first, s.last) for s in traced.extraction.segments]
    assert traced[int(traced.jump("seed")[0])].text.startswith("seed found: beams ")


def test_an_erased_line_saves_the_one_behind_it():
    kinds = {kind.name for kind in trace(corner(), AuthorsParams()).vocabulary.kinds}
    assert {"line erased", "line passed over"} <= kinds


@settings(max_examples=40)
@given(scan=scans(full_circle=False))
def test_without_its_departures_it_is_region_growing(scan):
    """But for a start one beam earlier at the end, the length of a line, and lines that lose points when cut."""
    found = {(s.first, s.last) for s in extract(scan, PAPER).segments}
    paper = Params(
        max_dropout=10_000, max_gap=1000.0, merge_rms=0.0, max_occluder=0.0, max_void=0.0, epsilon_growth=0.0
    )
    other = {(s.first, s.last) for s in extract(scan, paper).segments}
    assert len(found ^ other) <= 2
