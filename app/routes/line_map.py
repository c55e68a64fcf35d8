"""Routes of the line map: the lines on the screen, and the map as a file."""

from __future__ import annotations

import asyncio
import base64
import json
import math
import threading
from collections.abc import AsyncIterator
from typing import Any

from fastapi import FastAPI
from fastapi.responses import StreamingResponse
from starlette.exceptions import HTTPException

from lineseg.failing import sentence_of
from lineseg.line_map import line_map
from lineseg.readers import Cancelled
from lineseg.writers.line_maps import MAP_WRITERS, drawings

from ..made import about_of
from ..session.sessions import Sessions
from ..session.shown import Shown
from ..shelf.library import Library
from ..told.answers import MapLines
from .slow import SlowWork

AT_ONCE = 2
TELL_SECONDS = 0.1
MISSING = 501


def add_line_map(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """Routes of /api/line-map."""
    slow = SlowWork("line maps", AT_ONCE, math.inf)

    @app.get("/api/line-map")
    def lines(session: str = "") -> MapLines:
        tab = sessions.get(session)
        found = tab.line_map if tab is not None else None
        if found is None:
            raise HTTPException(404, "this tab shows no line map; switch its layer on in the world")
        ends = found.ends.round(4).tolist()
        return {"text": found.text, "ends": ends, "sigma": found.sigma.round(5).tolist(), "seen": found.seen.tolist()}

    @app.post("/api/line-map")
    async def file(session: str = "", to: str = "geojson") -> StreamingResponse:
        shown = sessions.shown(session)
        if to not in MAP_WRITERS:
            raise HTTPException(400, f"a map cannot be written as {to[:20]!r}; choose from {', '.join(MAP_WRITERS)}")
        if to == "dxf":
            try:
                drawings()
            except ValueError as error:
                raise HTTPException(MISSING, str(error)) from None
        rows = _made(slow, shown, library.label(shown.view.recording), to)
        return StreamingResponse(rows, media_type="application/x-ndjson")


async def _made(slow: SlowWork, shown: Shown, label: str, to: str) -> AsyncIterator[str]:
    """Lines of JSON: the progress, then the file or why there is none. Closing the response stops the work."""
    stop, told = threading.Event(), {"done": 0, "total": 0}

    def advance(done: int, total: int) -> None:
        if stop.is_set():
            raise Cancelled("the line map was stopped")
        told.update(done=done, total=total)

    def work() -> dict[str, Any]:
        view = shown.view
        found = line_map(shown.recording, view.params, progress=advance)
        content = MAP_WRITERS[to](found, f"{label}, line map", about_of(shown.recording, view.method, view.params))
        suffix = f"metres.{to}" if to == "geojson" else to
        name = f"{label}_map.{suffix}"
        return {"name": name, "content": base64.b64encode(content).decode(), "text": found.text}

    try:
        done = slow.start(work)
    except HTTPException as error:
        yield _line({"message": error.detail})
        return
    try:
        while not done.done():
            yield _line(told)
            await asyncio.wait([done], timeout=TELL_SECONDS)
        error = done.exception()
        yield _line(done.result() if error is None else {"message": sentence_of(error, "")})
    finally:
        stop.set()


def _line(message: dict[str, Any]) -> str:
    return json.dumps(message) + "\n"
