"""Routes for rerun: record what a tab shows, download the recording, and rerun's web viewer."""

from __future__ import annotations

import math
import secrets
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fastapi import FastAPI
from fastapi.responses import FileResponse, StreamingResponse
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg.failing import sentence_of

from ..places import data_folder
from ..session.sessions import Sessions
from ..shelf.library import Library
from ..shelf.scratch import Scratch
from .attachment import attachment
from .progress import told_work
from .slow import SlowWork

if TYPE_CHECKING:
    from ..rerun.record import Run

MOST_KEPT = 8
AT_ONCE = 2
MISSING = 501


class RerunFiles:
    """A folder with the newest few recordings, and with the files of the viewer once requested."""

    def __init__(self) -> None:
        self._scratch = Scratch()
        self._recording = SlowWork("recordings for rerun", AT_ONCE, math.inf)
        self._kept: list[str] = []
        self._unpacking = threading.Lock()

    def close(self) -> None:
        self._scratch.close()

    def recorded(self, id: str) -> Path | None:
        file = self._scratch.folder / f"{id}.rrd"
        return file if id in self._kept and file.exists() else None

    def viewer(self, name: str) -> Path:
        """A file of the viewer; blocks while the files are unpacked."""
        from ..rerun.viewer import unpack

        with self._unpacking:
            if not (self._scratch.folder / "unpacked").exists():
                unpack(self._scratch.folder)
                (self._scratch.folder / "unpacked").touch()
        return self._scratch.folder / name

    def record(self, run: Run) -> StreamingResponse:
        """Record, and answer with the progress and the id of the recording."""
        from ..rerun.record import save

        id = secrets.token_urlsafe(12)
        file = self._scratch.folder / f"{id}.rrd"

        def recorded(_: None) -> dict[str, Any]:
            self._keep(id)
            return {"recording": id, "bytes": file.stat().st_size}

        return told_work(
            self._recording, lambda advance: save(run, file, advance), recorded, len(run.frames), "recording failed"
        )

    def _keep(self, id: str) -> None:
        self._kept.append(id)
        while len(self._kept) > MOST_KEPT:
            (self._scratch.folder / f"{self._kept.pop(0)}.rrd").unlink(missing_ok=True)


def add_rerun(app: FastAPI, library: Library, sessions: Sessions) -> RerunFiles:
    """Routes of /api/rerun and /rerun/; the caller must close the returned object."""
    files = RerunFiles()

    @app.post("/api/rerun")
    async def record(session: str = "", steps: bool = False) -> StreamingResponse:
        shown = sessions.shown(session)
        try:
            from ..rerun.record import Run
        except ModuleNotFoundError as error:
            raise HTTPException(MISSING, str(error)) from None
        view, recording = shown.view, shown.recording
        frames = range(shown.position, shown.position + 1) if steps else range(len(recording))
        run = Run(recording, library.label(view.recording), view.method, view.params, frames, steps)
        return files.record(run)

    @app.get("/api/rerun/{id}.rrd")
    async def recorded(id: str, name: str | None = None) -> FileResponse:
        file = files.recorded(id)
        if file is None:
            raise HTTPException(
                404, f"only the newest {MOST_KEPT} recordings are kept, and this one is gone; record it again"
            )
        headers = attachment(name, "rrd") if name is not None else {}
        return FileResponse(file, media_type="application/octet-stream", headers=headers)

    @app.get("/rerun/")
    async def page() -> FileResponse:
        return FileResponse(data_folder("static") / "rerun" / "viewer.html", headers={"Cache-Control": "no-cache"})

    @app.get("/rerun/{name}")
    async def viewer(name: str) -> FileResponse:
        types = {"re_viewer.js": "text/javascript", "re_viewer_bg.wasm": "application/wasm"}
        if name not in types:
            raise HTTPException(404, f"rerun's viewer has no file {name[:40]!r}")
        try:
            file = await run_in_threadpool(files.viewer, name)
        except ModuleNotFoundError as error:
            raise HTTPException(MISSING, str(error)) from None
        except OSError as error:
            raise HTTPException(507, sentence_of(error, "rerun's viewer")) from None
        return FileResponse(file, media_type=types[name], headers={"Cache-Control": "no-cache"})

    return files
