"""True lines, tags and notes sent by the page are saved at once, sent to every tab and never lost."""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import fields, replace
from pathlib import Path

import pytest
from lineseg_app.live.ring import LiveRecording
from lineseg_app.places import data_folder
from lineseg_app.server import Settings
from lineseg_app.shelf.label_files import LabelFiles
from lineseg_app.shelf.library import Library
from lineseg_app.shelf.recent import Recent
from lineseg_app.shelf.uploads import Uploads
from live import Address, page_of, serving

from lineseg import (
    Agreement,
    FrameLabels,
    agreement,
    agreements,
    extract,
    open_recording,
    read_labels,
    save_labels,
    write_pack,
)
from lineseg.scan import Topic
from lineseg.truth.labels import TrueLine


@pytest.fixture
def file(recordings: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(recordings / "walls.npz", tmp_path / "walls.npz"))


@pytest.fixture
def sidecar(file: Path) -> Path:
    return file.with_name("walls.npz.lineseg.json")


@pytest.fixture
def own(file: Path, tmp_path: Path):
    """A server with a recording that may be labelled."""
    with serving(Settings(files=(file,), data_folder=tmp_path / "user", upload_limit=1_000_000)) as address:
        yield address


@pytest.fixture
def page(own: Address):
    with page_of(own) as page:
        yield page


def test_a_file_whose_name_is_not_text_opens_and_is_labelled(recordings: Path, tmp_path: Path):
    file = Path(shutil.copy(recordings / "walls.npz", tmp_path / os.fsdecode(b"caf\xe9.npz")))
    for revision, files in enumerate(((file,), ())):  # the second time it is a recent one
        with serving(Settings(files=files, data_folder=tmp_path / "user")) as server, page_of(server) as page:
            page.hello()
            offered = page.welcome["recordings"]
            (id,) = [each["id"] for each in offered if each["label"] == "caf\ufffd.npz"]
            state = page.change(recording=id) if not files else page.change(frame=1)
            assert state["label"] == "caf\ufffd.npz"
            assert put(server, state, note="seen", revision=revision).status_code == 200
    assert (tmp_path / os.fsdecode(b"caf\xe9.npz.lineseg.json")).exists()


def put(server: Address, state: dict, **said):
    usual = {"recording": state["recording"], "frame": 0, "revision": 0, "lines": None, "tags": [], "note": ""}
    return server.put("/api/labels", json=usual | said)


def test_an_edit_is_in_the_file_beside_the_recording_and_on_the_screen(own, page, file, sidecar):
    state = page.hello(mode="inspect")
    told = state["labels"]
    assert (told["lines"], told["file"], told["folder"], told["apart"]) == (None, sidecar.name, str(file.parent), False)
    answer = put(own, state, lines=[{"first": 20, "last": 90}], tags=["door"], note="ajar")
    assert answer.status_code == 200
    expected = FrameLabels((TrueLine.over(open_recording(file)[0], 20, 90),), ("door",), "ajar", 1)
    assert read_labels(sidecar, open_recording(file)) == {0: expected}
    drawn = page.until(lambda state: state["labels"]["revision"] == 1)
    assert drawn["labels"]["lines"] == answer.json()["lines"] == [json.loads(json.dumps(vars(expected.lines[0])))]
    overview = own.get("/api/labels", params={"recording": state["recording"]}).json()
    assert overview["frames"] == {"0": {"revision": 1, "lines": 1, "tags": ["door"], "note": "ajar"}}
    assert overview["stamp"] == drawn["labels"]["stamp"]


def test_ends_that_were_sent_stay_as_they_are(own, page, sidecar, file):
    state = page.hello(mode="inspect")
    line = {"first": 20, "last": 90, "start": [4.0, -1.5], "end": [4.0, 1.25]}
    assert put(own, state, lines=[line]).json()["lines"] == [line]


