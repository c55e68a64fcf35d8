"""Downloads: the frame as a drawing, a page or a failure pack, the lesson as a page, the segments of the recording."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Literal

from fastapi import FastAPI, Request
from fastapi.responses import Response, StreamingResponse
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import EXTRACTORS, Extraction, Scan, write_pack
from lineseg.writers import SEGMENT_WRITERS, figure_svg, figure_title, segment_lines

from ..handout.handouts import frame_page, lesson_page
from ..made import about_of
from ..scene.drawing import step_marks
from ..session.sessions import Sessions
from ..session.shown import Shown
from ..shelf.label_files import LabelFiles
from ..shelf.library import Library
from .attachment import attachment
from .body import body_of
from .slow import SlowWork

LONGEST_NOTE = 64 * 1024
# A large frame with all its decisions takes some seconds.
HANDOUTS_AT_ONCE, HANDOUT_SECONDS = 2, 180.0
SEGMENT_TYPES = {"jsonl": "application/x-ndjson", "csv": "text/csv", "geojson": "application/geo+json"}


def add_export(app: FastAPI, library: Library, sessions: Sessions, files: LabelFiles) -> None:
    """Routes of /api that export what a tab shows."""
    handouts = SlowWork("interactive pages", HANDOUTS_AT_ONCE, HANDOUT_SECONDS)

    def named(shown: Shown, suffix: str) -> dict[str, str]:
        """Headers for a file of one frame, with its number."""
        return attachment(f"{library.label(shown.view.recording)}_{shown.view.frame}", suffix)

    @app.get("/api/figure")
    def figure(session: str = "") -> Response:
        shown = sessions.shown(session)
        view, found = shown.view, shown.found
        title = figure_title(shown.recording, shown.position, EXTRACTORS[view.method].label)
        marks = near = None
        if view.step is not None:
            title += f", decision {view.step + 1} of {len(found.trace)}"
            marks, near = step_marks(view, shown.recording, found)
        account = shown.recording.account
        reading = None if account is None else account.given
        drawing = figure_svg(found.scan, found.extraction, title, view.params, marks, near, reading)
        return Response(drawing, media_type="image/svg+xml", headers=named(shown, "svg"))

    @app.post("/api/pack")
    async def pack(request: Request, session: str = "") -> Response:
        shown = sessions.shown(session)
        body = await body_of(request, LONGEST_NOTE, "a note has")
        try:
            note = body.decode()
        except UnicodeDecodeError:
            raise HTTPException(400, "this note is not UTF-8 text; send it as UTF-8") from None
        known, made = files.known(shown.view.recording, shown.recording), io.BytesIO()
        said = known and known.of(shown.view.frame)
        await run_in_threadpool(write_pack, made, shown.recording, shown.position, shown.view.params, note, said)
        return Response(made.getvalue(), media_type="application/zip", headers=named(shown, "zip"))

    @app.get("/api/handout")
    async def handout(session: str = "", what: Literal["frame", "lesson"] = "frame") -> Response:
        """The lesson or the frame as a page that stands alone."""
        shown = sessions.shown(session)
        view = shown.view
        if what == "lesson":
            lesson = await run_in_threadpool(library.lessons.find, view.lesson) if view.lesson else None
            if lesson is None:
                raise HTTPException(404, "no lesson is open in this tab; open one in Learn first")
            page = await handouts.run(lesson_page, library.lessons, lesson)
            return Response(page, media_type="text/html", headers=attachment(lesson.id.rpartition("/")[2], "html"))
        about = (shown.recording, view.frame, library.label(view.recording), view.method, view.params, view.step)
        try:
            page = await handouts.run(frame_page, *about)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return Response(page, media_type="text/html", headers=named(shown, "html"))

    _add_segments(app, library, sessions)


def _add_segments(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """The segments of all frames."""

    @app.get("/api/segments")
    async def segments(session: str = "", to: str = "jsonl") -> StreamingResponse:
        shown = sessions.shown(session)
        if to not in SEGMENT_WRITERS:
            raise HTTPException(400, f"segments cannot be written as {to!r}; choose from {', '.join(SEGMENT_WRITERS)}")
        if shown.recording.partial:
            raise HTTPException(409, "the file is still being read; export its segments when all of it is")
        # Readers of GeoJSON expect degrees, so the name says that these are not.
        suffix = f"metres.{to}" if to == "geojson" else to
        headers = attachment(library.label(shown.view.recording), suffix)
        about = about_of(shown.recording, shown.view.method, shown.view.params)
        lines = segment_lines(to, _rows(shown), about=about)
        return StreamingResponse(lines, media_type=SEGMENT_TYPES[to], headers=headers)


def _rows(shown: Shown) -> Iterator[tuple[int, Scan, Extraction]]:
    """Every frame under the thresholds on the screen."""
    extract = EXTRACTORS[shown.view.method].extract
    for frame, scan in enumerate(shown.recording):
        yield shown.recording.number(frame), scan, extract(scan, shown.view.params)
