"""The comparison of methods: fair, reproducible, written in three formats."""

import csv
import io
import json
import signal
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main
from processes import lineseg
from waiting import SECONDS

from lineseg import EXTRACTORS, Params, Recording, agreements, open_recording
from lineseg.compare import TABLE_WRITERS, Comparison, halves
from lineseg.compare.search import search, tunable
from lineseg.readers import save_npz
from lineseg.simulate import RPLIDAR_A2
from lineseg.simulate.worlds import WORLDS
from lineseg.truth import Agreement

SAMPLES = Path(__file__).parents[2] / "sample_scans"
TWO = ["region-growing", "line-tracking"]


@pytest.fixture(scope="module")
def hallway() -> Recording:
    return open_recording(SAMPLES / "hallway.npz").only(np.arange(0, 120, 4))


@pytest.fixture(scope="module")
def done(hallway: Recording) -> Comparison:
    comparison = Comparison(hallway, TWO, budget=4)
    assert len(list(comparison.run())) == comparison.steps
    return comparison


@pytest.mark.parametrize(("frames", "most"), [(4, None), (5, 4), (37, 20), (300, None), (300, 60), (2000, 101)])
def test_no_frame_is_in_both_halves_and_each_has_its_share(frames: int, most: int | None):
    training, judged = halves(frames, most)
    assert not set(training) & set(judged)
    assert all(0 <= frame < frames for frame in training + judged)
    if most is None:
        assert len(training) + len(judged) == frames
    else:
        assert len(training) + len(judged) <= most
    assert abs(len(training) - len(judged)) <= max(2, frames // 20 + 1)


def test_halves_alternate_by_stretches_of_time_not_by_neighbouring_frames():
    training, judged = halves(300)
    assert training[:15] == list(range(15))
    assert judged[:15] == list(range(15, 30))


@pytest.mark.parametrize("method", list(EXTRACTORS.values()), ids=list(EXTRACTORS))
def test_every_method_gets_the_same_number_of_evaluations_its_defaults_first(method):
    tried = list(search(method, lambda params: float(params.numbers()["min_length"]), 5))
    assert len(tried) == 5
    assert tried[0][0] == method.params_type()
    switches = {name for name, kind, _ in method.params_type.knobs() if kind is bool}
    assert not switches & set(tunable(method))
    assert all(params.numbers()[name] == tried[0][0].numbers()[name] for params, _ in tried for name in switches)


def test_tuned_rows_are_judged_on_frames_that_were_not_tuned_on(hallway: Recording, done: Comparison):
    judged = hallway.only(np.array(done.halves.judged))
    rows = [row for row in done.rows if row.method == "region-growing"]
    default = rows[0]
    assert [(row.setting, row.evaluations) for row in rows] == [("installed", 0), ("proposed", 4), ("tuned", 4)]
    for row in rows:
        # Whatever P_min and L_min are tried, true lines have the usual ones.
        usual = Comparison(judged, ["region-growing"], budget=0)
        assert usual.truth
        assert row.agreement is not None
        assert row.agreement.true_lines == sum(each.true_lines for each in agreements(judged) if each)
    assert default.agreement == Agreement.of_all(each for each in agreements(judged) if each)


def test_the_same_call_gives_the_same_rates_and_thresholds(hallway: Recording, done: Comparison):
    again = Comparison(hallway, TWO, budget=4)
    list(again.run())
    assert [(row.method, row.params, row.agreement) for row in again.rows] == [
        (row.method, row.params, row.agreement) for row in done.rows
    ]


def test_times_are_of_every_judged_frame_beside_region_growing_in_the_same_turns(done: Comparison):
    for row in done.rows:
        assert row.times is not None
        assert row.reference is not None
        assert len(row.times) == len(row.reference) == len(done.halves.judged)
        assert (row.times > 0).all()
    assert done.rows[0].ratio == 1.0


def test_csv_and_json_hold_every_row_and_markdown_names_the_best_first(done: Comparison):
    report = json.loads(TABLE_WRITERS[".json"](done.rows))["rows"]
    table = list(csv.DictReader(io.StringIO(TABLE_WRITERS[".csv"](done.rows))))
    assert len(report) == len(table) == 6
    for in_json, in_csv in zip(report, table, strict=True):
        assert float(in_csv["true_rate"]) == in_json["true_rate"]
        assert json.loads(in_csv["params"]) == in_json["params"]
    scores = [row["score"] for row in report if row["setting"] == "tuned"]
    assert scores == sorted(scores, reverse=True)
    text = TABLE_WRITERS[".md"](done.rows)
    best = max((row for row in done.rows if row.setting == "tuned"), key=lambda row: row.score)
    assert f"| 1 | {best.label} | {best.score:.3f} |" in text
    assert "tuned, 4 settings tried" in text
    by_setting = [row.score for row in done.rows if row.method == "line-tracking"]
    assert "| Line tracking | " + " | ".join(f"{score:.3f}" for score in by_setting) + " |" in text
    assert "## hallway.npz (1081 beams over 270°, points scatter by 11 mm)" in text


def test_two_recordings_also_have_a_total(hallway: Recording):
    parts = [replace(hallway.only(np.arange(k, 30, 2)), name=name) for k, name in enumerate(("one", "two"))]
    comparisons = [Comparison(part, ["region-growing"], budget=0) for part in parts]
    for comparison in comparisons:
        list(comparison.run())
    rows = [row for comparison in comparisons for row in comparison.rows]
    found = Agreement.of_all(row.agreement for row in rows if row.agreement)
    (line,) = TABLE_WRITERS[".md"](rows).split("### All 2 recordings, as installed")[1].strip().splitlines()[2:]
    assert f"{found.true_rate:.1%} | {found.false_rate:.1%}" in line


def test_without_truth_methods_are_timed_only_and_that_is_said(hallway: Recording):
    comparison = Comparison(replace(hallway, wall=None), TWO)
    assert len(list(comparison.run())) == comparison.steps
    assert [row.evaluations for row in comparison.rows] == [0, 0]
    text = TABLE_WRITERS[".md"](comparison.rows)
    assert "No truth is known: times only." in text
    assert "score" not in text
    assert json.loads(TABLE_WRITERS[".json"](comparison.rows))["rows"][0]["true_rate"] is None


def test_an_interrupted_comparison_can_be_written(hallway: Recording):
    comparison = Comparison(hallway, TWO, budget=4)
    list(islice(comparison.run(), 1))
    assert [row.times for row in comparison.rows] == [None]
    for write in TABLE_WRITERS.values():
        assert "egion" in write(comparison.rows)


def test_the_command_compares_samples_and_files(hallway: Recording, tmp_path: Path, capsys):
    save_npz(hallway, tmp_path / "mine.npz")
    call = [
        "compare",
        str(tmp_path / "mine.npz"),
        "laboratory",
        "--methods",
        *TWO,
        "--most-frames",
        "8",
        "--budget",
        "2",
    ]
    assert main([*call, "-o", str(tmp_path / "out.json"), "--figures", str(tmp_path)]) == 0
    pictures = sorted(path.name for path in tmp_path.glob("*.svg"))
    assert pictures == [f"{name}_{what}.svg" for name in ("laboratory", "mine") for what in ("lines", "times")]
    assert "<svg" in (tmp_path / "mine_lines.svg").read_text()
    rows = json.loads((tmp_path / "out.json").read_text())["rows"]
    assert {row["recording"] for row in rows} == {"mine.npz", "laboratory.npz"}
    assert {(row["setting"], row["evaluations"]) for row in rows} == {("installed", 0), ("proposed", 2), ("tuned", 2)}
    assert len(rows) == 12
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["gone"], "gone: there is no such file, sample or world"),
        (["hallway", "--methods", "guess"], "there is no method 'guess'; choose from region-growing"),
        (["hallway", "--most-frames", "3"], "3 frames are too few for a comparison"),
        (["hallway", "--budget", "-1"], "the budget is -1 evaluations"),
        (["hallway", "-o", "out.pdf"], "out.pdf: use a name that ends in .md, .csv, .json"),
        (["hallway", "-o", "nowhere/out.md"], "the folder nowhere does not exist"),
    ],
)
def test_an_impossible_comparison_gets_a_sentence(arguments: list[str], sentence: str, capsys):
    assert main(["compare", *arguments]) == 2
    out, error = capsys.readouterr()
    assert out == ""
    assert sentence in error
    assert error.count("\n") == 1