def test_segments_are_judged_by_labels_once_there_are_some_and_by_the_wall_on_demand(tmp_path, recordings):
    file = Path(shutil.copy(data_folder("sample_scans") / "hallway.npz", tmp_path / "hallway.npz"))
    with serving(Settings(files=(file,), data_folder=tmp_path / "user")) as server, page_of(server) as page:
        state = page.hello(mode="inspect", frame=4)
        assert (state["references"], state["judgedBy"]) == (["wall"], "wall")
        hallway = open_recording(file)
        segments = extract(hallway[4]).segments
        lines = [{"first": line.first, "last": line.last} for line in segments[1:]]
        put(server, state, frame=4, lines=lines)
        state = page.until(lambda state: state["judgedBy"] == "labels")
        labels = read_labels(file.with_name("hallway.npz.lineseg.json"), hallway)[4]
        mine = agreement(extract(hallway[4]), labels.truth(hallway[4]), labels.ends)
        assert (mine.matches, mine.segments) == (len(segments) - 1, len(segments))
        assert state["agreement"]["falseRate"] == mine.false_rate
        session = page.welcome["session"]
        total = server.get("/api/truth", params={"session": session}).json()
        assert (total["judgedBy"], total["agreement"]["trueLines"]) == ("labels", mine.true_lines)
        assert page.change(frame=5)["agreement"] is None
        by_wall = Agreement.of_all(each for each in agreements(hallway) if each is not None)
        assert page.change(reference="wall")["judgedBy"] == "wall"
        total = server.get("/api/truth", params={"session": session}).json()
        assert (total["judgedBy"], total["agreement"]["trueLines"]) == ("wall", by_wall.true_lines)


def test_an_edit_of_an_old_revision_is_refused_and_overwrites_nothing(own, page, sidecar):
    state = page.hello(mode="inspect")
    put(own, state, note="first")
    put(own, state, frame=1, note="another frame")
    late = put(own, state, note="second")
    assert late.status_code == 409
    assert late.json()["theirs"] == {"revision": 1, "lines": None, "tags": [], "note": "first"}
    assert "changed elsewhere" in late.json()["message"]
    saved = json.loads(sidecar.read_text())["frames"]
    assert [saved["0"]["note"], saved["1"]["note"]] == ["first", "another frame"]


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ('{"format": "lineseg labels",', "this is not JSON"),
        ('{"format": "lineseg labels", "version": 2}', "have version 2, but this lineseg reads 1; update lineseg"),
        (
            '{"format": "lineseg labels", "version": 1, "recording": {"name": "hall", "frames": 7}, "frames": {}}',
            "the labels belong to hall with 7 frames; walls.npz has 5",
        ),
        (
            '{"format": "lineseg labels", "version": 1, "recording": {"name": "walls", "frames": 5}, '
            '"frames": {"0": {"revision": 1, "beams": 99}}}',
            "for 99 beams; the scan has 180",
        ),
    ],
)
def test_an_unreadable_label_file_is_reported_and_kept_and_the_recording_opens(own, page, sidecar, content, sentence):
    sidecar.write_text(content)
    state = page.hello(mode="inspect")
    assert sentence in state["labels"]["trouble"]
    assert len(state["segments"]) == 1
    refused = put(own, state, note="lost?")
    assert refused.status_code == 400
    assert sentence in refused.json()["message"]
    assert sidecar.read_text() == content


def test_an_unwritable_place_is_reported(own, page, sidecar):
    sidecar.mkdir()
    state = page.hello(mode="inspect")
    assert "cannot be read: Is a directory" in state["labels"]["trouble"]
    assert put(own, state, note="lost?").status_code == 507


def test_samples_uploads_and_drawn_worlds_have_their_labels_in_the_users_folder(own, page, file, tmp_path):
    page.hello()
    upload = own.upload("walls.npz", file.read_bytes()).json()["recording"]
    again = own.upload("other name.npz", file.read_bytes()).json()["recording"]
    drawn = next(entry["id"] for entry in page.welcome["recordings"] if entry["group"] == "Drawn")
    for recording in ("sample:hallway", "lesson:1_seed", upload, drawn):
        known = [entry["id"] for entry in page.welcome["recordings"]]
        if recording.startswith("lesson:"):
            recording = next(id for id in known if id.startswith("lesson:"))
        assert put(own, {"recording": recording}, note=f"of {recording}").status_code == 200, recording
    kept = {path.name.split(".")[0] for path in (tmp_path / "user" / "labels").iterdir()}
    assert {"hallway", "walls", "drawn"} < kept
    assert not list(data_folder("sample_scans").rglob("*.lineseg.json"))
    state = page.change(recording=upload, mode="inspect")
    assert state["labels"]["note"] == f"of {upload}"
    assert state["labels"]["apart"]
    assert page.change(recording=again)["labels"]["note"] == ""


