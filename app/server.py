"""The server: one port for the page, its WebSocket, and the scenes of all tabs."""

from __future__ import annotations

import asyncio
import contextlib
import html
import mimetypes
import os
import secrets
import sys
import tempfile
import threading
import webbrowser
from collections.abc import AsyncIterator, Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from urllib.parse import quote

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from lineseg.failing import mistake
from lineseg.readers import Reading

from .body_limit import BodyLimit
from .bridges.address import Address, check_address
from .guard import Guard, check_origin, is_loopback
from .listening import listen, server_of
from .live.hub import Live
from .memory import keep_together, settle
from .node.offers import is_node
from .places import data_folder, user_folder
from .routes.api import add_api
from .routes.class_list import add_class
from .routes.export import add_export
from .routes.inspection import add_inspection
from .routes.labels import add_labels
from .routes.lessons import add_lessons
from .routes.line_map import add_line_map
from .routes.page import add_page
from .routes.push import add_push
from .routes.rereading import add_rereading
from .routes.rerun import add_rerun
from .routes.robot import add_back
from .routes.scene import add_scene
from .routes.sweep_table import add_sweep_table
from .routes.tab import add_sockets
from .routes.tuning import add_tuning
from .session.sessions import SessionLimits, Sessions
from .session.shown import Watch
from .session.warm_up import WarmUp
from .shelf.label_files import LabelFiles
from .shelf.lesson_shelf import LessonShelf
from .shelf.library import Library
from .shelf.recent import Recent
from .shelf.scratch import remove_leftovers
from .shelf.uploads import Uploads
from .socket_limit import SocketLimit

WAITING_THREADS = 32
MOST_KEPT = 20_000
# A thread that computes lets others go on after this time. The one that answers all tabs lets go of the interpreter at
# every message, and each time would wait for five times as long if this were left at Python's default.
SWITCH_SECONDS = 0.001


@dataclass(frozen=True)
class Settings:
    """Settings of the server.

    files: recordings to offer, the first is shown; reading: how they are read. robots: sources of live scans; the
    newest `keep` scans of each are kept. may_send: addresses of other robots to which the page may send. lessons: a
    folder of lessons that are offered besides the program's. host: any address but the loopback needs a token; one is
    made if none is given. names: other host names of this machine. embedders: origins whose pages may show this one in
    a frame. upload_limit, upload_total: [bytes]. data_folder: for the list of recent files and for labels that cannot
    be next to their recording (default: the user's data folder). watch: gets whatever is drawn in any tab.
    Raises ValueError, which names the option of `lineseg view`.
    """

    files: tuple[Path, ...] = ()
    reading: Reading = field(default_factory=Reading)
    lessons: Path | None = None
    robots: tuple[Address, ...] = ()
    may_send: tuple[str, ...] = ()
    keep: int = 3000
    host: str = "127.0.0.1"
    port: int = 8765
    token: str | None = None
    open_browser: bool = True
    names: tuple[str, ...] = ()
    embedders: tuple[str, ...] = ()
    upload_limit: int = 2_000_000_000
    upload_total: int = 8_000_000_000
    upload_number: int = 20
    sessions: SessionLimits = field(default_factory=SessionLimits)
    data_folder: Path | None = None
    watch: Watch | None = None

    def __post_init__(self) -> None:
        if not 1 <= self.keep <= MOST_KEPT:
            raise ValueError(f"--keep is {self.keep}; allowed: 1 to {MOST_KEPT} scans")
        for address in self.may_send:
            if not is_node(address):
                check_address(address)
        for origin in self.embedders:
            check_origin(origin)


