"""`lineseg score`: the table, its numbers, and recordings that it cannot score."""

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.__main__ import main

from lineseg import Agreement, FrameLabels, Params, agreements, extract, open_recording, save_labels, save_npz

HALLWAY = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"


@pytest.fixture(scope="module")
def thinned(tmp_path_factory) -> Path:
    """Every tenth frame of the sample."""
    whole, file = open_recording(HALLWAY), tmp_path_factory.mktemp("thinned") / "hallway.npz"
    save_npz(whole.only(np.arange(0, len(whole), 10)), file)
    return file


@pytest.fixture
def score(capsys):
    def call(*arguments):
        code = main(["score", *map(str, arguments)])
        return code, *capsys.readouterr()

    return call


def test_the_table_has_the_numbers_of_the_library(score, thinned):
    total = Agreement.of_all(agreements(open_recording(thinned)))
    code, out, _ = score(thinned)
    assert code == 0
    assert out.startswith("hallway.npz, 30 frames with true lines, region-growing\n")
    rates = total.true_rate, total.false_rate, total.neutral_false_rate
    for value in (*(f"{rate:.2%}" for rate in rates), str(total.neutral), f"{total.endpoint_error(95):.4f} m"):
        assert value in out


def test_json_and_csv_have_every_frame(score, thinned):
    report = json.loads(score(thinned, "--json", "--epsilon", 0.02)[1])
    rows = list(csv.DictReader(io.StringIO(score(thinned, "--csv", "--epsilon", 0.02)[1])))
    frames = list(agreements(open_recording(thinned), Params(epsilon=0.02)))
    assert report["params"]["epsilon"] == 0.02
    assert report["matches"] == sum(frame.matches for frame in frames)
    for agreement, in_json, in_csv in zip(frames, report["frames"], rows, strict=True):
        assert in_json["matches"] == int(in_csv["matches"]) == agreement.matches
        assert in_json["true_rate"] == float(in_csv["true_rate"]) == agreement.true_rate


def test_labels_are_the_truth_of_the_frames_that_have_them(score, tmp_path):
    recording, file = open_recording(HALLWAY), tmp_path / "labels.lineseg.json"
    for frame in (3, 200):
        save_labels(file, recording, frame, FrameLabels.of(extract(recording[frame])))
    save_labels(file, recording, 5, FrameLabels(note="no lines drawn"))
    report = json.loads(score(HALLWAY, "--json", "--truth", file)[1])
    assert [frame["frame"] for frame in report["frames"]] == [3, 200]
    assert (report["true_rate"], report["false_rate"], report["endpoint_error_p95"]) == (1, 0, 0)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([HALLWAY.with_suffix(".log"), "--walls", "none"], "hallway.log has no truth"),
        ([HALLWAY, "--truth", "gone.json"], "gone.json: there is no such file"),
        ([HALLWAY, "--truth", HALLWAY], "hallway.npz is not a text file; labels are JSON"),
        ([HALLWAY, "--method", "guess"], "there is no method 'guess'; choose from region-growing"),
        ([HALLWAY, "--json", "--csv"], "--json and --csv cannot be combined"),
    ],
)
def test_a_recording_that_cannot_be_scored_gets_a_sentence(score, arguments, sentence):
    code, out, error = score(*arguments)
    assert (code, out) == (2, "")
    assert sentence in error
    assert error.count("\n") == 1
