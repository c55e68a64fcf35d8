"""Limits for the bodies of requests: their size, except for files, which have limits of their own, and their pace."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST = 4 * 1024 * 1024
FILES = ("/api/upload", "/api/sweep-table", "/api/lessons/file")
SILENT_SECONDS = 10.0
# In bytes a second.
SLOWEST = 4_000


class BodyLimit:
    """ASGI middleware. JSON grows about thirtyfold when it is parsed, so the limit is low."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        most = None if scope["path"] in FILES else LARGEST
        sentence = f"a request like this has at most {LARGEST} bytes; this one is longer"
        announced = Headers(scope=scope).get("content-length", "")
        if most is not None and announced.isdigit() and int(announced[:20]) > most:
            await JSONResponse({"message": sentence}, status_code=413)(scope, receive, send)
            return

        def arrived(size: int) -> None:
            if most is not None and size > most:
                raise HTTPException(413, sentence)

        await self._app(scope, _steady(receive, arrived), send)


def _steady(receive: Receive, arrived: Callable[[int], None]) -> Receive:
    """Answers 408 if nothing of the body comes for a while, or if it comes so slowly that it holds up others.

    arrived: called with the number of bytes that came.
    """
    size, begun, whole = 0, time.monotonic(), False

    async def steady() -> Message:
        nonlocal size, whole
        if whole:
            # Waits for the other side to leave.
            return await receive()
        try:
            message = await asyncio.wait_for(receive(), SILENT_SECONDS)
        except TimeoutError:
            raise HTTPException(408, f"nothing more of this came for {SILENT_SECONDS:g} s; send it again") from None
        whole = not message.get("more_body", False)
        size += len(message.get("body", b""))
        arrived(size)
        took = time.monotonic() - begun
        if not whole and took > SILENT_SECONDS and size < SLOWEST * took:
            raise HTTPException(
                408,
                f"this comes with less than {SLOWEST / 1000:g} kB/s; if it is a file, open it from the command line",
            )
        return message

    return steady
