"""Stability equals the result of two runs of `extract` with a moved threshold."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from scenes import room, scans, wall_ahead

from lineseg import Cancelled, Params, Recording, extract, open_recording, survey
from lineseg.doubt import SCORES
from lineseg.survey.stability import changes, variations, with_stability

SAMPLES = Path(__file__).parents[2] / "sample_scans"


def spans(segments, beams):
    return [set((s.first + np.arange((s.last - s.first) % beams + 1)) % beams) for s in segments]


def come_or_go(scan, params, moved):
    """Literally: the segments of each run that have no counterpart in the other."""
    one, other = (spans(extract(scan, each).segments, len(scan)) for each in (params, moved))
    same = sum(2 * len(a & b) > len(a | b) for a in one for b in other)
    return len(one) + len(other) - 2 * same


@settings(max_examples=20)
@given(scans())
def test_the_count_is_that_of_two_runs(scan):
    recording = Recording.from_scans([scan, room(noise=0.01), scan])
    for name, params, count in changes(recording, survey(recording, scores=False)):
        expected = [come_or_go(each, Params(), params) for each in recording]
        assert count.tolist() == expected, name


def test_every_threshold_is_moved_either_way_where_it_may_be():
    moved = [(name, getattr(params, name)) for name, params in variations(Params(max_dropout=0, min_points=40))]
    assert ("epsilon", pytest.approx(0.0285)) in moved
    assert ("epsilon", pytest.approx(0.0315)) in moved
    assert ("max_dropout", 1) in moved
    assert ("max_dropout", -1) not in moved
    assert [value for name, value in moved if name == "min_points"] == [38, 42]
    assert ("min_length", 0.0) not in [(n, getattr(p, n)) for n, p in variations(Params(min_length=0.0))]


def test_a_line_that_is_barely_long_enough_is_unstable():
    recording = Recording.from_scans([wall_ahead(half_width=0.31), wall_ahead()])
    scores = with_stability(recording, survey(recording))
    assert scores.score("unstable").tolist() == [1, 0]


def test_the_other_scores_stay_what_they_are():
    recording = open_recording(SAMPLES / "hallway.npz")
    base, seen = survey(recording), []
    found = with_stability(recording, base, progress=lambda done, total: seen.append((done, total)))
    others = np.array(list(SCORES)) != "unstable"
    assert np.array_equal(found.scores[:, others], base.scores[:, others], equal_nan=True)
    assert np.isnan(base.score("unstable")).all()
    assert seen[-1] == (2 * len(Params.names()),) * 2


def test_it_can_be_stopped_and_needs_scores():
    recording = Recording.from_scans([wall_ahead()])
    with pytest.raises(Cancelled):
        with_stability(recording, survey(recording), np.ones(1, np.bool_))
    with pytest.raises(ValueError, match="has no scores"):
        with_stability(recording, survey(recording, scores=False))
