"""A running node takes thresholds from the page: a small server in it, announced by a file that its user can read."""

from __future__ import annotations

import contextlib
import json
import os
import secrets
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

from pydantic import ValidationError
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from lineseg import EXTRACTORS, Thresholds

from ..body_limit import BodyLimit
from ..guard import Guard, is_any, is_loopback
from ..listening import listen, server_of
from .offers import FOLDER, PATH, NodeState, Offer, PutAsked
from .running import Running

STARTED_SECONDS = 60.0


@contextlib.contextmanager
def open_door(
    source: str,
    running: Running,
    prepare: Callable[[str, Thresholds], None],
    tell: Callable[[str], None],
    folder: Path,
    host: str = "127.0.0.1",
    port: int = 0,
    token: str | None = None,
) -> Iterator[None]:
    """Take thresholds for `running` while inside.

    prepare: called before thresholds hold, in a thread of its own, to load what they need. folder: of the user's data;
    the file in it is how the page finds the node. Raises OSError if the port is busy.
    """
    shown = token is None and not is_loopback(host)
    token = token or secrets.token_urlsafe(16)
    with listen(host, port) as listener:
        place = "localhost" if is_any(host) else f"[{host}]" if ":" in host else host
        address = f"http://{place}:{listener.getsockname()[1]}"
        started = threading.Event()
        server = server_of(_app(source, running, prepare, tell, host, token), started.set)
        thread = threading.Thread(target=server.run, args=([listener],), name="node door", daemon=True)
        thread.start()
        try:
            if not started.wait(STARTED_SECONDS):
                raise OSError(f"{address}: the door for the page does not open")
            tell(f"the page may send thresholds to {address}{f', with the token {token}' if shown else ''}")
            with _announced(Offer(address=address, token=token, source=source), folder, tell):
                yield
        finally:
            server.should_exit = True
            thread.join(STARTED_SECONDS)


def _app(
    source: str,
    running: Running,
    prepare: Callable[[str, Thresholds], None],
    tell: Callable[[str], None],
    host: str,
    token: str,
) -> Starlette:
    def state() -> Response:
        method, params = running.now
        return JSONResponse(NodeState(source=source, method=method, params=params.numbers()).model_dump())

    async def get(request: Request) -> Response:
        return state()

    async def put(request: Request) -> Response:
        try:
            asked = PutAsked.model_validate_json(await request.body())
            params = thresholds_of(asked.method, asked.params)
        except ValidationError as error:
            return JSONResponse({"message": f"this is no message to a node: {error.errors()[0]['msg']}"}, 400)
        except ValueError as error:
            return JSONResponse({"message": str(error)}, 400)
        await run_in_threadpool(prepare, asked.method, params)
        running.send(asked.method, params)
        values = ", ".join(f"{name} {value:g}" for name, value in params.numbers().items())
        tell(f"sent from the page: {asked.method}, {values}")
        return state()

    guards = [Middleware(Guard, host=host, token=token), Middleware(BodyLimit)]
    return Starlette(routes=[Route(PATH, get), Route(PATH, put, methods=["PUT"])], middleware=guards)


def thresholds_of(method: str, values: dict[str, int | float]) -> Thresholds:
    """Raises ValueError for an unknown method or threshold, and for a value that is not allowed."""
    if method not in EXTRACTORS:
        raise ValueError(f"there is no method {method[:40]!r}; choose from {', '.join(EXTRACTORS)}")
    return EXTRACTORS[method].params_type().but(**values)


@contextlib.contextmanager
def _announced(offer: Offer, folder: Path, tell: Callable[[str], None]) -> Iterator[None]:
    """A file with the address and the token, which only this user can read."""
    file = folder / FOLDER / f"{secrets.token_hex(6)}.json"
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with open(os.open(file, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600), "w", encoding="utf-8") as out:  # noqa: PTH123
            json.dump(offer.model_dump(), out)
    except OSError as error:
        tell(f"{file}: {error.strerror}; the page finds this node only if it is started with --robot {offer.address}")
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            file.unlink()
