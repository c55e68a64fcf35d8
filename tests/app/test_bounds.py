"""Nothing that comes from outside grows, lasts or blocks without bound."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import json
import os
import shutil
import socket
import sqlite3
import threading
import time
import weakref
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest
from lineseg_app.routes.progress import told_work
from lineseg_app.routes.slow import SlowWork
from lineseg_app.scene.portless import PortlessServer
from lineseg_app.server import Settings
from lineseg_app.session.session import Session
from lineseg_app.session.sessions import SessionLimits
from lineseg_app.shelf.scratch import Scratch, remove_leftovers
from lineseg_app.shelf.uploads import Uploads
from live import Address, Page, page_of, serving
from starlette.exceptions import HTTPException
from waiting import SECONDS, eventually

from lineseg import open_recording
from lineseg.readers import Progress
from lineseg.unfinished import FILES, FOLDERS, LOCK


async def bytes_of(content: bytes) -> AsyncIterator[bytes]:
    yield content


def test_uploads_go_on_after_the_disk_refused_and_after_their_folder_was_removed(monkeypatch: pytest.MonkeyPatch):
    shelf = Uploads(1000, 5, 1000)

    def store() -> Path:
        return asyncio.run(shelf.receive("a.npz", None, bytes_of(b"x"))).path

    def full(*_, **__) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "mkdir", full)
        for _ in range(6):
            with pytest.raises(OSError, match="No space left"):
                store()
    shutil.rmtree(store().parent.parent)
    assert store().read_bytes() == b"x"
    shelf.close()


def test_slow_work_is_limited_in_number_and_time_and_counts_until_it_has_ended():
    end = threading.Event()
    work = SlowWork("robots", at_once=2, seconds=0.05)

    async def run() -> None:
        answers = await asyncio.gather(*(work.run(end.wait) for _ in range(3)), return_exceptions=True)
        assert [answer.status_code for answer in answers if isinstance(answer, HTTPException)] == [504, 504, 429]
        with pytest.raises(HTTPException, match="2 robots are under way"):
            await work.run(end.wait)
        end.set()
        while work.running:
            await asyncio.sleep(0.01)
        assert await work.start(lambda: "done") == "done"

    asyncio.run(run())


def test_told_work_ends_without_a_word_when_its_response_is_closed(caplog: pytest.LogCaptureFixture):
    slow = SlowWork("line maps", at_once=1, seconds=SECONDS)

    def endless(advance: Progress) -> dict:
        while True:
            advance(1, 2)
            time.sleep(0.001)

    async def run() -> None:
        lines: Any = told_work(slow, endless, dict).body_iterator
        assert set(json.loads(await anext(lines))) == {"done", "total"}
        await lines.aclose()
        while slow.running:
            await asyncio.sleep(0.01)
        gc.collect()

    asyncio.run(run())
    assert caplog.records == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_is_refused_instead_of_waited_for(tmp_path: Path):
    os.mkfifo(tmp_path / "pipe.npz")
    with pytest.raises(ValueError, match=r"pipe\.npz is neither a file nor a folder.*save it as a file first"):
        open_recording(tmp_path / "pipe.npz")


def test_the_body_of_a_request_is_limited_announced_or_not(server: Address):
    def film():
        for _ in range(80):
            yield b'"' + (1 << 16) * b"x"

    for content in (film(), b"".join(film())):
        answer = server.post("/api/robot/params", content=content, headers={"Content-Type": "application/json"})
        assert answer.status_code == 413
        assert "at most" in answer.json()["message"]


def test_a_message_that_is_not_text_gets_a_sentence(page: Page):
    page.hello()
    page._socket.send(b"\xff\x00")
    assert "invalid JSON" in page.hear_a("error")["message"]
    page._socket.send(b'{"type": "view", "rev": 1, "patch": {"frame": 1}}')
    assert page.drawn(1)["state"]["frame"] == 1


ODD = [
    (r'{"type": "view", "rev": 1, "patch": {"topic": "\ud800"}}', "no laser array '\N{REPLACEMENT CHARACTER}'"),
    (r'{"type": "link", "rev": 1, "patch": {"\udfff": 1}}', "extra inputs are not permitted"),
    ('{"type": "follow", "id": "ß"}', "is gone"),
    ('{"type": "c\\nel"}', "input tag 'c el'"),
    ('{"type": "view", "rev": 1, "patch": {"frame": 1' + 5000 * "0" + "}}", "number out of range"),
    ('{"type": "link", "rev": 1, "patch": {"reading": {"skip_columns": ' + 400 * "9" + "}}}", "skip_columns is 999"),
    (60_000 * "[", "recursion limit"),
]


@pytest.mark.parametrize(("text", "sentence"), ODD, ids=[text[:40] for text, _ in ODD])
def test_an_odd_message_gets_one_line_and_the_tab_goes_on(page: Page, text: str, sentence: str):
    page.hello(session="é", follow="\N{SNOWMAN}")
    page._socket.send(text)
    message = page.heard("error", lambda error: sentence in error["message"])["message"]
    assert "\n" not in message
    page.ask(frame=1)
    page.until(lambda state: state["frame"] == 1)


TOPICS = "CREATE TABLE topics(id INTEGER, name TEXT, type TEXT, serialization_format TEXT)"
SCANS = "INSERT INTO topics VALUES (1, '/scan', 'sensor_msgs/msg/LaserScan', 'cdr')"
NUMBERS = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)"
HUGE = "zeroblob(900000000)"
ENDLESS_VIEW = (
    TOPICS,
    SCANS,
    f"CREATE VIEW messages AS {NUMBERS} SELECT i id, 1 topic_id, i timestamp, i data FROM n",
)
HUGE_VIEW = (f"CREATE VIEW topics AS SELECT 1 id, {HUGE} name, '' type, '' serialization_format",)
HUGE_MESSAGE = (
    *(TOPICS, SCANS, f"CREATE TABLE messages(id, topic_id, timestamp, data BLOB AS ({HUGE}))"),
    "INSERT INTO messages(id, topic_id, timestamp) VALUES (1, 1, 1)",
)


@pytest.mark.parametrize(
    ("statements", "sentence"),
    [(ENDLESS_VIEW, "messages is a view"), (HUGE_VIEW, "topics is a view"), (HUGE_MESSAGE, "too big")],
    ids=["endless view", "huge view", "huge message"],
)
def test_a_bag_whose_query_would_not_end_or_would_fill_the_memory_is_refused(
    tmp_path: Path, statements: tuple[str, ...], sentence: str
):
    with contextlib.closing(sqlite3.connect(tmp_path / "trap.db3")) as database:
        for statement in statements:
            database.execute(statement)
        database.commit()
    with pytest.raises(ValueError, match=sentence):
        open_recording(tmp_path / "trap.db3")


def test_folders_of_killed_processes_are_removed_at_the_next_start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    ours = Scratch()
    ours.folder.joinpath("upload.npz").write_bytes(b"x")
    left = tmp_path / f"{FOLDERS}left"
    left.mkdir()
    (left / LOCK).touch()
    foreign = tmp_path / "lineseg-other"
    foreign.mkdir()
    (tmp_path / "open-abc.html").touch()
    (tmp_path / "labels").mkdir()
    parts = [folder / FILES.replace("*", "left") for folder in (tmp_path, tmp_path / "labels")]
    for part in parts:
        part.touch()
    for path in (ours.folder, left, foreign, tmp_path / "open-abc.html", *parts):
        os.utime(path, (0, 0))
    remove_leftovers(tmp_path)
    (tmp_path / "labels").rmdir()
    assert set(tmp_path.iterdir()) == {ours.folder, foreign}
    shutil.rmtree(ours.folder)
    assert ours.folder.is_dir()
    ours.close()
    assert set(tmp_path.iterdir()) == {foreign}


def test_tabs_that_are_gone_leave_nothing(tmp_path: Path):
    kinds = (Session, PortlessServer)
    # Kept until the end: the id of one that goes may be given to another.
    others = [thing for thing in gc.get_objects() if isinstance(thing, kinds)]
    known = set(map(id, others))
    with serving(Settings(data_folder=tmp_path, sessions=SessionLimits(grace=1.0))) as server:
        with page_of(server) as page:
            page.hello()
            things = (thing for thing in gc.get_objects() if isinstance(thing, kinds) and id(thing) not in known)
            there = [weakref.ref(thing) for thing in things]
        assert len(there) >= len(kinds)

        def left() -> list[object]:
            # The server does this too, once, and may have done it while something still referred to the tab.
            gc.collect()
            return [thing() for thing in there if thing() is not None]

        eventually(lambda: not left(), "what belongs to the tab to go", left, every=0.1)


def test_whoever_leaves_in_the_middle_of_a_request_leaves_no_mistake_in_the_log(server: Address, caplog):
    head = f"POST /api/params HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Length: 99\r\n\r\nhalf"
    with socket.create_connection(("127.0.0.1", server.port)) as caller:
        caller.sendall(head.encode())
        time.sleep(0.2)
    time.sleep(0.2)
    assert server.get("/api/lessons").status_code == 200
    assert [record.message for record in caplog.records if record.levelname == "ERROR"] == []
