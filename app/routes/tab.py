"""The sockets of a browser tab: messages and scene."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from concurrent.futures import CancelledError
from dataclasses import asdict, replace

from fastapi import FastAPI
from pydantic import BaseModel
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.websockets import WebSocket, WebSocketDisconnect

from lineseg import EXTRACTORS, __version__
from lineseg.failing import mistake
from lineseg.readers.containers.wrapping import suffixes_of_recordings

from ..session.following import OWN
from ..session.page import Page
from ..session.session import Session
from ..session.sessions import Sessions, TooManySessionsError
from ..shelf.library import Library
from ..told.messages import Failure, MethodEntry, Quick, ReadingEntry, Recordings, ScoreEntry, Surveyed, Welcome
from ..view import STRIP_SCORES, View
from ..wire import BadMessageError, Cancel, Change, Close, Follow, Hello, Incoming, OpenLink, parse
from .heard import first_text_from, text_from
from .live_status import tell_live
from .viser_relay import client_page, relay

MIRRORING = "this tab follows a presenter; stop following to change what it shows"

NO_HELLO, CLOSED, TOO_MANY = 4000, 4001, 4002
SEND_SECONDS = 30.0

log = logging.getLogger(__name__)


def add_sockets(app: FastAPI, library: Library, sessions: Sessions, asked: bool) -> None:
    """Routes of /api/session and /s/{session}/viser/."""
    methods = [MethodEntry.of(method) for method in EXTRACTORS.values()]
    scores = [ScoreEntry(**asdict(score)) for score in STRIP_SCORES.values()]
    fields = ReadingEntry.all()
    suffixes = suffixes_of_recordings()

    @app.websocket("/api/session")
    async def session_socket(socket: WebSocket) -> None:
        await socket.accept()
        with contextlib.suppress(WebSocketDisconnect):
            hello = await _hello(socket)
            if hello is None:
                return
            try:
                session, resumed, complaint = await _session_of(hello, library, sessions, asked)
            except TooManySessionsError as error:
                await _tell(socket, Failure(where="server", message=str(error)))
                await socket.close(TOO_MANY)
                return
            welcome = Welcome(
                session=session.id,
                resumed=resumed,
                viser=f"/s/{session.id}/viser/",
                version=__version__,
                methods=methods,
                scores=scores,
                reading=fields,
                recordings=library.entries(),
                uploadLimit=library.uploads.limit,
                suffixes=suffixes,
                presenter=session.presenter.id,
            )
            await _converse(socket, session, sessions, library, hello, welcome, complaint)

    @app.websocket("/s/{id}/viser")
    @app.websocket("/s/{id}/viser/")
    async def viser_socket(socket: WebSocket, id: str) -> None:
        session = sessions.get(id)
        if session is None:
            await socket.close(CLOSED)
            return
        await relay(socket, session.door)

    @app.get("/s/{id}/viser/")
    async def viser_page(request: Request, id: str) -> Response:
        if sessions.get(id) is None:
            raise HTTPException(404, "this scene is closed; reload the page")
        return client_page(request)

    @app.get("/s/{id}/viser")
    async def viser_without_slash(id: str) -> Response:
        return RedirectResponse(f"/s/{id}/viser/")


async def _hello(socket: WebSocket) -> Hello | None:
    try:
        message = parse(await first_text_from(socket))
    except BadMessageError as error:
        await _tell(socket, Failure(where="server", message=str(error)))
        message = None
    if isinstance(message, Hello):
        return message
    await socket.close(NO_HELLO, "the first message must be a hello")
    return None


async def _session_of(
    hello: Hello, library: Library, sessions: Sessions, asked: bool
) -> tuple[Session, bool, str | None]:
    """The earlier session, or a new one with the page's View; and an error if that View is not possible.

    asked: whether the command line says how files are read.
    """
    said = hello.view or {}
    former = sessions.resume(hello.session)
    if former is not None:
        return former, True, former.restore(said)
    first = library.first()
    view, complaint = View(recording=first).salvaged(said)
    # Unless a link says how, the first file is read as the command line says, or as the last time.
    if view.recording == first and not view.read_as.given() and (asked or not said.get("recording")):
        reading = library.reading(first)
        view = replace(view, topic=reading.topic, reading=reading.but(topic=None))
    return await sessions.open(view), False, complaint


async def _converse(
    socket: WebSocket,
    session: Session,
    sessions: Sessions,
    library: Library,
    hello: Hello,
    welcome: Welcome,
    complaint: str | None,
) -> None:
    loop = asyncio.get_running_loop()

    def send(message: BaseModel) -> None:
        """Called in the worker's thread; waits until the message is sent, so a slow page slows only its own worker."""
        sending = asyncio.run_coroutine_threadsafe(_tell(socket, message), loop)
        try:
            sending.result(SEND_SECONDS)
        except (CancelledError, TimeoutError, WebSocketDisconnect, RuntimeError):
            log.debug("a message to %s was lost", session.id[:6])

    async def tell(message: BaseModel) -> None:
        with contextlib.suppress(TimeoutError, WebSocketDisconnect, RuntimeError):
            async with asyncio.timeout(SEND_SECONDS):
                await _tell(socket, message)

    def announce() -> None:
        asyncio.run_coroutine_threadsafe(_tell(socket, Recordings(recordings=library.entries())), loop)

    def hang_up() -> None:
        asyncio.run_coroutine_threadsafe(_hang_up(socket), loop)

    forget = library.on_change(announce)
    telling = asyncio.create_task(tell_live(lambda message: _tell(socket, message), session, library.live))
    try:
        await _tell(socket, welcome)
        if complaint is not None:
            await _tell(socket, Failure(where="view", message=complaint, rev=hello.rev))
        session.attach(Page(send, tell, hang_up), hello.rev)
        if hello.follow is not None:
            await _follow(socket, session, sessions, hello.follow)
        await _listen(socket, session, sessions)
    finally:
        telling.cancel()
        forget()
        session.detach()


