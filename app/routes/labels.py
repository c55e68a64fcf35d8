"""Saves the page's labels of a frame: true lines, tags and a note."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse, Response
from pydantic import Field, TypeAdapter, ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import ConflictError, FrameLabels, Recording, Scan, TrueLine
from lineseg.readers import Reading

from ..bounds import Count, Message, Number, ReadingValues, RecordingId, sentence
from ..frame.state import labels_told
from ..shelf.label_files import LIVE, LabelFiles
from ..shelf.library import Library
from ..told.answers import Brief, LabelsOverview, Sweep
from .body import body_of

LONGEST = 1 << 20
Place = tuple[Number, Number]
_READING: TypeAdapter[dict[str, Any]] = TypeAdapter(ReadingValues)


class SaidLine(Message):
    """A true line; missing ends are taken from its points."""

    first: Count
    last: Count
    start: Place | None = None
    end: Place | None = None


class Said(Message):
    """All labels of a frame; reading: how the file is read; revision: the one they are based on."""

    recording: RecordingId
    reading: ReadingValues = Field(default_factory=dict)
    frame: Count
    revision: Count
    lines: Annotated[list[SaidLine], Field(max_length=5000)] | None
    tags: Annotated[list[Annotated[str, Field(min_length=1, max_length=60)]], Field(max_length=100)]
    note: Annotated[str, Field(max_length=20_000)]


def add_labels(app: FastAPI, library: Library, files: LabelFiles) -> None:
    """Routes of /api/labels."""

    @app.get("/api/labels")
    def overview(recording: str = "", reading: str = "{}") -> LabelsOverview:
        known = files.known(recording, _open(library, recording, _values(reading)))
        if known is None:
            raise HTTPException(400, LIVE)
        return {"stamp": known.stamp, "frames": {frame: _brief(said) for frame, said in known.labels.items()}}

    @app.get("/api/labels/points")
    def points(frame: int, recording: str = "", reading: str = "{}") -> Sweep:
        scan = _scan(_open(library, recording, _values(reading)), frame)
        xy = [(round(float(x), 4), round(float(y), 4)) if x == x else None for x, y in scan.xy]
        return {"points": xy, "bearings": scan.bearings.round(5).tolist(), "fullCircle": scan.full_circle}

    @app.put("/api/labels")
    async def save(request: Request) -> Response:
        body = await body_of(request, LONGEST, "what is said of a frame has")
        try:
            said = Said.model_validate_json(body)
        except ValidationError as error:
            raise HTTPException(422, sentence(error)) from None
        return await run_in_threadpool(_save, library, files, said)


def _brief(said: FrameLabels) -> Brief:
    lines = None if said.lines is None else len(said.lines)
    return {"revision": said.revision, "lines": lines, "tags": said.tags, "note": said.note}


def _save(library: Library, files: LabelFiles, said: Said) -> Response:
    try:
        recording = _open(library, said.recording, said.reading)
        labels = _labels(said, _scan(recording, said.frame))
        saved = files.save(said.recording, recording, said.frame, labels)
    except ConflictError as error:
        return JSONResponse({"message": str(error), "theirs": labels_told(error.theirs)}, status_code=409)
    except ValueError as error:
        raise HTTPException(400, str(error)) from None
    except OSError as error:
        raise HTTPException(507, f"{error.filename or 'the labels'} cannot be written: {error.strerror}.") from None
    return JSONResponse(labels_told(saved))


def _labels(said: Said, scan: Scan) -> FrameLabels:
    lines = None if said.lines is None else tuple(_line(line, scan) for line in said.lines)
    return FrameLabels(lines, tuple(said.tags), said.note, said.revision)


def _line(line: SaidLine, scan: Scan) -> TrueLine:
    if line.start is None or line.end is None:
        return TrueLine.over(scan, line.first, line.last)
    return TrueLine(line.first, line.last, line.start, line.end)


def _values(text: str) -> dict[str, Any]:
    try:
        return _READING.validate_json(text)
    except ValidationError as error:
        raise HTTPException(422, f"reading: {sentence(error)}") from None


def _open(library: Library, id: str, reading: Mapping[str, Any]) -> Recording:
    if id.startswith("live:"):
        raise HTTPException(400, LIVE)
    try:
        return library.recording(id, Reading().but(**reading))
    except (ValueError, OSError) as error:
        raise HTTPException(404, str(error)) from None


def _scan(recording: Recording, frame: int) -> Scan:
    if not recording.has(frame):
        frames = recording.whole or len(recording)
        left_out = ", and not all of them are read" if recording.whole else ""
        raise HTTPException(400, f"frame {frame}: {recording.name} has the frames 0 to {frames - 1}{left_out}")
    return recording[recording.position(frame)]