def test_a_recording_of_three_frames_has_no_halves(hallway: Recording):
    with pytest.raises(ValueError, match="has 3 frames; a comparison needs 4 or more"):
        Comparison(hallway.only(np.arange(3)))


def test_ctrl_c_writes_the_finished_part():
    process = lineseg("compare", "hallway", "--methods", *TWO, "--budget", 100_000)
    assert process.stderr
    assert "hallway.npz: 30 frames for tuning, 30 for judging" in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=SECONDS)
    assert (process.returncode, error) == (0, "lineseg: stopped; writing the results so far.\n")
    assert "| 1 | Region growing |" in out or "| 1 | Line tracking |" in out


def test_the_defaults_are_never_beaten_by_something_worse_on_the_training_half(hallway: Recording):
    comparison = Comparison(hallway, ["region-growing"], budget=1)
    list(comparison.run())
    assert [row.params for row in comparison.rows] == 3 * [Params()]
    assert len({row.agreement for row in comparison.rows}) == 1


def test_for_a_coarse_laser_every_method_gains_from_what_is_proposed_without_truth():
    laser = replace(RPLIDAR_A2, sigma=0.05, sigma_far=0.05)
    recording = replace(WORLDS["flat"], laser=laser).recording("flat", 24)
    comparison = Comparison(recording, [*TWO, "split-and-merge-textbook"], budget=12)
    list(comparison.run())
    for method in comparison.methods:
        installed, proposed, _ = (row for row in comparison.rows if row.method == method.name)
        assert proposed.score > installed.score + 0.2
        # What lines are wanted is nothing that the scans can say.
        assert proposed.params.numbers()["min_length"] == installed.params.numbers()["min_length"]


def test_where_nothing_fits_the_noise_the_defaults_are_proposed(hallway: Recording):
    few = hallway.only(np.arange(4))
    comparison = Comparison(few, ["region-growing"], budget=2)
    list(comparison.run())
    assert [(row.setting, row.evaluations) for row in comparison.rows][1] == ("proposed", 0)