async def _listen(socket: WebSocket, session: Session, sessions: Sessions) -> None:
    """Handle the page's messages until the page leaves or the session ends."""
    while True:
        try:
            message = parse(await text_from(socket))
            if isinstance(message, Close):
                await sessions.close(session)
                return
            await _handle(message, socket, session, sessions)
        except BadMessageError as error:
            await _tell(socket, Failure(where=error.where, message=str(error), rev=error.rev))
        except (WebSocketDisconnect, RuntimeError):
            raise
        except Exception as error:
            log.exception("a message failed")
            await _tell(socket, Failure(where="server", message=mistake(error)))


async def _handle(message: Incoming, socket: WebSocket, session: Session, sessions: Sessions) -> None:
    match message:
        case Change() | OpenLink() if session.following and not OWN.issuperset(_said(message)):
            await _tell(socket, Failure(where="view", message=MIRRORING, rev=message.rev))
        case Follow():
            await _follow(socket, session, sessions, message.id)
        case Change():
            changes = message.patch.changes()
            try:
                session.change(changes, message.rev)
            except ValueError as error:
                where = "params" if "params" in changes else "view"
                await _tell(socket, Failure(where=where, message=str(error), rev=message.rev))
        case OpenLink():
            complaint = session.restore(message.patch, message.rev)
            if complaint is not None:
                # The picture answers this revision.
                await _tell(socket, Failure(where="view", message=complaint))
        case Cancel():
            session.cancel()
        case Hello():
            await _tell(socket, Failure(where="server", message="this tab has already said hello; reload the page"))


def _said(message: Change | OpenLink) -> set[str]:
    """The fields that a message is about."""
    return message.patch.model_fields_set if isinstance(message, Change) else set(message.patch)


async def _follow(socket: WebSocket, session: Session, sessions: Sessions, id: str | None) -> None:
    try:
        presenter = sessions.presenter(id) if id is not None else None
    except ValueError as error:
        await asyncio.to_thread(session.follow, None)
        session.presenter_is("gone")
        await _tell(socket, Failure(where="view", message=str(error)))
        return
    await asyncio.to_thread(session.follow, presenter)


async def _hang_up(socket: WebSocket) -> None:
    with contextlib.suppress(RuntimeError):
        await socket.close(CLOSED, "this session was closed because it was idle or the server is stopping")


async def _tell(socket: WebSocket, message: BaseModel) -> None:
    if isinstance(message, Surveyed):
        await socket.send_bytes(message.as_bytes())
    else:
        await socket.send_text(message.as_json() if isinstance(message, Quick) else message.model_dump_json())
