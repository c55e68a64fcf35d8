"""The difference of two results."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lineseg import Params, Recording, Scan, extract, survey
from lineseg.segment import Extraction, Segment
from lineseg.survey.difference import FATES, GAINED, KEPT, LOST, MERGED, SPLIT, difference, differences

BEAMS = 100


def result(*spans: tuple[int, int], beams: int = BEAMS) -> Extraction:
    """An extraction of lines from a first to a last beam; if the last is smaller, the line crosses the seam."""
    nowhere = ((1.0, 0.0, -1.0), (0.0, 0.0), (0.0, 0.0))
    lines = tuple(Segment(*nowhere, first, last, (last - first) % beams + 1, 1.0, 0.0) for first, last in spans)
    return Extraction("", None, lines, np.zeros(beams, np.int32), ())


def fates(a: Extraction, b: Extraction) -> tuple[list[int], list[int]]:
    found = difference(a, b)
    return found.fates_a.tolist(), found.fates_b.tolist()


def test_a_line_that_moves_a_little_is_kept_and_one_that_goes_is_lost():
    assert fates(result((0, 19), (40, 59)), result((2, 21), (80, 99))) == ([KEPT, LOST], [KEPT, GAINED])


def test_lines_that_share_exactly_half_of_their_union_differ():
    assert fates(result((0, 29)), result((0, 14))) == ([LOST], [GAINED])
    assert fates(result((0, 29)), result((0, 15))) == ([KEPT], [KEPT])


def test_two_lines_on_one_are_a_split_and_the_reverse_is_a_merge():
    whole, parts = result((10, 49)), result((10, 36), (38, 49))
    assert fates(whole, parts) == ([SPLIT], [SPLIT, SPLIT])
    assert fates(parts, whole) == ([MERGED, MERGED], [MERGED])
    assert difference(whole, parts).counts == dict(zip(FATES, (0, 0, 0, 1, 0), strict=True))
    assert difference(parts, whole).counts == dict(zip(FATES, (0, 0, 0, 0, 1), strict=True))


def test_a_line_across_the_seam_meets_those_on_both_sides():
    assert fates(result((90, 9)), result((90, 99), (0, 9))) == ([SPLIT], [SPLIT, SPLIT])
    assert fates(result((95, 4)), result((96, 5))) == ([KEPT], [KEPT])


spans = st.lists(st.integers(0, BEAMS - 1), max_size=8, unique=True).map(
    lambda ends: [(a, b) for a, b in zip(sorted(ends)[::2], sorted(ends)[1::2], strict=False)]
)


@given(spans, spans, st.integers(0, BEAMS - 1))
def test_it_is_symmetric_and_has_no_first_beam(one, other, turn):
    forth, back = fates(result(*one), result(*other)), fates(result(*other), result(*one))
    mirrored = {KEPT: KEPT, LOST: GAINED, GAINED: LOST, SPLIT: MERGED, MERGED: SPLIT}
    # A line may be a part of one and the whole of others; which is named then depends on the side.
    if {SPLIT, MERGED}.isdisjoint(forth[0] + forth[1]):
        assert ([mirrored[fate] for fate in forth[0]], [mirrored[fate] for fate in forth[1]]) == (back[1], back[0])
    turned = [[((first + turn) % BEAMS, (last + turn) % BEAMS) for first, last in each] for each in (one, other)]
    assert fates(result(*turned[0]), result(*turned[1])) == forth


@given(spans)
def test_nothing_differs_from_itself(one):
    assert fates(result(*one), result(*one)) == ([KEPT] * len(one), [KEPT] * len(one))


@pytest.mark.parametrize("circle", [False, True])
def test_every_frame_of_a_recording_has_the_counts_of_its_own_difference(circle):
    rng = np.random.default_rng(5)
    bearings = np.linspace(-np.pi, np.pi, 361)[:-1] if circle else np.linspace(-2.0, 2.0, 361)
    room = 2.0 / np.maximum(np.abs(np.cos(bearings)), np.abs(np.sin(bearings)))
    scans = [Scan(room + 0.02 * rng.standard_normal(len(room)), bearings) for _ in range(40)]
    recording = Recording.from_scans(scans)
    tight, loose = Params(epsilon=0.03), Params(epsilon=0.06)
    counts = differences(survey(recording, tight), survey(recording, loose), recording)
    for row, scan in zip(counts.tolist(), recording, strict=True):
        assert dict(zip(FATES, row, strict=True)) == difference(extract(scan, tight), extract(scan, loose)).counts
    assert (counts.sum(axis=0)[[LOST, GAINED, MERGED]] > 0).all()


def test_surveys_of_another_recording_are_refused():
    recording = Recording.from_scans([Scan.regular(np.full(30, 2.0), -0.1, 0.007)] * 3)
    with pytest.raises(ValueError, match="the surveys have 3 and 2 frames, the recording 3"):
        differences(survey(recording), survey(Recording.from_scans(list(recording)[:2])), recording)
