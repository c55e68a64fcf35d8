"""Auto-tuning: real studies on disk, tested on held-back frames."""

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main

from lineseg import Params, Recording, Scan, agreement, extract, open_recording, read_params
from lineseg.readers import save_npz
from lineseg.simulate import RPLIDAR_A2, Laser
from lineseg.simulate.worlds import WORLDS
from lineseg.sweep import Batch, Totals, pool
from lineseg.sweep.workers import Pool
from lineseg.truth import Agreement
from lineseg.tuning import FileBlocks, Objective, RecordingBlocks, Tuning, judge_of

SAMPLES = Path(__file__).parents[2] / "sample_scans"


@pytest.fixture(scope="module")
def hallway() -> Recording:
    return open_recording(SAMPLES / "hallway.npz").only(np.arange(80))


@pytest.fixture
def workers() -> Iterator[Pool]:
    with pool() as workers:
        yield workers


def totals_of(recording: Recording, params: Params, judge: Params | None = None) -> Totals:
    return Totals(Batch(recording, scored=False, judge=judge).measure([params]).sums[0])


def simulated(name: str, sigma: float, laser: Laser) -> Recording:
    return replace(WORLDS[name], laser=replace(laser, sigma=sigma, sigma_far=1.5 * sigma)).recording(name)


def score_of(recording: Recording, params: Params) -> float:
    return Objective().score(totals_of(recording, params))


def test_the_objective_with_truth_is_the_f_score(hallway: Recording):
    totals = totals_of(hallway, Params())
    assert Objective("truth").score(totals) == pytest.approx(float(totals.measure("f_score")))
    true, false = float(totals.measure("true_rate")), float(totals.measure("false_rate"))
    plain = Objective("truth", completeness=0).score(totals)
    assert plain == pytest.approx(2 / (1 / true + 1 / (1 - false)))
    assert Objective("truth", completeness=0, recall=1000).score(totals) == pytest.approx(true, abs=1e-4)


def test_no_segment_scores_nothing_and_no_truth_has_no_score(hallway: Recording):
    none = totals_of(hallway, Params(min_length=900))
    assert Objective("truth").score(none) == 0.0
    blind = totals_of(replace(hallway, wall=None), Params())
    assert math.isnan(Objective("truth").score(blind))


def test_tuning_from_bad_thresholds_finds_better_ones_and_says_what_it_gained(hallway: Recording, workers: Pool):
    noisy = hallway.ranges + np.random.default_rng(0).normal(0, 0.03, len(hallway.ranges))
    blocks = RecordingBlocks(replace(hallway, ranges=noisy.astype(np.float32)), workers, blind=False)
    tuning = Tuning(blocks, Objective("truth"))
    for _ in tuning.run(40):
        pass
    verdict = tuning.verdict()
    assert verdict.gained
    assert verdict.text.startswith("Gain +")
    assert verdict.params.epsilon > 0.03
    assert [gain.frames for gain in verdict.gains] == [40]
    importance = tuning.importance()
    assert set(importance) == set(Objective("truth").thresholds)
    assert sum(importance.values()) == pytest.approx(1)


def test_the_verdict_says_if_nothing_was_gained(hallway: Recording, workers: Pool):
    tuning = Tuning(RecordingBlocks(hallway, workers, blind=False), Objective("truth"))
    for _ in tuning.run(1):
        pass
    verdict = tuning.verdict()
    assert (verdict.params, verdict.gains[0].value) == (Params(), 0.0)
    assert verdict.text.startswith("No gain")


def test_a_verdict_compares_with_the_present_thresholds_and_with_the_papers(hallway: Recording, workers: Pool):
    present = Params(epsilon=0.008)
    tuning = Tuning(RecordingBlocks(hallway, workers, blind=False), Objective("truth"), base=present)
    for _ in tuning.run(2):
        pass
    verdict = tuning.verdict()
    over_present, over_paper = verdict.gains
    assert (verdict.params, over_paper.value) == (Params(), 0.0)
    assert verdict.gained
    assert over_present.higher == over_present.stretches == 10
    assert "for the present thresholds on 40 held-back frames, higher in 10 of 10 stretches" in verdict.text


def test_without_truth_a_coarse_laser_gains_as_it_does_with_truth(workers: Pool):
    recording = simulated("flat", 0.05, RPLIDAR_A2).only(np.arange(0, 120, 2))
    blind = Tuning(RecordingBlocks(replace(recording, wall=None), workers, blind=True), Objective("label-free"))
    known = Tuning(RecordingBlocks(recording, workers, blind=False), Objective("truth"))
    for _ in zip(blind.run(25), known.run(25), strict=True):
        pass
    assert blind.verdict().gained
    found = blind.best().params
    assert found.epsilon > 0.08
    assert score_of(recording, found) > 0.95 * score_of(recording, known.best().params)


