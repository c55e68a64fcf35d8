"""Uploads, recent files and downloads."""

from __future__ import annotations

import json
import shutil
import threading
from pathlib import Path

import httpx
import pytest
from lineseg_app.server import Settings
from lineseg_app.shelf.recent import MOST, Recent
from lineseg_app.shelf.uploads import safe_name
from live import Address, Page, page_of, serving
from waiting import SECONDS

from lineseg import Params
from lineseg.readers import Reading


def test_an_upload_is_offered_and_opens(server: Address, page: Page, recordings: Path):
    page.hello()
    answer = server.upload("from home.npz", (recordings / "corner.npz").read_bytes())
    id = answer.json()["recording"]
    offered = page.hear_a("recordings")["recordings"]
    assert {"id": id, "label": "from home.npz", "group": "Uploads", "missing": False, "reading": {}} in offered
    assert page.change(recording=id)["label"] == "from home.npz"


def test_a_broken_upload_is_an_error_and_the_old_picture_stays(server: Address, page: Page):
    page.hello(frame=2)
    id = server.upload("broken.npz", b"PK\x03\x04 not a zip").json()["recording"]
    error = page.refused(recording=id)
    assert error["where"] == "recording"
    assert "broken.npz" in error["message"]
    state = page.change(params={"epsilon": 0.04})
    assert (state["label"], state["frame"]) == ("walls.npz", 2)
    with page_of(server) as other:
        other.hello()
        assert id not in [entry["id"] for entry in other.welcome["recordings"]]


def test_an_upload_beyond_the_limit_is_refused_before_it_is_sent(server: Address):
    answer = server.upload("huge.bag", b"x" * 1_000_001)
    assert answer.status_code == 413
    assert "huge.bag is larger than 1 MB" in answer.json()["message"]


def test_an_upload_that_hides_its_size_is_cut_off_at_the_limit(server: Address):
    answer = server.upload("huge.bag", (b"x" * 100_000 for _ in range(20)))  # pyright: ignore[reportArgumentType]
    assert answer.status_code == 413


def test_an_empty_upload_is_refused(server: Address):
    answer = server.upload("nothing.bag", b"")
    assert (answer.status_code, answer.json()["message"]) == (400, "nothing.bag is empty")


@pytest.mark.parametrize(
    ("name", "kept"),
    [
        ("a.bag", "a.bag"),
        ("../../etc/passwd", "passwd"),
        ("C:\\Users\\me\\scan.log", "scan.log"),
        (".hidden", "hidden"),
        ("..", "recording"),
        ("", "recording"),
        ("a\x00b\nc.npz", "abc.npz"),
        ("Flur Süd.npz", "Flur Süd.npz"),
        ('<img src="x">.npz', "img src=x.npz"),
    ],
)
def test_names_of_uploads_are_made_harmless(name: str, kept: str):
    assert safe_name(name) == kept


def test_a_long_name_keeps_its_suffix():
    name = safe_name("ä" * 500 + ".log.gz")
    assert name.endswith(".log.gz")
    assert len(name.encode()) <= 120


