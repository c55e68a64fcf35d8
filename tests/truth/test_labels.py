"""Labels are kept in a file that people can read, that two programs can write, and that nothing breaks."""

import json
import signal
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from scenes import corner, room, scans, wall_ahead

from lineseg import (
    ConflictError,
    FrameLabels,
    Recording,
    TrueLine,
    agreement,
    extract,
    label_file,
    read_labels,
    save_labels,
)

LINE = TrueLine(10, 80, (2.0, -1.0), (2.0, 0.5))


@pytest.fixture
def walls():
    return Recording.from_scans([wall_ahead(noise=0.005, seed=seed) for seed in range(5)], name="walls.npz")


@pytest.fixture
def file(tmp_path):
    return tmp_path / "walls.npz.lineseg.json"


def test_saved_labels_are_read_again(walls, file):
    said = FrameLabels(
        (LINE, TrueLine(90, 120, (2.0, 0.6), (2.0, 0.9))), ("door", "Tür offen"), 'a "note"\nin two lines'
    )
    saved = save_labels(file, walls, 3, said)
    assert saved == replace(said, revision=1)
    assert read_labels(file, walls) == {3: saved}


def test_without_a_file_there_are_no_labels(walls, file):
    assert read_labels(file, walls) == {}


@given(scans())
def test_an_extraction_as_labels_is_its_own_truth(scan):
    found = extract(scan)
    labels = FrameLabels.of(found)
    assert np.array_equal(labels.truth(scan), found.labels)
    assert labels.ends.shape == (len(found.segments), 2, 2)
    agreed = agreement(found, labels.truth(scan), labels.ends)
    assert agreed.matches == len(found.segments)
    assert agreed.endpoint_errors == (0.0,) * 2 * len(found.segments)


def test_a_frame_without_lines_differs_from_an_unlabelled_frame(walls, file):
    save_labels(file, walls, 0, FrameLabels(()))
    save_labels(file, walls, 1, FrameLabels(note="later"))
    read = read_labels(file, walls)
    assert (read[0].lines, read[1].lines) == ((), None)
    assert read[0].truth(walls[0]).tolist() == [-1] * 180
    assert read[1].truth(walls[1]) is None


def test_the_file_can_be_read_by_hand(walls, file):
    save_labels(file, walls, 3, FrameLabels((LINE,), ("glass",)))
    lines = file.read_text(encoding="utf-8").splitlines()
    assert '  "version": 1,' in lines
    assert '      {"first": 10, "last": 80, "start": [2.0, -1.0], "end": [2.0, 0.5]}' in lines
    assert json.loads("\n".join(lines))["frames"]["3"]["tags"] == ["glass"]


def test_two_writers_of_different_frames_lose_nothing(walls, file):
    save_labels(file, walls, 0, FrameLabels(note="one"))
    save_labels(file, walls, 1, FrameLabels(note="other"))
    assert {frame: labels.note for frame, labels in read_labels(file, walls).items()} == {0: "one", 1: "other"}


def test_an_edit_of_an_old_revision_does_not_overwrite_a_frame(walls, file):
    seen = save_labels(file, walls, 0, FrameLabels(note="first"))
    theirs = save_labels(file, walls, 0, replace(seen, note="theirs"))
    before = file.read_bytes()
    with pytest.raises(ConflictError, match="frame 0 was changed elsewhere: it is at revision 2, you have 1") as told:
        save_labels(file, walls, 0, replace(seen, note="mine"))
    assert told.value.theirs == theirs
    assert file.read_bytes() == before
    assert save_labels(file, walls, 0, replace(theirs, note="mine after all")).revision == 3


