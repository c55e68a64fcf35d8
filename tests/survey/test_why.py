"""What looks wrong in a frame is said in words, with its beams."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from planted import FAILING, planted
from scenes import wall_ahead

from lineseg import EXTRACTORS, Recording, Scan, misses, open_recording, survey, why, with_stability
from lineseg.doubt import SCORES

SAMPLES = Path(__file__).parents[2] / "sample_scans"

EXPECTED = {
    "split_wall": {"splits", "gone", "lapsed", "unstable", "misses", "coverage"},
    "missed_wall": {"misses", "gone", "lapsed"},
    "bridged_door": {"gap"},
    "noise_burst": {"coverage"},
    "shifted_sensor": {"jolt"},
    "dropped_sector": {"invalid"},
    "lost_beams": {"invalid"},
    "ghost_wall": {"brief", "gone", "lapsed"},
    "bent_wall": {"misses", "gone", "lapsed", "near"},
    "quantised": {"misses", "coverage"},
}


@pytest.fixture(scope="module")
def case():
    recording, where = planted(open_recording(SAMPLES / "hallway.npz"), seed=1)
    return (
        recording,
        {name: frame for frame, name in where.items()},
        with_stability(recording, survey(recording, FAILING)).scores,
    )


@pytest.mark.parametrize("name", EXPECTED)
def test_a_planted_failure_is_named(case, name):
    recording, where, scores = case
    remarks = why(recording, where[name], FAILING, scores)
    assert {remark.score for remark in remarks} & EXPECTED[name], [remark.text for remark in remarks]
    assert [remark.doubt for remark in remarks] == sorted((remark.doubt for remark in remarks), reverse=True)
    for remark in remarks:
        assert remark.score in SCORES
        assert remark.text
        assert -1 <= min(remark.first, remark.last) <= max(remark.first, remark.last) < 1081


def test_the_most_doubtful_comes_first(case):
    recording, where, scores = case
    assert why(recording, where["shifted_sensor"], FAILING, scores)[0].score == "jolt"
    assert why(recording, where["dropped_sector"], FAILING, scores)[0].score in ("invalid", "lapsed")


def test_a_score_without_a_sentence_of_its_own_is_told_by_label_and_value(case, monkeypatch):
    recording, where, scores = case
    monkeypatch.setattr(sys.modules["lineseg.survey.why"], "WITH_SENTENCE", frozenset(SCORES) - {"invalid"})
    texts = [remark.text for remark in why(recording, where["lost_beams"], FAILING, scores)]
    assert any(re.fullmatch(r"invalid beams: 0\.\d+; nearby frames: 0(\.\d+)?", text) for text in texts), texts


def test_every_probable_miss_is_told_with_its_reason(case):
    recording, where, scores = case
    frame = where["quantised"]
    texts = [remark.text for remark in why(recording, frame, FAILING, scores)]
    assert {miss.text for miss in misses(recording[frame], FAILING)} <= set(texts)


def test_a_wall_cut_in_two_names_both_segments():
    scan = wall_ahead(lost=range(88, 93), noise=0.002)
    (remark,) = (each for each in why(Recording.from_scans([scan]), 0) if each.score == "splits")
    assert remark.text == "segments 0 and 1 are one line, cut in two between beams 87 and 93"
    assert (remark.first, remark.last) == (0, 179)


def test_a_good_frame_has_no_remark():
    recording = Recording.from_scans([wall_ahead(noise=0.002, seed=seed) for seed in range(5)])
    assert why(recording, 2) == ()


def test_a_frame_without_a_return_is_handled():
    blind = Scan(np.full(180, np.nan), wall_ahead().bearings)
    recording = Recording.from_scans([wall_ahead(), wall_ahead(), blind, wall_ahead(), wall_ahead()])
    said = {remark.score: remark.text for remark in why(recording, 2)}
    assert said["invalid"] == "100% of the beams have no return (nearby frames: 0%); the longest run is beams 0–179"
    assert "is missing, beams 1–178 – most of its beams have no return" in said["lapsed"]
    assert why(Recording.from_scans([Scan(np.empty(0), np.empty(0))]), 0) == ()


def test_a_line_that_is_missing_says_what_refused_it():
    rough = Scan(wall_ahead().ranges + np.where(np.arange(180) % 2, 0.05, -0.05), wall_ahead().bearings)
    recording = Recording.from_scans([wall_ahead(), wall_ahead(), rough, wall_ahead(), wall_ahead()])
    (gone,) = (remark.text for remark in why(recording, 2) if remark.score == "lapsed")
    assert "m line of both neighbouring frames is missing, beams" in gone
    assert "seed refused by" in gone


@pytest.mark.parametrize("name", [name for name in EXTRACTORS if name != "region-growing"])
def test_other_methods_have_the_same_scores(case, name):
    recording, where, _ = case
    params = EXTRACTORS[name].params_type()
    said = {remark.score for remark in why(recording, where["dropped_sector"], params)}
    assert said & {"invalid", "gone", "lapsed", "coverage", "change"}


def test_a_frame_that_is_not_there_is_refused():
    with pytest.raises(IndexError, match="frame 5: the recording has the frames 0 to 0"):
        why(Recording.from_scans([wall_ahead()]), 5)
