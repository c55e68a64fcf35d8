"""Sums over frames equal the library's numbers for each frame."""

import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import corner, room, scan_of

from lineseg import Agreement, Cancelled, Params, Recording, Scan, agreements, open_recording, survey, true_lines
from lineseg.sweep import MEASURES, Batch, Grid, Totals, axis_values
from lineseg.sweep.totals import MEANS
from lineseg.truth import UNKNOWN

SAMPLES = Path(__file__).parents[2] / "sample_scans"


@pytest.fixture(scope="module", params=["hallway", "laboratory"])
def sample(request) -> Recording:
    return open_recording(SAMPLES / f"{request.param}.npz").only(np.arange(0, 60))


def test_every_measure_is_computed_from_the_frames(sample: Recording):
    chosen = Params(epsilon=0.022, seed_points=5)
    totals = Batch(sample, scored=True).measure([Params(), chosen])
    truth = [true_lines(scan) for scan in sample]
    for k, params in enumerate((Params(), chosen)):
        found = Agreement.of_all(filter(None, agreements(sample, params, truth=lambda frame: truth[frame])))
        scores = survey(sample, params)
        assert totals.measure("true_rate")[k] == found.true_rate
        assert totals.measure("false_rate")[k] == found.false_rate
        assert totals.measure("completeness")[k] == pytest.approx(found.completeness)
        harmonic = 2 / (1 / found.true_rate + 1 / (1 - found.false_rate))
        assert totals.measure("f_score")[k] == pytest.approx(harmonic * found.completeness)
        valid = np.array([scan.valid.sum() for scan in sample])
        assert totals.measure("coverage")[k] == pytest.approx(np.average(scores.score("coverage"), weights=valid))
        assert totals.measure("segments")[k] == len(scores.segments) / len(sample)
        for name in MEANS:
            assert totals.measure(name)[k] == pytest.approx(scores.score(name).mean(dtype=float)), name


def test_unknown_beams_are_left_out_as_in_the_agreement():
    sample = open_recording(SAMPLES / "hallway.npz").only(np.arange(0, 20))
    assert sample.wall is not None
    sample = replace(sample, wall=np.where(sample.wall % 3 == 0, UNKNOWN, sample.wall))
    totals = Batch(sample, scored=False).measure([Params()])
    found = Agreement.of_all(filter(None, agreements(sample, truth=lambda frame: true_lines(sample[frame]))))
    assert totals.measure("true_rate")[0] == found.true_rate
    assert totals.measure("false_rate")[0] == pytest.approx(found.false_rate, abs=0.02)
    assert totals.measure("completeness")[0] == pytest.approx(found.completeness, abs=0.005)


def test_parts_add_up_to_the_whole(sample: Recording):
    params = [Params(), Params(delta=0.05)]
    whole = Batch(sample, scored=True).measure(params)
    first = Batch(sample.only(np.arange(0, 23)), scored=True).measure(params)
    rest = Batch(sample.only(np.arange(22, 60)), scored=True, lead=True).measure(params)
    np.testing.assert_allclose((first + rest).sums, whole.sums, rtol=1e-12)


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(0, 200))
def test_a_full_circle_may_be_turned(seed: int, turn: int):
    """Lines and segments that cross the seam are matched like others."""
    circle = room(beams=200, noise=0.01, seed=seed)
    wall = np.argmax(np.abs(circle.xy / (3.3, 2.2)), axis=1) * 2 + (circle.xy.sum(axis=1) > 0)
    marked = Scan(circle.ranges, circle.bearings, wall=wall)
    turned = Scan(np.roll(circle.ranges, turn), circle.bearings, wall=np.roll(wall, turn))
    one, other = (Batch(Recording.from_scans([scan]), False).measure([Params()]) for scan in (marked, turned))
    assert one.measure("f_score") == pytest.approx(other.measure("f_score"))
    assert one.column("true_lines") >= 4


def test_the_truth_stays_what_it_is_when_p_min_and_l_min_change(sample: Recording):
    """Otherwise the largest L_min, which keeps only the easiest true lines, would be the best."""
    found = Batch(sample, scored=False).measure([Params(min_length=length) for length in (0.3, 0.6, 3.0)])
    assert len(set(found.column("true_lines"))) == 1
    assert found.measure("true_rate")[2] < found.measure("true_rate")[1]


def test_without_truth_and_without_segments_there_is_no_rate():
    empty = scan_of([(2.0, -0.1, 2.0, 0.1)], lost=range(180))
    totals = Batch(Recording.from_scans([empty, corner()]), scored=False).measure([Params(), Params(min_length=900)])
    assert not totals.has_truth
    for name, measure in MEASURES.items():
        if measure.truth:
            assert np.isnan(totals.measure(name)).all(), name
    assert totals.measure("segments").tolist() == [1.0, 0.0]
    assert np.isnan(Totals(np.zeros((1, totals.sums.shape[1]))).measure("coverage"))


def test_a_measurement_can_be_stopped(sample: Recording):
    stop = np.ones(1, np.bool_)
    with pytest.raises(Cancelled):
        Batch(sample, scored=False).measure([Params()], stop)


def test_several_threads_may_measure_one_batch(sample: Recording):
    batch = Batch(sample, scored=True)
    params = list(Grid(Params(), {"epsilon": axis_values("0.02:0.05:4", "epsilon")}))
    alone = batch.measure(params).sums
    found: list[np.ndarray] = []
    threads = [threading.Thread(target=lambda: found.append(batch.measure(params).sums)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for sums in found:
        np.testing.assert_array_equal(sums, alone)
