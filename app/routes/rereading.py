"""The socket of the panel "Read as": shows a recording under one Reading after another. The newest wins."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from collections.abc import Callable, Mapping

from fastapi import FastAPI
from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from lineseg import Recording
from lineseg.readers import Cancelled, Reading, format_of

from ..bounds import Count, Message, ReadingValues, RecordingId, sentence
from ..frame.state import account_told
from ..newest import Newest
from ..shelf.library import Library
from ..shelf.preview import first_lines, for_the_page, named_in, preview
from ..told.answers import Previewed
from ..view import reread
from .heard import text_from

log = logging.getLogger(__name__)


class Try(Message):
    """Read a recording in this way, for a look. job: by which the page knows the answer."""

    job: Count
    recording: RecordingId
    reading: ReadingValues


class Looker:
    """Reads in a thread of its own; a newer wish stops the reading under way."""

    def __init__(self, library: Library, send: Callable[[Mapping[str, object]], None]) -> None:
        self._library, self._send = library, send
        self._wanted = -1
        self._newest = Newest[Try]("preview", self._work)

    def look(self, wish: Try) -> None:
        self._wanted = wish.job
        self._newest.put(wish)

    def close(self) -> None:
        self._wanted = -1
        self._newest.close()

    def _work(self, wish: Try) -> None:
        try:
            answer = previewed(self._library, wish, lambda: self._wanted == wish.job)
        except Cancelled:
            return
        except Exception as error:
            log.exception("a preview of %s failed", wish.recording)
            answer = refused(self._library, wish, f"reading failed: {type(error).__name__}: {error}")
        self._send(answer)


def previewed(library: Library, wish: Try, wanted: Callable[[], bool]) -> Previewed:
    """The answer to a wish. Raises Cancelled once it is not `wanted`."""
    try:
        seen = preview(library, wish.recording, reread(Reading(), wish.reading), wanted)
    except (ValueError, OSError) as error:
        return refused(library, wish, str(error))
    recording = seen.recording
    return {
        "job": wish.job,
        "message": None,
        "named": [],
        "format": recording.format,
        "choices": _choices(recording),
        "lines": _lines(library, wish),
        "account": account_told(recording.account) if recording.account is not None else None,
        "scans": seen.points(),
        "whole": seen.whole,
    }


def _choices(recording: Recording) -> dict[str, list[str]]:
    lasers = recording.account.lasers if recording.account is not None else {}
    return {"topic": [topic.name for topic in recording.topics], **{name: list(each) for name, each in lasers.items()}}


def _lines(library: Library, wish: Try) -> list[str]:
    with contextlib.suppress(ValueError, OSError):
        return first_lines(library.path(wish.recording))
    return []


def refused(library: Library, wish: Try, message: str) -> Previewed:
    """The answer that says why a recording cannot be read in this way."""
    format = ""
    with contextlib.suppress(ValueError, OSError):
        format = format_of(library.path(wish.recording))
    return {
        "job": wish.job,
        "message": for_the_page(message),
        "named": named_in(message),
        "format": format,
        "choices": {},
        "lines": _lines(library, wish),
        "account": None,
        "scans": [],
        "whole": True,
    }


def add_rereading(app: FastAPI, library: Library) -> None:
    """The socket /api/reading."""

    @app.websocket("/api/reading")
    async def reading_socket(socket: WebSocket) -> None:
        await socket.accept()
        loop = asyncio.get_running_loop()

        def send(answer: Mapping[str, object]) -> None:
            with contextlib.suppress(Exception):
                asyncio.run_coroutine_threadsafe(socket.send_text(json.dumps(answer)), loop).result(30)

        looker = Looker(library, send)
        try:
            with contextlib.suppress(WebSocketDisconnect, RuntimeError):
                while True:
                    text = await text_from(socket)
                    try:
                        looker.look(Try.model_validate_json(text))
                    except ValidationError as error:
                        await socket.send_text(json.dumps({"job": -1, "message": sentence(error)}))
        finally:
            await asyncio.to_thread(looker.close)
