"""What the page asks about what it shows: what would change an answer, how far the lines agree with the truth."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from fastapi import FastAPI
from starlette.exceptions import HTTPException

from lineseg import what_if, why

from ..frame.judge import Reference, as_json, judged_recording
from ..session.sessions import Sessions
from ..shelf.label_files import LabelFiles

# So many rows of the list of frames can be in view at once.
MOST_ROWS = 60


def add_inspection(app: FastAPI, sessions: Sessions, files: LabelFiles) -> None:
    """Routes of /api that look into what a tab shows."""

    @app.get("/api/what-if")
    def what_would_change(session: str = "") -> dict[str, Any]:
        shown = sessions.shown(session)
        view = shown.view
        told = {"frame": view.frame, "beam": view.selected, "method": view.method, "params": view.params.numbers()}
        if view.selected is None:
            return told | {"changes": []}
        changes = what_if(shown.found.scan, view.selected, view.params, view.method)
        return told | {"changes": [asdict(change) for change in changes]}

    @app.get("/api/why")
    def what_looks_wrong(session: str = "", frames: str = "") -> dict[str, Any]:
        shown = sessions.shown(session)
        view, recording = shown.view, shown.recording
        try:
            wanted = [int(frame) for frame in frames.split(",")[:MOST_ROWS] if 0 <= int(frame) < len(recording)]
        except ValueError:
            raise HTTPException(400, f"frames are numbers between commas; these are {frames[:60]!r}") from None
        told = {"recording": view.recording, "method": view.method, "params": view.params.numbers()}
        if len(recording) < 2:
            return told | {"words": {}}
        remarks = {frame: why(recording, frame, view.params) for frame in wanted}
        return told | {"words": {frame: [each.text for each in remarks[frame]] for frame in wanted}}

    @app.get("/api/truth")
    def truth(session: str = "") -> dict[str, Any]:
        shown = sessions.shown(session)
        view = shown.view
        known = files.known(view.recording, shown.recording)
        reference = Reference.of(view.reference, shown.recording, known)
        if not reference.chosen:
            raise HTTPException(404, "the true lines of this recording are not known")
        said = reference.said
        agreement, stride = judged_recording(shown.recording, view.method, view.params, said and said.labels)
        told = {"recording": view.recording, "method": view.method, "params": view.params.numbers()}
        told |= {"judgedBy": reference.chosen, "labelled": said.stamp if said else ""}
        return told | {"agreement": as_json(agreement), "stride": stride}
