"""Nothing that comes from outside grows, lasts or blocks without bound."""

from __future__ import annotations

import asyncio
import os
import shutil
import threading
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
from lineseg_app.routes.slow import SlowWork
from lineseg_app.shelf import uploads
from lineseg_app.shelf.uploads import TooManyError, TooSlowError, Uploads
from live import Address, Page
from starlette.exceptions import HTTPException

from lineseg import open_recording


async def nothing() -> AsyncIterator[bytes]:
    yield b"begun"
    await asyncio.Event().wait()


async def dripping() -> AsyncIterator[bytes]:
    while True:
        await asyncio.sleep(0.01)
        yield b"."


async def bytes_of(content: bytes) -> AsyncIterator[bytes]:
    yield content


@pytest.mark.parametrize("chunks", [nothing, dripping])
def test_uploads_that_do_not_proceed_make_room_for_others(monkeypatch: pytest.MonkeyPatch, chunks):
    monkeypatch.setattr(uploads, "SILENT_SECONDS", 0.1)
    shelf = Uploads(1000, 5, 1000)

    async def run() -> None:
        slow = [asyncio.create_task(shelf.receive("slow.npz", None, chunks())) for _ in range(4)]
        await asyncio.sleep(0)
        with pytest.raises(TooManyError):
            await shelf.receive("next.npz", None, bytes_of(b"x"))
        assert all(isinstance(end, TooSlowError) for end in await asyncio.gather(*slow, return_exceptions=True))
        assert (await shelf.receive("next.npz", None, bytes_of(b"x"))).size == 1

    asyncio.run(run())
    shelf.close()


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
        assert await work.run(lambda: "done") == "done"

    asyncio.run(run())


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
