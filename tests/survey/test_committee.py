"""The committee counts faults as the truth does, and says where it finds other lines."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import room, wall_ahead

from lineseg import Cancelled, Params, Recording, Scan, extract, survey, why, with_disputes
from lineseg.noise import noise
from lineseg.simulate.laser import RPLIDAR_A2
from lineseg.simulate.worlds import WORLDS
from lineseg.survey.committee import committee_of, judges_of
from lineseg.survey.disputes import lines_missed
from lineseg.truth import agreement


@pytest.fixture(scope="module")
def flat():
    return WORLDS["flat"].recording("flat", 12)


def labels_of(rows, wanted, beams, most=np.inf):
    """(beams,) the judge's lines with at least 1 and less than `most` times what is wanted, each from first to last."""
    labels, count = np.full(beams, -1), 0
    for row in rows:
        if 1.0 <= min(row["points"] / wanted.min_points, row["length"] / max(wanted.min_length, 1e-9)) < most:
            span = (row["first"] + np.arange((row["last"] - row["first"]) % beams + 1)) % beams
            labels[span] = count
            count += 1
    return labels


def test_faults_are_those_of_each_judge_as_the_truth(flat):
    params = Params(epsilon=0.02, max_occluder=0.0)
    short = Params(min_points=7, min_length=0.7 * params.min_length)
    found, committee = survey(flat, params), committee_of(flat)
    expected = np.zeros(len(flat))
    for rows, offsets in committee.walls:
        for frame, scan in enumerate(flat):
            walls = rows[offsets[frame] : offsets[frame + 1]]
            truth, near = labels_of(walls, params, len(scan)), labels_of(walls, short, len(scan), most=1 / 0.7)
            matched = agreement(spans_of(found[frame], scan, params), truth, near=near)
            expected[frame] += matched.true_lines + matched.segments - matched.neutral - 2 * matched.matches
    disputed = with_disputes(flat, found).score("disputed")
    # Where lines lie within each other's beams, labels cannot hold both.
    assert np.abs(disputed - expected / 6).max() <= 1.0
    assert np.abs(disputed - expected / 6).mean() <= 0.25


def test_a_segment_on_a_wall_that_just_misses_the_demands_is_neither_missed_nor_false():
    """The walls have 0.5 to 0.6 m. They miss an L_min of 0.6 m by less than 30 %, one of 0.9 m by more."""
    scans = [wall_ahead(half_width=0.275, beams=120, noise=0.003, seed=seed) for seed in range(8)]
    recording = Recording.from_scans(scans)
    lines = [extract(scan, Params(min_length=0.5)).segments for scan in scans]
    assert all(len(each) == 1 and 0.5 <= each[0].length < 0.6 for each in lines)
    found = survey(recording, Params(min_length=0.5))
    slightly_more = replace(found, params=Params(min_length=0.6))
    assert with_disputes(recording, slightly_more).score("disputed").tolist() == [0.0] * 8
    much_more = replace(found, params=Params(min_length=0.9))
    assert with_disputes(recording, much_more).score("disputed").tolist() == [1.0] * 8


def test_a_judge_finds_far_walls_of_a_laser_that_is_noisier_there():
    """Up to 5 m its noise is 8 mm, beyond it 30 mm, and ε follows a law through both."""
    recording = replace(WORLDS["office"], laser=RPLIDAR_A2).recording("office", 40)
    usual, everywhere = judges_of(recording)[-2:]
    assert everywhere.epsilon == usual.epsilon
    seen = noise(recording)
    middles, told = 0.5 * (seen.edges[:-1] + seen.edges[1:]), np.isfinite(seen.sigma)
    needed = 2.69 * seen.sigma[told]
    assert (everywhere.epsilon_at(middles[told]) >= needed).all()
    assert (usual.epsilon_at(middles[told]) < needed).any()


def spans_of(rows, scan, params):
    """The segments as an extraction whose labels fill each of them from its first beam to its last."""
    found = extract(scan, params)
    return replace(found, labels=labels_of(rows, Params(min_points=2, min_length=0.0), len(scan)))


def test_pieces_of_a_wall_beyond_a_post_are_one_line():
    sweeps = [wall_ahead(lost=range(86, 95), noise=0.003, seed=seed) for seed in range(6)]
    recording = Recording.from_scans(sweeps)
    strict = Params(max_occluder=0.0, max_dropout=0)
    assert all(len(survey(recording, strict)[frame]) == 2 for frame in range(6))
    for rows, offsets in committee_of(recording).walls:
        assert np.diff(offsets).tolist() == [1] * 6
        assert (rows["first"] <= 2).all()
        assert (rows["last"] >= 177).all()
    (remark,) = (each for each in why(recording, 3, strict) if each.score == "disputed")
    assert "line at beams" in remark.text
    assert remark.text.endswith("where there are 2 segments")
    assert len(remark.ghosts) == 1


def test_the_committee_is_that_of_the_recording_and_not_of_the_thresholds(flat):
    assert committee_of(flat) is committee_of(flat)
    assert judges_of(flat) == committee_of(flat).judges
    assert [judge.seed_points for judge in judges_of(flat)] == [10, 10, 10, 10, 6, 4]


def test_a_stopped_committee_goes_on_where_it_was():
    recording = WORLDS["flat"].recording("flat", 6)
    flag = np.zeros(1, np.bool_)

    def stop(done: int, total: int) -> None:
        flag[0] = done == 2

    with pytest.raises(Cancelled):
        committee_of(recording, flag, stop)
    assert len(committee_of(recording).walls) == 6


def test_a_frame_without_lines_says_what_is_there():
    scans = [room(noise=0.005, seed=seed) for seed in range(12)]
    scans[5] = Scan(scans[5].ranges + np.random.default_rng(1).normal(0, 0.03, len(scans[5])), scans[5].bearings)
    recording = Recording.from_scans(scans)
    # With such an ε and δ, the noise itself would look like small objects.
    remarks = why(recording, 5, Params(epsilon=0.006, delta=0.01, max_occluder=0.0))
    assert remarks[0].score == "blank"
    assert "m line at beams" in remarks[0].text
    assert remarks[0].text.endswith("where there is none")


@pytest.mark.parametrize("frames", [0, 1, 2])
def test_few_frames_are_judged_near_the_default(frames):
    recording = Recording.from_scans([room(seed=seed) for seed in range(frames)])
    assert judges_of(recording)[1].epsilon == Params().epsilon
    assert with_disputes(recording, survey(recording)).score("disputed").shape == (frames,)


def test_it_needs_scores(flat):
    with pytest.raises(ValueError, match="has no scores"):
        with_disputes(flat, survey(flat, scores=False))


def test_the_lines_missed_are_those_that_why_draws_as_ghosts():
    recording = WORLDS["office"].recording("office", 20)
    ghosts = lines_missed(recording, 8)
    assert ghosts
    assert set(ghosts) == {ghost for each in why(recording, 8) if each.score == "disputed" for ghost in each.ghosts}
    committee_of(recording)
    assert lines_missed(recording, 8) == ghosts