def test_on_real_walls_tuning_without_truth_finds_the_gain(data_dir: Path, workers: Pool):
    room = data_dir.parent / "truth" / "lroom_b.npz"
    if not room.exists():
        pytest.skip(f"{room} does not exist")
    recording = open_recording(room).only(np.arange(0, 188, 3))
    tuning = Tuning(RecordingBlocks(recording, workers, blind=True), Objective("label-free"))
    for _ in tuning.run(25):
        pass
    assert tuning.verdict().gained
    assert score_of(recording, tuning.best().params) > 0.9


def test_random_settings_have_the_same_order_without_truth_as_with_it():
    recording = open_recording(SAMPLES / "hallway.npz").only(np.arange(0, 300, 15))
    rng = np.random.default_rng(6)
    limits = np.exp(rng.uniform(np.log([0.005, 0.01]), np.log([0.5, 1.0]), (120, 2))).tolist()
    settings = [Params(epsilon, delta, int(rng.integers(3, 21))) for epsilon, delta in limits]
    with_truth, without = (
        [Objective().score(Totals(sums)) for sums in Batch(recording, False, judge=judge).measure(settings).sums]
        for judge in (None, judge_of(recording))
    )
    order = np.sign(np.subtract(with_truth[::2], with_truth[1::2])), np.sign(np.subtract(without[::2], without[1::2]))
    assert np.mean(order[0] == order[1]) > 0.9


def test_scores_without_truth_are_those_against_the_lines_of_the_judge(hallway: Recording):
    recording = hallway.only(np.arange(6))
    judge = Params(epsilon=0.05)
    totals = totals_of(recording, Params(), judge)
    expected = Agreement.of_all(agreement(extract(scan), extract(scan, judge).labels) for scan in recording)
    for name in ("true_rate", "false_rate", "completeness"):
        assert float(totals.measure(name)) == pytest.approx(getattr(expected, name))


def test_a_recording_without_walls_cannot_be_judged_without_truth():
    nothing = [Scan.regular(np.full(60, np.inf), 0.0, 0.01)] * 6
    with pytest.raises(
        ValueError, match=r"blank cannot be judged without truth. Proposing thresholds needs at least 4 scans"
    ):
        judge_of(Recording.from_scans(nothing, "blank"))


