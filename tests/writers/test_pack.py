"""A failure pack holds one frame with everything about it, and opens again unchanged."""

import csv
import io
import json
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lineseg import FrameLabels, Params, extract, open_recording, read_pack, read_params, trace, write_pack
from lineseg.readers import save_npz
from lineseg.truth.label_file import said_in

HALLWAY = Path(__file__).parents[2] / "sample_scans" / "hallway.npz"
PARAMS = Params(epsilon=0.02)


@pytest.fixture
def pack(tmp_path):
    write_pack(tmp_path / "door.zip", open_recording(HALLWAY), 17, PARAMS, note="the door is bridged – why?")
    return tmp_path / "door.zip"


def content(pack, name):
    with zipfile.ZipFile(pack) as archive:
        return archive.read(name).decode()


def test_the_frame_opens_again_with_its_truth(pack):
    original, opened = open_recording(HALLWAY)[17], open_recording(pack)
    assert (opened.name, opened.format, len(opened)) == ("door.zip", "failure pack", 1)
    for name in ("ranges", "bearings", "wall"):
        assert np.array_equal(getattr(opened[0], name), getattr(original, name))
    assert extract(opened[0], PARAMS).segments == extract(original, PARAMS).segments


def test_a_pack_is_recognised_by_its_content_and_not_by_its_name(pack, tmp_path):
    other = pack.rename(tmp_path / "something.npz")
    assert open_recording(other).format == "failure pack"
    with zipfile.ZipFile(tmp_path / "plain.zip", "w") as plain, zipfile.ZipFile(other) as archive:
        plain.writestr("frame.npz", archive.read("frame.npz"))
    assert open_recording(tmp_path / "plain.zip").format == "NPZ"


def test_a_pack_says_where_it_came_from(pack):
    about = read_pack(pack)
    assert (about.recording, about.frame, about.method) == ("hallway.npz", 17, "region-growing")
    assert about.note == "the door is bridged – why?"
    assert Params(**about.params) == PARAMS == read_params(content(pack, "lineseg.json"))


def test_a_pack_holds_the_result(pack):
    scan = open_recording(HALLWAY)[17]
    traced = trace(scan, PARAMS)
    rows = list(csv.DictReader(io.StringIO(content(pack, "frame.csv"))))
    assert [int(row["segment"]) for row in rows] == traced.extraction.labels.tolist()
    assert [float(row["range"]) for row in rows] == pytest.approx(scan.ranges.tolist(), nan_ok=True)
    segments = json.loads(content(pack, "segments.jsonl"))
    assert (segments["frame"], len(segments["segments"])) == (17, len(traced.extraction.segments))
    decisions = [json.loads(line) for line in content(pack, "trace.jsonl").splitlines()]
    assert [decision["text"] for decision in decisions] == [decision.text for decision in traced]
    assert content(pack, "picture.svg").startswith("<svg")
    assert content(pack, "note.txt") == "the door is bridged – why?\n"


def test_packing_twice_gives_the_same_bytes():
    packs = [io.BytesIO(), io.BytesIO()]
    for pack in packs:
        write_pack(pack, open_recording(HALLWAY), 3)
    assert packs[0].getvalue() == packs[1].getvalue()


@pytest.mark.parametrize(
    ("about", "sentence"),
    [
        ({"version": 2}, "a failure pack of version 2, but this lineseg reads 1; update it"),
        ({"format": "other"}, "bad.zip is not a failure pack"),
        ({"frame": "x"}, "frame in lineseg.json is 'x'; it must have the type int"),
    ],
)
def test_a_pack_that_cannot_be_read_says_why(pack, tmp_path, about, sentence):
    known = json.loads(content(pack, "lineseg.json"))
    with zipfile.ZipFile(tmp_path / "bad.zip", "w") as bad:
        bad.writestr("lineseg.json", json.dumps(known | about))
    with pytest.raises(ValueError, match=sentence):
        open_recording(tmp_path / "bad.zip")


def test_a_pack_without_its_frame_or_cut_off_is_refused(pack, tmp_path):
    with zipfile.ZipFile(tmp_path / "bad.zip", "w") as bad:
        bad.writestr("lineseg.json", content(pack, "lineseg.json"))
    with pytest.raises(ValueError, match=r"frame\.npz"):
        open_recording(tmp_path / "bad.zip")
    (tmp_path / "cut.zip").write_bytes(pack.read_bytes()[:2000])
    with pytest.raises(ValueError, match=r"cut\.zip"):
        open_recording(tmp_path / "cut.zip")


def test_a_recording_is_still_saved_to_a_path_or_a_file(tmp_path):
    recording, memory = open_recording(HALLWAY), io.BytesIO()
    save_npz(recording, memory)
    save_npz(recording, tmp_path / "path.npz")
    assert np.array_equal(np.load(io.BytesIO(memory.getvalue()))["ranges"], np.load(tmp_path / "path.npz")["ranges"])


def test_what_was_said_of_the_frame_travels_with_it(tmp_path):
    recording = open_recording(HALLWAY)
    said = replace(FrameLabels.of(extract(recording[17], PARAMS)), tags=("glass",), note="the door is open", revision=3)
    write_pack(tmp_path / "door.zip", recording, 17, PARAMS, labels=said)
    assert said_in(open_recording(tmp_path / "door.zip").pack.labels) == replace(said, revision=0)
