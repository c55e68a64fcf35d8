"""Routes for uploads, thresholds as text, and recordings as files."""

from __future__ import annotations

from fastapi import FastAPI, Request
from fastapi.responses import PlainTextResponse, Response
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import EXTRACTORS, Thresholds, save_npz
from lineseg.failing import sentence_of
from lineseg.unfinished import temporary_folder
from lineseg.writers import PARAMS_WRITERS, params_text, read_params

from ..session.sessions import Sessions
from ..shelf.library import Library
from ..told.answers import ThresholdSweep
from ..tuning.sweep import sweep
from .attachment import attachment
from .body import announced_size, body_of, storing

LONGEST_PARAMS = 256 * 1024


def add_api(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """Routes of /api except the session's socket."""

    @app.post("/api/upload")
    async def upload(request: Request, name: str = "recording", bundle: str = "", into: str = "") -> dict[str, str]:
        """bundle: the name of a recording of several files, with its first; into: its id, with each of the others."""
        with storing(name):
            size, into = announced_size(request), into.removeprefix("upload:")
            kept = await library.uploads.receive(name, size, request.stream(), bundle[:200], into)
        library.changed()
        return {"recording": f"upload:{kept.id}"}

    @app.get("/api/params")
    async def write_params(request: Request) -> PlainTextResponse:
        values = dict(request.query_params)
        to, method = values.pop("to", "ros2"), values.pop("method", "region-growing")
        shown = sessions.seen(values.pop("session", ""))
        recording = "" if shown is None else library.label(shown.view.recording)
        if to not in PARAMS_WRITERS:
            raise HTTPException(400, f"thresholds cannot be written as {to!r}; choose from {', '.join(PARAMS_WRITERS)}")
        try:
            params = _thresholds(method).but(**{name: _number(name, text) for name, text in values.items()})
            return PlainTextResponse(params_text(params, to, recording))
        except ValueError as error:
            raise HTTPException(400, str(error)) from None

    @app.post("/api/params")
    async def import_params(request: Request, method: str = "region-growing") -> dict[str, dict[str, float]]:
        text = await _text(request)
        try:
            params = await run_in_threadpool(read_params, text, type(_thresholds(method)))
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return {"params": params.numbers()}

    @app.get("/api/sweep")
    def sweep_threshold(session: str = "", name: str = "epsilon") -> ThresholdSweep:
        shown = sessions.shown(session)
        known = [field for field, _, _ in shown.view.params.knobs()]
        if name not in known:
            raise HTTPException(400, f"there is no threshold {name[:40]!r}; choose from {', '.join(known)}")
        return sweep(shown.found.scan, shown.view.method, shown.view.params, name)

    @app.get("/api/recording")
    def recording(session: str = "") -> Response:
        shown = sessions.shown(session)
        try:
            with temporary_folder() as folder:
                save_npz(shown.recording, folder / "recording.npz")
                content = (folder / "recording.npz").read_bytes()
        except OSError as error:
            raise HTTPException(507, f"the recording cannot be written: {sentence_of(error, '')}") from None
        headers = attachment(library.label(shown.view.recording), "npz")
        return Response(content, media_type="application/octet-stream", headers=headers)


def _thresholds(method: str) -> Thresholds:
    if method not in EXTRACTORS:
        raise ValueError(f"there is no method {method[:40]!r}; choose from {', '.join(EXTRACTORS)}")
    return EXTRACTORS[method].params_type()


def _number(name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{name} is {text[:40]!r}, which is not a number") from None


async def _text(request: Request) -> str:
    body = await body_of(request, LONGEST_PARAMS, "a file of thresholds has")
    try:
        return body.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise HTTPException(400, "this is not UTF-8 text; save the file as UTF-8") from None
