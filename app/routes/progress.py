"""Slow work whose progress a page hears."""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import AsyncIterator, Callable
from typing import Any, TypeVar

from fastapi.responses import StreamingResponse
from starlette.exceptions import HTTPException

from lineseg.failing import sentence_of
from lineseg.readers import Cancelled, Progress

from .slow import SlowWork

T = TypeVar("T")
TELL_SECONDS = 0.1


def told_work(
    slow: SlowWork, work: Callable[[Progress], T], said: Callable[[T], dict[str, Any]], total: int = 0, failed: str = ""
) -> StreamingResponse:
    """Lines of JSON: the progress of the work, then what is said of its result, or why there is none.

    Closing the response stops the work. total: how much there is to do, as far as it is known before; failed: begins
    the reason.
    """
    return StreamingResponse(_lines(slow, work, said, total, failed), media_type="application/x-ndjson")


async def _lines(
    slow: SlowWork, work: Callable[[Progress], T], said: Callable[[T], dict[str, Any]], total: int, failed: str
) -> AsyncIterator[str]:
    stop, told = threading.Event(), {"done": 0, "total": total}

    def advance(done: int, total: int) -> None:
        if stop.is_set():
            raise Cancelled("nobody waits for it any more")
        told.update(done=done, total=total)

    try:
        done = slow.start(work, advance)
    except HTTPException as error:
        yield _line({"message": error.detail})
        return
    try:
        while not done.done():
            yield _line(told)
            await asyncio.wait([done], timeout=TELL_SECONDS)
        error = done.exception()
        yield _line(said(done.result()) if error is None else {"message": sentence_of(error, failed)})
    finally:
        stop.set()
        # Else an error that nobody asks for is logged.
        done.cancel()


def _line(message: dict[str, Any]) -> str:
    return json.dumps(message) + "\n"