def test_many_threads_lose_no_edit(walls, file):
    def edit(frame):
        labels = FrameLabels()
        for number in range(10):
            labels = save_labels(file, walls, frame, replace(labels, note=f"{number}"))

    threads = [threading.Thread(target=edit, args=(frame,)) for frame in range(5)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {frame: (each.note, each.revision) for frame, each in read_labels(file, walls).items()} == dict.fromkeys(
        range(5), ("9", 10)
    )


WRITER = """
import sys
from dataclasses import replace
from pathlib import Path
sys.path[:0] = sys.argv[2:]
from test_labels import LINE
from scenes import wall_ahead
from lineseg import FrameLabels, Recording, save_labels
walls = Recording.from_scans([wall_ahead(noise=0.005, seed=seed) for seed in range(5)], name="walls.npz")
labels = FrameLabels((LINE,))
while True:
    labels = save_labels(Path(sys.argv[1]), walls, 2, replace(labels, note="n" * (labels.revision * 997 % 50_000)))
    print(labels.revision, flush=True)
"""


def test_a_writer_that_is_killed_loses_nothing_that_it_saved(walls, file):
    told = 0
    for edits in (1, 7, 25):
        file.unlink(missing_ok=True)
        command = [sys.executable, "-c", WRITER, str(file), *map(str, Path(__file__).parents[:2])]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:
            assert writer.stdout is not None
            for _ in range(edits):
                told = int(writer.stdout.readline())
            writer.send_signal(signal.SIGKILL)
        read = read_labels(file, walls)[2]
        assert read.revision >= told >= edits
        assert (read.lines, read.note) == ((LINE,), "n" * ((read.revision - 1) * 997 % 50_000))
        # No lock is left behind.
        assert save_labels(file, walls, 2, replace(read, note="")).revision == read.revision + 1


def broken(file, **changes):
    """A file of labels with other entries at its top."""
    tree = {"format": "lineseg labels", "version": 1, "recording": {"name": "walls.npz", "frames": 5}, "frames": {}}
    file.write_text(json.dumps(tree | changes), encoding="utf-8")


ENTRY = {"revision": 1, "beams": 180, "lines": []}


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"version": 2},
            "walls.npz.lineseg.json: the labels have version 2, but this lineseg reads 1; update",
        ),
        ({"format": "other"}, "this is not a label file"),
        ({"recording": {"name": "hall.bag", "frames": 7}}, "belong to hall.bag with 7 frames; walls.npz has 5"),
        ({"frames": {"1": ENTRY | {"beams": 360}}}, "the labels of frame 1 are for 360 beams; the scan has 180"),
        ({"frames": {"9": ENTRY}}, "frame 9: walls.npz has the frames 0 to 4"),
        ({"frames": {"1": {"beams": 180}}}, "is not a valid label file: 'revision' is missing"),
        ({"frames": [1]}, "is not a valid label file"),
        ({"recording": None}, "is not a valid label file"),
    ],
)
def test_a_file_that_does_not_fit_is_refused_and_stays_as_it_is(walls, file, changes, sentence):
    broken(file, **changes)
    before = file.read_bytes()
    for attempt in (lambda: read_labels(file, walls), lambda: save_labels(file, walls, 0, FrameLabels(()))):
        with pytest.raises(ValueError) as told:
            attempt()
        assert sentence in str(told.value)
        assert str(told.value).startswith("walls.npz.lineseg.json")
    assert file.read_bytes() == before


@pytest.mark.parametrize(
    "content", [b"", b"{", b'{"format": "lineseg labels"', b"\xff\xfe", b"[" * 100_000, b"[]", b"7"]
)
def test_a_broken_file_is_refused_and_stays_as_it_is(walls, file, content):
    file.write_bytes(content)
    with pytest.raises(ValueError, match=r"walls\.npz\.lineseg\.json"):
        save_labels(file, walls, 0, FrameLabels(()))
    assert file.read_bytes() == content


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ([(10, 180)], "beams 10 to 180; the scan has the beams 0 to 179"),
        ([(-1, 10)], "beams -1 to 10; the scan has"),
        ([(80, 10)], "only a line on a full circle may continue past the last beam"),
        ([(10, 80), (80, 90)], "true line 1: beams 80 to 90; beam 80 already belongs to line 0"),
    ],
)
def test_impossible_lines_are_refused(walls, file, lines, sentence):
    labels = FrameLabels(tuple(replace(LINE, first=first, last=last) for first, last in lines))
    with pytest.raises(ValueError, match=sentence):
        save_labels(file, walls, 0, labels)
    assert not file.exists()