def test_the_oldest_uploads_make_room_and_all_are_removed_in_the_end(tmp_path, recordings, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    content = (recordings / "corner.npz").read_bytes()
    with serving(Settings(data_folder=tmp_path / "data", upload_number=2)) as server, page_of(server) as page:
        ids = [server.upload(f"{k}.npz", content).json()["recording"] for k in range(3)]
        page.hello()
        offered = [entry["id"] for entry in page.welcome["recordings"] if entry["group"] == "Uploads"]
        assert offered == [ids[2], ids[1]]
        assert len(list(tmp_path.glob("lineseg-*/*/*.npz"))) == 2
        assert "drop the file" in page.refused(recording=ids[0])["message"]
    assert not list(tmp_path.glob("lineseg-*"))


def test_files_of_the_command_line_are_remembered(tmp_path, recordings):
    files = tmp_path / "mine.npz", tmp_path / "gone.npz"
    for file in files:
        shutil.copy(recordings / "walls.npz", file)
    with (
        serving(Settings(files=files, data_folder=tmp_path / "data")),
        serving(Settings(data_folder=tmp_path / "data")) as server,
        page_of(server) as page,
    ):
        page.hello()
        recent = {entry["label"]: entry for entry in page.welcome["recordings"] if entry["group"] == "Recent"}
        assert {label: entry["missing"] for label, entry in recent.items()} == {"mine.npz": False, "gone.npz": False}
        assert page.change(recording=recent["mine.npz"]["id"])["label"] == "mine.npz"
        files[1].unlink()
        with page_of(server) as later:
            later.hello()
            missing = [entry["label"] for entry in later.welcome["recordings"] if entry["missing"]]
            assert missing == ["gone.npz"]
            assert "no longer" in later.refused(recording=recent["gone.npz"]["id"])["message"]


def test_recent_files_are_few_and_newest_first(tmp_path):
    recent = Recent(tmp_path)
    for k in range(MOST + 5):
        recent.add(tmp_path / f"{k}.bag")
    recent.add(tmp_path / "7.bag")
    paths = Recent(tmp_path).paths()
    assert len(paths) == MOST
    assert [path.name for path in paths[:2]] == ["7.bag", f"{MOST + 4}.bag"]


def test_recent_files_keep_how_they_were_read(tmp_path):
    recent = Recent(tmp_path)
    recent.add(tmp_path / "a.csv")
    recent.remember(tmp_path / "a.csv", Reading(unit="mm", frames="2:9"))
    recent.add(tmp_path / "b.csv")
    later = Recent(tmp_path)
    assert [path.name for path in later.paths()] == ["b.csv", "a.csv"]
    assert later.reading(tmp_path / "a.csv") == Reading(unit="mm", frames="2:9")
    assert later.reading(tmp_path / "b.csv") == Reading()


@pytest.mark.parametrize("content", ["", "{", "{}", "[1, null]", "\x00"])
def test_a_damaged_list_of_recent_files_is_an_empty_one(tmp_path, content):
    (tmp_path / "recent.json").write_text(content)
    assert Recent(tmp_path).paths() == []


def test_an_unwritable_folder_does_not_stop_the_server(tmp_path):
    (tmp_path / "file").write_text("")
    recent = Recent(tmp_path / "file")
    recent.add(tmp_path / "a.bag")
    assert [path.name for path in recent.paths()] == ["a.bag"]


@pytest.mark.parametrize("to", ["ros1", "ros2"])
def test_thresholds_survive_export_and_import(server: Address, to: str):
    text = server.get("/api/params", params={"to": to, "epsilon": 0.045, "seed_points": 8}).text
    assert server.post("/api/params", content=text).json()["params"] == pytest.approx(
        vars(Params(epsilon=0.045, seed_points=8))
    )


def test_an_exported_file_for_a_node_names_the_recording(server: Address, page: Page):
    page.hello()
    page.change(frame=0)
    exported = server.get("/api/params", params={"session": page.welcome["session"], "to": "ros2"}).text
    assert exported.splitlines()[0].endswith("set for walls.npz.")


@pytest.mark.parametrize(
    ("query", "named"),
    [("to=xml", "xml"), ("epsilon=-1", "epsilon"), ("epsilon=wide", "epsilon"), ("gamma=1", "gamma")],
)
def test_an_impossible_export_gets_a_sentence(server: Address, query: str, named: str):
    answer = server.get(f"/api/params?{query}")
    assert answer.status_code == 400
    assert named in answer.json()["message"]


@pytest.mark.parametrize("text", [b"", b"\xff\xfe", b"<launch>", b"[1, 2", b"epsilon: wide"])
def test_an_impossible_import_gets_a_sentence(server: Address, text: bytes):
    answer = server.post("/api/params", content=text)
    assert answer.status_code == 400
    assert "\n" not in answer.json()["message"].strip()


def test_an_import_of_a_whole_film_is_refused(server: Address):
    assert server.post("/api/params", content=b" " * 300_000).status_code == 413


def test_segments_of_the_whole_recording_come_as_a_file(server: Address, page: Page):
    page.hello()
    page.change(params={"min_length": 1.0}, frame=2)
    answer = server.get("/api/segments", params={"session": page.welcome["session"], "to": "jsonl"})
    rows = [json.loads(line) for line in answer.text.splitlines()]
    assert [row["frame"] for row in rows] == [0, 1, 2, 3, 4]
    assert all(len(row["segments"]) == 1 for row in rows)
    assert "walls.npz.jsonl" in answer.headers["content-disposition"]


def test_segments_of_an_unknown_session_are_not_found(server: Address):
    assert server.get("/api/segments?session=nobody").status_code == 404


def test_a_file_is_read_once_for_all_tabs(server: Address, recordings: Path):
    content = (recordings / "walls.npz").read_bytes()
    id = server.upload("shared.npz", content).json()["recording"]
    labels: list[str] = []

    def look() -> None:
        with page_of(server) as page:
            labels.append(page.hello(recording=id)["label"])

    threads = [threading.Thread(target=look) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert labels == ["shared.npz"] * 4


def test_the_server_survives_a_client_that_goes_away_while_uploading(server: Address):
    def interrupted():
        yield b"x" * 1000
        raise ConnectionAbortedError

    with pytest.raises(ConnectionAbortedError), httpx.Client(trust_env=False, timeout=SECONDS) as client:
        client.post(f"{server.http}/api/upload?name=half.bag", content=interrupted())
    assert server.get("/").status_code == 200


def test_samples_come_first_and_lessons_in_their_order(tmp_path: Path):
    with serving(Settings(data_folder=tmp_path)) as server, page_of(server) as page:
        page.hello()
        labels = [(entry["group"], entry["label"]) for entry in page.welcome["recordings"]]
        assert labels[:2] == [("Samples", "Hallway (simulated)"), ("Samples", "Laboratory (simulated)")]
        lessons = [label for group, label in labels if group == "Lessons"]
        assert lessons[0] == "1 perfect corner"
        assert len(lessons) == 9