def test_labels_of_the_same_bytes_are_found_again(own, page, file):
    page.hello()
    first, second = (own.upload("walls.npz", file.read_bytes()).json()["recording"] for _ in range(2))
    put(own, {"recording": first}, note="seen")
    assert page.change(recording=second, mode="inspect")["labels"]["note"] == "seen"


@pytest.mark.parametrize(
    ("said", "status", "sentence"),
    [
        ({"frame": 5}, 400, "has the frames 0 to 4"),
        ({"lines": [{"first": 10, "last": 200}]}, 400, "the scan has the beams 0 to 179"),
        ({"lines": [{"first": 10, "last": 30}, {"first": 30, "last": 60}]}, 400, "beam 30 already belongs to line 0"),
        ({"lines": [{"first": -1, "last": 30}]}, 422, "lines.0.first is -1"),
        ({"tags": ["x" * 61]}, 422, "tags.0"),
        ({"words": 1}, 422, "words is 1"),
        ({"recording": "file:nothing"}, 404, "does not know the file of this link"),
        ({"recording": "live:1"}, 400, "live recording"),
    ],
)
def test_invalid_labels_are_refused_with_a_sentence(own, page, sidecar, said, status, sentence):
    state = page.hello(mode="inspect")
    refused = put(own, state, **said)
    assert (refused.status_code, sentence in refused.json()["message"]) == (status, True), refused.text
    assert not sidecar.exists()


def test_the_points_of_a_frame_are_given_beam_by_beam(own, page, file):
    state = page.hello()
    answer = own.get("/api/labels/points", params={"recording": state["recording"], "frame": 2}).json()
    scan = open_recording(file)[2]
    assert len(answer["points"]) == len(scan)
    assert answer["points"][90] == pytest.approx(scan.xy[90].tolist(), abs=1e-4)
    assert answer["fullCircle"] is False


def test_labels_saved_by_another_program_appear_in_the_next_picture(page, sidecar, file):
    page.hello(mode="inspect")
    save_labels(sidecar, open_recording(file), 1, FrameLabels(note="from a script"))
    assert page.change(frame=1)["labels"]["note"] == "from a script"


def test_each_stream_of_a_file_has_its_labels_and_a_live_recording_has_none(file, tmp_path):
    library = Library([file], Recent(tmp_path), Uploads(1, 1, 1))
    files = LabelFiles(library, tmp_path / "user")
    id = library.first()
    streams = (Topic("/front", 5), Topic("/back/scan", 5))
    walls = open_recording(file)
    front, back = (replace(walls, topic=stream.name, topics=streams) for stream in streams)
    assert files.place(id, front).name == "walls.npz.lineseg.json"
    assert files.place(id, back).name == "walls.npz.back_scan.lineseg.json"
    live = LiveRecording(**{field.name: getattr(walls, field.name) for field in fields(walls)})
    assert files.known("live:1", live) is None


def test_a_failure_pack_brings_the_labels_of_its_frame(file, tmp_path):
    said = replace(FrameLabels.of(extract(open_recording(file)[2])), tags=("glass",), note="from her")
    write_pack(tmp_path / "door.zip", open_recording(file), 2, labels=said)
    library = Library([tmp_path / "door.zip"], Recent(tmp_path), Uploads(1, 1, 1))
    known = LabelFiles(library, tmp_path / "user").known(library.first(), open_recording(tmp_path / "door.zip"))
    assert known is not None
    assert known.of(2) == said
    assert not known.path.exists()