def test_training_and_held_back_frames_are_disjoint_and_together_complete(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    assert set(blocks.train) & set(blocks.held_back) == set()
    parts = blocks.totals(Params(), sorted([*blocks.train, *blocks.held_back]))
    np.testing.assert_allclose(np.sum([part.sums for part in parts], axis=0), totals_of(hallway, Params()).sums)


def test_a_study_on_disk_continues_where_it_stopped(hallway: Recording, workers: Pool, tmp_path: Path):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    file = tmp_path / "study.db"
    first = list(Tuning(blocks, Objective("truth"), file).run(5))
    assert first[0].params == Params()
    again = Tuning(blocks, Objective("truth"), file)
    assert [trial.params for trial in again.trials()] == [trial.params for trial in first]
    assert [trial.number for trial in again.run(2)] == [5, 6]
    assert again.best() == max(again.trials(), key=lambda trial: trial.score)


def test_earlier_trials_are_recalled_and_the_search_goes_on_from_them(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    first = list(Tuning(blocks, Objective("truth")).run(12))
    again = Tuning(blocks, Objective("truth"))
    again.recall(first)
    assert again.trials() == first
    assert again.step().number == 12


def test_a_seed_never_has_more_points_than_a_line_needs(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    for thresholds in (["seed_points", "min_points"], ["seed_points"]):
        tuning = Tuning(blocks, Objective("truth"), None, thresholds, Params(min_points=5))
        trials = list(tuning.run(15))
        assert all(trial.params.seed_points <= trial.params.min_points for trial in trials)
        assert tuning.trials() == trials


def test_a_present_value_beyond_its_slider_is_tried_too(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    trials = list(Tuning(blocks, Objective("truth"), None, ["epsilon"], Params(epsilon=0.9)).run(2))
    assert [trial.params.epsilon for trial in trials] == [Params().epsilon, 0.9]


def test_a_study_of_something_else_is_refused_and_left_unchanged(hallway: Recording, workers: Pool, tmp_path: Path):
    blocks = RecordingBlocks(hallway, workers, blind=False)
    blind = RecordingBlocks(hallway, workers, blind=True)
    file = tmp_path / "study.db"
    list(Tuning(blocks, Objective("truth"), file).run(2))
    with pytest.raises(ValueError, match=r"study.db: this is a study of another objective: truth .*, not label-free"):
        Tuning(blind, Objective("label-free"), file)
    with pytest.raises(ValueError, match="a study of another set of thresholds"):
        Tuning(blocks, Objective("truth"), file, ["epsilon"])
    other = RecordingBlocks(replace(hallway, name="other"), workers, blind=False)
    with pytest.raises(ValueError, match=r"a study of another recording: hallway.*, not other"):
        Tuning(other, Objective("truth"), file)
    assert len(Tuning(blocks, Objective("truth"), file).trials()) == 2
    (tmp_path / "notes.db").write_text("no database, but a text that is longer than a header" * 20)
    with pytest.raises(ValueError, match=r"notes.db: the study cannot be kept there"):
        Tuning(blocks, Objective("truth"), tmp_path / "notes.db")


def test_trials_without_a_score_lose_nothing(hallway: Recording, workers: Pool):
    nowhere = replace(hallway, wall=np.full(len(hallway.ranges), -1))
    tuning = Tuning(RecordingBlocks(nowhere, workers, blind=False), Objective("truth"))
    assert all(math.isnan(trial.score) for trial in tuning.run(3))
    assert len(tuning.trials()) == 3
    with pytest.raises(ValueError, match="no trial has a score, because these frames have no true line"):
        tuning.verdict()
    assert tuning.importance() == {}


def test_missing_truth_cannot_be_the_objective(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(replace(hallway, wall=None), workers, blind=True)
    with pytest.raises(ValueError, match="has no truth; tune it with the label-free objective"):
        Tuning(blocks, Objective("truth"))
    with pytest.raises(ValueError, match="compared with the truth; make them blind"):
        Tuning(RecordingBlocks(hallway, workers, blind=False), Objective("label-free"))
    assert "cannot know which lines you want" in Objective("label-free").caution


def test_the_command_line_tunes_files_and_continues_a_study(hallway: Recording, tmp_path: Path, capsys, monkeypatch):
    for name, frames in [("one", range(40)), ("two", range(40, 80))]:
        save_npz(hallway.only(np.array(frames)), tmp_path / f"{name}.npz")
    files = [str(tmp_path / "one.npz"), str(tmp_path / "two.npz")]
    study = ["--study", str(tmp_path / "study.db"), "--split", "files"]
    assert main(["tune", *files, *study, "--trials", "3", "--to", "flags"]) == 0
    out, err = capsys.readouterr()
    assert read_params(out).epsilon > 0
    assert "Maximises the harmonic mean of TR and 1 − FR" in err
    assert "on 40 held-back frames" in err
    assert main(["tune", *files, *study, "--trials", "2", "-o", str(tmp_path / "found.yaml")]) == 0
    assert "least_thresh" in (tmp_path / "found.yaml").read_text()
    assert main(["tune", *files, *study, "--objective", "label-free"]) == 2
    assert "a study of another objective" in capsys.readouterr().err
    assert main(["tune", files[0], "--split", "files"]) == 2
    assert "split by frames instead" in capsys.readouterr().err


@pytest.mark.parametrize("blind", [False, True])
def test_files_and_memory_hold_the_same_blocks(blind: bool, hallway: Recording, workers: Pool, tmp_path: Path):
    save_npz(hallway, tmp_path / "mine.npz")
    files = FileBlocks([tmp_path / "mine.npz"], workers, blind=blind)
    memory = RecordingBlocks(hallway, workers, blind=blind)
    assert list(files.frames) == list(memory.frames)
    for one, other in zip(
        files.totals(Params(), files.held_back), memory.totals(Params(), memory.held_back), strict=True
    ):
        np.testing.assert_array_equal(one.sums, other.sums)


def test_a_jackknife_needs_more_than_one_block(hallway: Recording, workers: Pool):
    blocks = RecordingBlocks(hallway.only(np.arange(4)), workers, blind=False)
    tuning = Tuning(blocks, Objective("truth"))
    tuning.step()
    verdict = tuning.verdict()
    assert verdict.gains[0].error == math.inf
    assert not verdict.gained
    with pytest.raises(ValueError, match="4 or more frames"):
        RecordingBlocks(hallway.only(np.arange(3)), workers, blind=False)
