"""/api/scans/{name}: any program may push scans, one JSON object each, by POST or over a WebSocket."""

from __future__ import annotations

import contextlib
import json
import time
from typing import Any

from fastapi import FastAPI, Request
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.websockets import WebSocket, WebSocketDisconnect

from lineseg.readers.laser_scan import decode_json

from ..live.hub import Live, TooManySourcesError
from ..live.source import Source
from ..shelf.library import Library
from .body import body_of

LARGEST = 2 * 1024 * 1024
MOST_BEAMS = 100_000
MOST_A_SECOND = 200.0
TOO_MANY = 1013
COMPLAIN_EVERY = 1.0


class TooFastError(ValueError):
    """Scans arrive too fast."""


class Pace:
    """A token bucket: at most MOST_A_SECOND for each name, with bursts of the same size."""

    def __init__(self) -> None:
        self._left: dict[str, tuple[float, float]] = {}

    def step(self, id: str) -> None:
        now = time.monotonic()
        left, since = self._left.get(id, (MOST_A_SECOND, now))
        left = min(MOST_A_SECOND, left + MOST_A_SECOND * (now - since))
        self._left[id] = (max(left - 1, 0.0), now)
        if left < 1:
            raise TooFastError(f"this scan was dropped; send at most {MOST_A_SECOND:g} scans a second")


def add_push(app: FastAPI, library: Library) -> None:
    """Routes of /api/scans."""
    pace = Pace()

    @app.post("/api/scans/{name}")
    async def push(request: Request, name: str) -> dict[str, Any]:
        try:
            source = _source(library, name)
            pace.step(source.id)
            await run_in_threadpool(_take, source, await body_of(request, LARGEST, "a scan takes"))
        except (TooManySourcesError, TooFastError) as error:
            raise HTTPException(429, str(error)) from None
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return {"recording": source.id, "kept": source.ring.total - source.ring.dropped, "dropped": source.ring.dropped}

    @app.websocket("/api/scans/{name}")
    async def stream(socket: WebSocket, name: str) -> None:
        await socket.accept()
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            try:
                source = _source(library, name)
            except ValueError as error:
                await socket.send_json({"error": str(error)})
                await socket.close(TOO_MANY if isinstance(error, TooManySourcesError) else 1008)
                return
            complained = 0.0
            while True:
                message = await socket.receive()
                if message["type"] == "websocket.disconnect":
                    return
                try:
                    pace.step(source.id)
                    await run_in_threadpool(_take, source, message.get("text") or message.get("bytes") or "")
                except ValueError as error:
                    if time.monotonic() - complained >= COMPLAIN_EVERY:
                        complained = time.monotonic()
                        await socket.send_json({"error": str(error)})


def _source(library: Library, name: str) -> Source:
    live: Live = library.live
    known = live.get(f"live:{name}")
    source = live.pushed(name)
    if known is None:
        library.changed()
    return source


def _take(source: Source, text: str | bytes) -> None:
    """Add the scan in one message. Raises ValueError if it is wrong; the source counts refused messages."""
    try:
        if len(text) > LARGEST:
            raise ValueError(f"the message has {len(text)} bytes; send at most {LARGEST}")
        try:
            message = json.loads(text)
        except (ValueError, RecursionError):
            raise ValueError("this is not JSON; send a LaserScan as one JSON object") from None
        scan = decode_json(message)
        if len(scan.ranges) > MOST_BEAMS:
            raise ValueError(f"the scan has {len(scan.ranges)} beams; send at most {MOST_BEAMS}")
        source.take(scan)
    except ValueError as error:
        source.refuse(f"a message was refused: {error}")
        raise