def test_endpoints_must_be_points_and_frames_must_be_there(walls, file):
    with pytest.raises(ValueError, match="are not finite"):
        save_labels(file, walls, 0, FrameLabels((replace(LINE, end=(np.nan, 0.0)),)))
    with pytest.raises(ValueError, match=r"frame 5: walls\.npz has the frames 0 to 4"):
        save_labels(file, walls, 5, FrameLabels(()))


def test_a_true_line_may_cross_the_seam():
    around = Recording.from_scans([room()], name="room")
    labels = FrameLabels((replace(LINE, first=350, last=9),))
    truth = labels.truth(around[0])
    assert np.flatnonzero(truth == 0).tolist() == [*range(10), *range(350, 360)]


@given(scans())
def test_a_line_over_the_beams_of_a_segment_ends_where_the_outermost_points_fall_on_the_fitted_line(scan):
    for segment in extract(scan).segments:
        line = TrueLine.over(scan, segment.first, segment.last)
        assert (line.first, line.last) == (segment.first, segment.last)
        assert np.allclose((line.start, line.end), (segment.start, segment.end), atol=1e-6)


def test_a_line_over_beams_without_points_has_no_ends(walls):
    lost = replace(walls[0], ranges=np.full(180, np.nan))
    for line in (TrueLine.over(lost, 10, 20), TrueLine.over(walls[0], 10, 500)):
        assert np.isnan((line.start, line.end)).all()


def test_labels_lie_beside_the_recording_or_in_the_users_folder(tmp_path):
    folder = tmp_path / "data"
    folder.mkdir()
    assert label_file(folder / "hall.bag", tmp_path) == folder / "hall.bag.lineseg.json"
    lost = label_file(tmp_path / "gone" / "hall.bag", tmp_path / "user")
    assert lost.parent == tmp_path / "user" / "labels"
    assert lost != label_file(tmp_path / "elsewhere" / "hall.bag", tmp_path / "user")
    save_labels(lost, Recording.from_scans([corner()]), 0, FrameLabels(note="kept"))
    assert lost.exists()


def test_nothing_but_the_labels_is_left_in_the_folder(walls, file):
    save_labels(file, walls, 0, FrameLabels(()))
    assert [path.name for path in file.parent.iterdir()] == [file.name]


def test_a_link_to_a_label_file_stays_a_link(walls, file, tmp_path):
    (tmp_path / "shared").mkdir()
    file.symlink_to(tmp_path / "shared" / "labels.json")
    save_labels(file, walls, 0, FrameLabels(note="a"))
    save_labels(file, walls, 1, FrameLabels(note="b"))
    assert file.is_symlink()
    assert set(read_labels(tmp_path / "shared" / "labels.json", walls)) == {0, 1}


def test_a_write_protected_label_file_is_not_replaced(walls, file):
    save_labels(file, walls, 0, FrameLabels(note="a"))
    file.chmod(0o444)
    before = file.read_bytes()
    with pytest.raises(PermissionError, match="write-protected"):
        save_labels(file, walls, 1, FrameLabels(note="b"))
    assert file.read_bytes() == before


def test_half_a_character_in_a_note_does_not_spoil_the_file(walls, file):
    assert save_labels(file, walls, 0, FrameLabels(note="a\ud800", tags=("\udfff",))).note == "a?"
    file.write_text(file.read_text().replace('"a?"', '"a\\ud800"'))
    save_labels(file, walls, 1, FrameLabels(note="b"))
    assert read_labels(file, walls)[0].note == "a?"


def test_a_long_name_has_its_labels_in_the_data_folder(walls, tmp_path):
    path = label_file(tmp_path / f"{250 * 'a'}.npz", tmp_path / "data")
    assert path.is_relative_to(tmp_path / "data")
    assert path != label_file(tmp_path / f"{251 * 'a'}.npz", tmp_path / "data")
    save_labels(path, walls, 0, FrameLabels(note="a"))
    assert read_labels(path, walls)[0].note == "a"