def create_app(settings: Settings) -> FastAPI:
    """The application. Any address but the loopback requires a token."""
    if not is_loopback(settings.host) and not settings.token:
        raise ValueError(f"host is {settings.host!r}, which others can reach; set a token")
    remove_leftovers(user_folder(settings.data_folder))
    uploads = Uploads(settings.upload_limit, settings.upload_number, settings.upload_total)
    live = Live(settings.robots, settings.keep)
    lessons = LessonShelf(settings.lessons)
    library = Library(settings.files, Recent(settings.data_folder), uploads, live, settings.reading, lessons)
    warm_up = WarmUp()
    files = LabelFiles(library, user_folder(settings.data_folder))
    sessions = Sessions(library, files, warm_up, settings.sessions, settings.watch)

    @contextlib.asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        # asyncio's own pool has few threads on a small machine, and some of them wait for a tab to open or to close.
        asyncio.get_running_loop().set_default_executor(ThreadPoolExecutor(WAITING_THREADS, "lineseg"))
        warm_up.start()
        live.start()
        if settings.lessons is not None:
            # What is wrong with them is said at the start, not when someone asks for them.
            threading.Thread(target=lessons.told, name="lessons", daemon=True).start()
        reaper = asyncio.create_task(sessions.reap())
        try:
            yield
        finally:
            reaper.cancel()
            await sessions.close_all()
            await asyncio.to_thread(live.close)
            uploads.close()
            lessons.close()
            rerun.close()

    app = FastAPI(lifespan=lifespan, openapi_url=None, docs_url=None, redoc_url=None)
    app.add_middleware(BodyLimit)
    app.add_middleware(SocketLimit)
    app.add_middleware(
        Guard, host=settings.host, token=settings.token, names=settings.names, embedders=settings.embedders
    )
    for kind, told in ANSWERS.items():
        app.add_exception_handler(kind, told)
    add_api(app, library, sessions)
    add_export(app, library, sessions, files)
    add_scene(app, sessions)
    add_inspection(app, sessions, files)
    add_line_map(app, library, sessions)
    add_labels(app, library, files)
    add_lessons(app, library, sessions)
    add_class(app, library, sessions)
    add_rereading(app, library)
    add_sockets(app, library, sessions, bool(settings.reading.given()))
    add_sweep_table(app)
    add_tuning(app, sessions, user_folder(settings.data_folder) / "studies")
    add_push(app, library)
    may_send = [*(robot.url for robot in settings.robots), *settings.may_send]
    add_back(app, library, sessions, may_send, user_folder(settings.data_folder))
    rerun = add_rerun(app, library, sessions)
    add_page(app, data_folder("static"))
    return app


def serve(settings: Settings, announce: Callable[[str], None] = lambda address: None) -> None:
    """Serve until interrupted. announce: called with the address to open, once the server answers there.

    Raises OSError, with what to do, if the port is busy.
    """
    keep_together()
    sys.setswitchinterval(SWITCH_SECONDS)
    if not is_loopback(settings.host) and not settings.token:
        settings = replace(settings, token=secrets.token_urlsafe(16))
    listener = listen(settings.host, settings.port)
    address = address_of(settings, listener.getsockname()[1])

    with listener, _to_open(address, settings) as opened:

        def ready() -> None:
            announce(address)
            if settings.open_browser:
                threading.Thread(target=webbrowser.open, args=(opened,), daemon=True).start()

        server = server_of(create_app(settings), ready)
        settle()
        server.run(sockets=[listener])


def address_of(settings: Settings, port: int) -> str:
    """The address to open in a browser on this machine."""
    host = "localhost" if settings.host in ("", "0.0.0.0", "::", "*") else settings.host
    shown = f"[{host}]" if ":" in host else host
    return f"http://{shown}:{port}/" + (f"?token={quote(settings.token)}" if settings.token else "")


@contextlib.contextmanager
def _to_open(address: str, settings: Settings) -> Iterator[str]:
    """What the browser is told to open: never the token, because `ps` shows the arguments of programs to everybody."""
    if not settings.token or not settings.open_browser:
        yield address
        return
    folder = user_folder(settings.data_folder)
    folder.mkdir(parents=True, exist_ok=True)
    # Made by mkstemp, so that only this user can read it.
    descriptor, name = tempfile.mkstemp(prefix="open-", suffix=".html", dir=folder)
    os.close(descriptor)
    refresh = f'<!doctype html><meta http-equiv="refresh" content="0; url={html.escape(address)}">'
    Path(name).write_text(refresh, encoding="utf-8")
    try:
        yield Path(name).as_uri()
    finally:
        Path(name).unlink(missing_ok=True)


async def _sentence(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return JSONResponse({"message": error.detail}, status_code=error.status_code, headers=error.headers)


async def _mistake(request: Request, error: Exception) -> Response:
    """What nobody expected; the server also logs it."""
    return JSONResponse({"message": mistake(error)}, status_code=500)


async def _gone(request: Request, error: Exception) -> Response:
    """Whoever left before the end of a request hears nothing of this, and it is no mistake."""
    return JSONResponse({"message": "the request breaks off"}, status_code=400)


async def _complaint(request: Request, error: Exception) -> Response:
    """The first error in the body of a request."""
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    place = ".".join(str(part) for part in first["loc"][1:]) or "the request"
    return JSONResponse({"message": f"{place}: {first['msg'][:1].lower()}{first['msg'][1:]}"}, status_code=422)


ANSWERS = {
    HTTPException: _sentence,
    RequestValidationError: _complaint,
    ClientDisconnect: _gone,
    Exception: _mistake,
}

# Some systems have no media type, or a wrong one, for these.
mimetypes.add_type("text/javascript", ".js")
mimetypes.add_type("image/svg+xml", ".svg")
