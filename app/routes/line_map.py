"""Routes of the line map: the lines on the screen, and the map as a file."""

from __future__ import annotations

import base64
import math
from typing import TYPE_CHECKING, Any

from fastapi import FastAPI
from fastapi.responses import StreamingResponse
from starlette.exceptions import HTTPException

from lineseg import Survey
from lineseg.readers import Progress
from lineseg.writers.line_maps import MAP_WRITERS, drawings

from ..made import about_of
from ..session.sessions import Sessions
from ..session.shown import Shown
from ..shelf.library import Library
from ..told.answers import MapLines
from .progress import told_work
from .slow import SlowWork

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

AT_ONCE = 2
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
        tab = sessions.get(session)
        known = tab.known(shown) if tab is not None else (None, None)
        return _made(slow, shown, *known, library.label(shown.view.recording), to)


def _made(
    slow: SlowWork, shown: Shown, lines: Survey | None, known: LineMap | None, label: str, to: str
) -> StreamingResponse:
    """Make the map, unless it is known, and answer with the progress and the file."""
    view, recording = shown.view, shown.recording

    def work(advance: Progress) -> dict[str, Any]:
        from lineseg.line_map import line_map  # takes a while to import, and few want a map

        found = known if known is not None else line_map(recording, view.params, lines, progress=advance)
        content = MAP_WRITERS[to](found, f"{label}, line map", about_of(recording, view.method, view.params))
        suffix = f"metres.{to}" if to == "geojson" else to
        return {"name": f"{label}_map.{suffix}", "content": base64.b64encode(content).decode(), "text": found.text}

    return told_work(slow, work, lambda file: file)
