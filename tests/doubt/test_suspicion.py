"""The ranking puts failures first: it finds planted failures in recordings that also have their own."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from planted import FAILING, PLANTS, planted
from scenes import room

from lineseg import Recording, Scan, agreements, extract, open_recording, survey, with_disputes
from lineseg.doubt import SCORES
from lineseg.doubt.suspicion import MOST_DOUBT, doubts, suspicion, worst_first
from lineseg.simulate.laser import TIM_561, UTM_30LX
from lineseg.simulate.worlds import WORLDS
from lineseg.truth import agreement, true_lines

SAMPLES = Path(__file__).parents[2] / "sample_scans"
NAMES = list(SCORES)


def column(name, values):
    """Scores of frames that differ in one of them only."""
    scores = np.zeros((len(values), len(SCORES)))
    scores[:, NAMES.index(name)] = values
    return scores


@cache
def fails_by_itself(file):
    """(frames,) whether a true line is missed in each frame."""
    found = (agreement(extract(scan, FAILING), true_lines(scan)) for scan in open_recording(file))
    return np.array([each.matches < each.true_lines for each in found])


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("name, found_least", [("hallway", 9), ("laboratory", 7)])
def test_nine_of_ten_planted_failures_are_among_the_fifteen_worst(name, found_least, seed):
    """The weights were chosen on the seeds 100 to 111; `benchmarks/suspicion.py` says how many are found on average.

    Frames that fail on their own, a third of each recording, are not counted among the fifteen: they rightly rank high.
    No wall of the laboratory is seen at an angle small enough for a line to bridge an open door.
    """
    file = SAMPLES / f"{name}.npz"
    recording, where = planted(open_recording(file), seed)
    unplantable = {"bridged_door"} if name == "laboratory" else set()
    assert set(where.values()) == {plant.__name__ for plant in PLANTS} - unplantable
    own = fails_by_itself(file)
    ranked = worst_first(with_disputes(recording, survey(recording, FAILING)).scores).tolist()
    worst = [frame for frame in ranked if frame in where or not own[frame]][:15]
    found = {where[frame] for frame in worst if frame in where}
    assert len(found) >= found_least, set(where.values()) - found


@pytest.mark.parametrize("seed", [60, 61])
def test_suspicion_follows_the_truth(seed):
    """In rooms that nobody tuned to, with a laser for which the default ε is too small, and one for which it fits."""
    for name, laser, least in (("flat", TIM_561, 0.6), ("corridor", UTM_30LX, 0.35)):
        recording = replace(WORLDS[name], laser=laser, seed=seed).recording(name, 60)
        rank = suspicion(with_disputes(recording, survey(recording)).scores)
        assert correlation(rank, faults(recording)) >= least, name


def faults(recording):
    """(frames,) lines missed or false by the truth."""
    found = list(agreements(recording))
    return np.array([each.true_lines + each.segments - 2 * each.matches for each in found])


def correlation(one, other):
    """Spearman's rank correlation."""
    return np.corrcoef(ranks(one), ranks(other))[0, 1]


def ranks(values):
    """Ranks, equal values at the mean of theirs."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(counts) - (counts - 1) / 2)[inverse]


def test_a_frame_without_lines_before_walls_is_the_most_suspicious():
    scans = [room(noise=0.005, seed=seed) for seed in range(12)]
    rough = np.random.default_rng(1).normal(0, 0.1, len(scans[5]))
    scans[5] = Scan(scans[5].ranges + rough, scans[5].bearings)
    recording = Recording.from_scans(scans)
    scores = with_disputes(recording, survey(recording)).scores
    assert worst_first(scores)[0] == 5


def test_only_a_frame_that_stands_out_to_the_bad_side_is_doubtful():
    values = np.full(100, 0.8)
    values[30], values[60] = 0.2, 1.0
    doubt = doubts(column("coverage", values))[:, NAMES.index("coverage")]
    assert doubt[30] == MOST_DOUBT
    assert np.count_nonzero(doubt) == 1


def test_less_than_the_smallest_difference_that_matters_is_no_doubt():
    values = np.zeros(100)
    values[30], values[60] = 0.9 * SCORES["jump"].least, 2 * SCORES["jump"].least
    assert np.flatnonzero(doubts(column("jump", values))[:, NAMES.index("jump")]).tolist() == [60]


def test_disputed_lines_are_their_own_doubt_even_if_every_frame_has_them():
    assert suspicion(column("disputed", [7.0, 7.0, 9.0])).tolist() == [7.0, 7.0, 9.0]


def test_the_spread_is_that_of_the_worst_tenth_with_a_minimum():
    values = np.zeros(101)
    values[50] = 2.2
    assert doubts(column("jump", values))[50, NAMES.index("jump")] == pytest.approx(1.2)
    values = np.tile(np.arange(11.0), 10)
    doubt = doubts(column("jump", values))[:, NAMES.index("jump")]
    assert doubt.max() == pytest.approx((5 - 1) / (4 / 1.2816), rel=0.05)


def test_a_lasting_fault_counts_half():
    values = np.zeros(400)
    values[100:130] = 100.0
    doubt = doubts(column("jump", values))[:, NAMES.index("jump")]
    assert doubt[115] == pytest.approx(MOST_DOUBT / 2)


def test_unknown_scores_count_for_nothing():
    scores = column("jolt", np.arange(20.0))
    unknown = scores.copy()
    unknown[:, [NAMES.index(name) for name in ("unstable", "disputed", "lapsed", "blank")]] = np.nan
    assert suspicion(unknown).tolist() == suspicion(scores).tolist()


def test_a_jolt_counts_by_how_much_it_exceeds_the_usual_turns():
    knocked = np.zeros(30)
    knocked[12] = 0.4
    assert suspicion(column("jolt", knocked) + column("turn", np.full(30, 0.05)))[12] > 10
    assert suspicion(column("jolt", knocked) + column("turn", np.full(30, 0.45)))[12] == 0


def test_weights_choose_what_counts():
    scores = column("gap", [0, 0, 5, 0]) + column("jump", [0, 9, 0, 0])
    assert worst_first(scores, {"gap": 1.0})[0] == 2
    assert worst_first(scores, {"jump": 1.0})[0] == 1
    assert suspicion(scores, {}).tolist() == [0, 0, 0, 0]
    assert worst_first(scores, {}).tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("weights", [{"gap": -1.0}, {"gap": np.nan}, {"misery": 1.0}])
def test_other_weights_are_refused(weights):
    with pytest.raises(ValueError, match=r"a weight must be a number|there is no score 'misery'"):
        suspicion(column("gap", [0, 1]), weights)


@given(arrays(np.float64, st.tuples(st.integers(0, 30), st.just(len(SCORES))), elements=st.floats(0, 100)), st.data())
def test_the_rank_is_bounded_and_follows_the_frames(scores, data):
    rank = suspicion(scores)
    assert (rank >= 0).all()
    counts = [score.counts for score in SCORES.values()]
    assert (doubts(scores)[:, np.logical_not(counts)] <= MOST_DOUBT).all()
    assert sorted(worst_first(scores).tolist()) == list(range(len(scores)))
    assert suspicion(scores[::-1]) == pytest.approx(rank[::-1])
