"""Surveys with other methods: the segments of `extract`, and the scores of region growing."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from scenes import corner, room, wall_ahead

from lineseg import EXTRACTORS, SCORES, Cancelled, Params, Recording, extract, survey
from lineseg.survey.frame_by_frame import survey_stretch
from lineseg.survey.stretch import Workspace

OTHERS = [method for name, method in EXTRACTORS.items() if name != "region-growing"]


def rows(found):
    return [(*s.line, *s.start, *s.end, s.length, s.first, s.last, s.points) for s in found]


@pytest.mark.parametrize("method", OTHERS, ids=lambda method: method.name)
def test_its_segments_are_those_of_single_frames(method):
    recording = Recording.from_scans(
        [corner(noise=0.005, beams=300), room(noise=0.005), wall_ahead(lost=range(40, 60), noise=0.005)]
    )
    params = method.params_type()
    found = survey(recording, params, threads=1)
    for frame, scan in enumerate(recording):
        assert [
            tuple(each[name] for name in ("a", "b", "c", "x1", "y1", "x2", "y2", "length", "first", "last", "points"))
            for each in found[frame]
        ] == rows(extract(scan, params).segments)
    assert list(found.score("segments")) == [len(extract(scan, params).segments) for scan in recording]
    covered = [extract(scan, params).covered / np.count_nonzero(scan.valid) for scan in recording]
    assert found.score("coverage") == pytest.approx(covered)
    assert np.isfinite(found.scores[:, : list(SCORES).index("change") + 1]).all()


def test_the_segments_of_region_growing_are_scored_as_in_its_own_survey():
    scans = [corner(noise=0.01, seed=seed, beams=300) for seed in range(3)] + [
        room(noise=0.01, seed=seed) for seed in range(3)
    ]
    recording = Recording.from_scans(scans)
    own = survey(recording)
    memory = Workspace(recording.beams[1])
    counts, scores = np.zeros(6, np.int64), np.full((6, len(SCORES)), np.nan, np.float32)
    found = survey_stretch(recording, 0, 6, Params(), memory, np.zeros(1, np.bool_), counts, scores)
    assert (found == own.segments).all()
    judged = np.isfinite(scores)
    assert judged.any(axis=0).sum() >= 9
    assert scores[judged] == pytest.approx(own.scores[judged], abs=1e-6)


def test_it_stops_when_it_is_told_to():
    recording = Recording.from_scans([room()] * 20_000)
    stop = np.zeros(1, np.bool_)
    method = EXTRACTORS["expectation-maximisation"]
    timer = threading.Timer(0.05, stop.__setitem__, (0, True))
    timer.start()
    with pytest.raises(Cancelled):
        survey(recording, method.params_type(iterations=40), stop)
    timer.join()
