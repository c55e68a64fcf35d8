"""How a file is read is a flag of every command that reads; several files are one batch."""

import json

import numpy as np
import pytest
from lineseg_app.__main__ import main

from lineseg import Scan
from lineseg.readers import Reading, save_npz
from lineseg.scan import Recording


@pytest.fixture
def run(capsys):
    def call(*arguments):
        code = main([str(argument) for argument in arguments])
        return code, *capsys.readouterr()

    return call


@pytest.fixture
def folder(tmp_path):
    """Two recordings of a wall 2 m ahead, 10 scans at 10 Hz, with truth; and a file that is none."""
    bearings = np.deg2rad(np.arange(-60, 61))
    noise = np.random.default_rng(0)
    for name in ("a", "b"):
        scans = [
            Scan(2 / np.cos(bearings) + noise.normal(0, 0.002, 121), bearings, stamp=5 + 0.1 * at,
                 wall=np.zeros(121, np.int64))
            for at in range(10)
        ]  # fmt: skip
        save_npz(Recording.from_scans(scans), tmp_path / f"{name}.npz")
    (tmp_path / "c.npz").write_bytes(b"PK\3\4 nothing")
    return tmp_path


def frames(out):
    return [json.loads(line)["frame"] for line in out.splitlines()]


def test_frames_and_seconds_mean_the_same_in_every_command_and_keep_the_numbers_of_the_file(run, folder):
    file = folder / "a.npz"
    assert frames(run("extract", file, "--frames", "3:6")[1]) == [3, 4, 5]
    assert frames(run("extract", file, "--seconds", "0.25:0.55")[1]) == [3, 4, 5]
    assert frames(run("extract", file, "--every-scan", "4")[1]) == [0, 4, 8]
    report = json.loads(run("score", file, "--frames", "3:6", "--json")[1])
    assert [each["frame"] for each in report["frames"]] == [3, 4, 5]
    assert "scans         3\n" in run("info", file, "--frames", "3:6")[1]
    code, _, err = run("extract", file, "--frames", "20:30")
    assert (code, err) == (
        2,
        "lineseg: a.npz: frames is '20:30', which is empty; the recording has the frames 0 to 9.\n",
    )


def test_many_files_and_globs_are_one_batch_in_which_one_bad_file_hides_no_other(run, folder):
    code, out, err = run("info", folder / "*.npz")
    assert (code, out.count("taken for"), "c.npz: a damaged NPZ file" in err) == (2, 2, True)
    assert err.endswith("lineseg: 1 of 3 files failed; see above.\n")
    code, out, _ = run("score", folder / "a.npz", folder / "b.npz", "--csv")
    assert (code, out.splitlines()[0].split(",")[:2], len(out.splitlines())) == (0, ["file", "frame"], 21)
    assert "all 2 files, region-growing" in run("score", folder / "[ab].npz")[1]


def test_extract_writes_how_it_was_made(run, folder):
    code, out, _ = run("extract", folder / "a.npz", "--range-max", "9", "--epsilon", "0.05")
    about = json.loads(out.splitlines()[0])["about"]
    assert (code, about["params"]["epsilon"], about["reading"]["range_max"]) == (0, 0.05, 9.0)
    assert Reading(**about["reading"]).unit == "m"
    assert "about" not in json.loads(out.splitlines()[1])
    assert run("extract", folder / "[ab].npz", "--out", folder / "out")[0] == 0
    assert sorted(path.name for path in (folder / "out").iterdir()) == ["a.npz.jsonl", "b.npz.jsonl"]
    (folder / "more").mkdir()
    (folder / "more" / "a.npz").write_bytes((folder / "a.npz").read_bytes())
    assert run("extract", folder / "a.npz", folder / "more" / "a.npz", "--out", folder / "two")[0] == 0
    assert len(list((folder / "two").iterdir())) == 2
    assert "name a folder" in run("extract", folder / "[ab].npz", "--out", folder / "lines.csv")[2]
    run("extract", folder / "a.npz", "--out", folder / "lines.csv")
    assert json.loads((folder / "lines.csv.json").read_text())["method"] == "region-growing"
    run("extract", folder / "a.npz", "--out", folder / "lines.geojson")
    assert json.loads((folder / "lines.geojson").read_text())["about"]["file"] == "a.npz"


def test_a_flag_that_makes_no_sense_for_a_format_is_refused(run, folder):
    for flags, sentence in (
        (("--echo", "1"), "a.npz: echo cannot be used, because an NPZ has one range for each beam"),
        (("--stamps", "recorded"), "a.npz: stamps cannot be the recorder's; only a bag has its recorder's times."),
        (("--geometry", "1"), "a.npz has no geometry 1; it has 1, numbered from 0."),
        (("--frame-id", "front"), "a.npz has no frame_id 'front'; it has ''."),
    ):
        code, _, err = run("info", folder / "a.npz", *flags)
        assert code == 2
        assert err.startswith(f"lineseg: {sentence}")


def test_filters_apply_to_every_format(run, folder):
    out = run("info", folder / "a.npz", "--sector", "-10:10", "--every-beam", "2")[1]
    assert "10 scans × 11 beams · metres · −10…10° counter-clockwise" in out
    out = run("info", folder / "a.npz", "--direction", "clockwise")[1]
    assert "60…−60° clockwise" in out
    assert "100.00%" in run("info", folder / "a.npz", "--range-max", "1")[1]
