"""The page's own files, which a browser loads once for each state that they are in."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from ..view import View
from ..view_field import page_module

DECLARED = "declared.js"
REVALIDATED = {"Cache-Control": "no-cache"}
KEPT = {"Cache-Control": "private, max-age=31536000, immutable"}


def add_page(app: FastAPI, folder: Path) -> None:
    """The page at `/`, and its files twice: at `/static/`, and below the name of the state that they are in.

    The page uses the second, so that a tab opened or reloaded asks again only for what it does not have.
    """
    declared = page_module(View)

    def index(request: Request) -> Response:
        state = state_of(folder, declared)
        try:
            text = (folder / "index.html").read_text(encoding="utf-8")
        except FileNotFoundError:
            raise HTTPException(404, "index.html is missing in this installation") from None
        return HTMLResponse(text.replace('"/static/', f'"/static/at/{state}/'), headers=REVALIDATED)

    for start, headers in (("/static/at/{state}", KEPT), ("/static", REVALIDATED)):
        app.add_route(f"{start}/{DECLARED}", _module(declared, headers))
        app.mount(start, Static(folder, headers))
    app.add_route("/", index)


class Static(StaticFiles):
    """Static files, with these headers."""

    def __init__(self, folder: Path, headers: dict[str, str]) -> None:
        super().__init__(directory=folder)
        self._headers = headers

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        response = super().file_response(full_path, stat_result, scope, status_code)
        response.headers.update(self._headers)
        return response


def _module(text: str, headers: dict[str, str]):
    return lambda request: Response(text, media_type="text/javascript", headers=headers)


def state_of(folder: Path, declared: str) -> str:
    """A name that changes when a file does, as its time or length tells."""
    told = [declared, *(f"{file.path} {file.stat().st_mtime_ns} {file.stat().st_size}" for file in _files(folder))]
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]


def _files(folder: Path) -> Iterator[os.DirEntry[str]]:
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
        if entry.is_dir():
            yield from _files(Path(entry.path))
        else:
            yield entry
