"""The iframe of a session: viser's page, and the WebSocket that leads to the session's viser server."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import hashlib
import logging
from functools import cache
from pathlib import Path

import viser
from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ..scene.portless import Connection, Door

FULL_SECONDS = 0.01
PARTING_SECONDS = 5.0

log = logging.getLogger(__name__)


@cache
def _client_page() -> tuple[bytes, bytes, str]:
    """viser's page, plain and compressed, and its ETag."""
    text = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_bytes()
    return text, gzip.compress(text), f'"{hashlib.sha256(text).hexdigest()[:20]}"'


def client_page(request: Request) -> Response:
    """viser's client. It derives the WebSocket from its own address, so a path prefix works."""
    plain, packed, etag = _client_page()
    headers = {"ETag": etag, "Cache-Control": "no-cache", "Vary": "Accept-Encoding"}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        return Response(packed, media_type="text/html", headers=headers | {"Content-Encoding": "gzip"})
    return Response(plain, media_type="text/html", headers=headers)


async def relay(outer: WebSocket, door: Door) -> None:
    """Carry messages between the browser and a viser server until either side closes."""
    offered = [name for name in outer.scope.get("subprotocols", []) if name.startswith("viser-v")]
    subprotocol = offered[0] if offered else None
    connection = Connection(outer.send_bytes, subprotocol)
    await outer.accept(subprotocol=subprotocol)
    try:
        served = asyncio.wrap_future(door.enter(connection))
    except RuntimeError:
        await outer.close(1013, "the scene is closed; reload the page")
        return
    reading = asyncio.create_task(_inward(outer, connection, door))
    try:
        await asyncio.wait([served, reading], return_when=asyncio.FIRST_COMPLETED)
    finally:
        reading.cancel()
        with contextlib.suppress(RuntimeError):
            door.call(connection.end)
        await asyncio.wait([served, reading], timeout=PARTING_SECONDS)
    if served.done() and not served.cancelled() and (error := served.exception()) is not None:
        log.warning("a message to the scene was refused: %s: %s", type(error).__name__, error)
    if outer.application_state is WebSocketState.CONNECTED and outer.client_state is WebSocketState.CONNECTED:
        with contextlib.suppress(RuntimeError):
            await outer.close(connection.close_code)


async def _inward(outer: WebSocket, connection: Connection, door: Door) -> None:
    """Messages of the browser, no faster than viser takes them."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            message = await outer.receive()
            data = message.get("bytes")
            if message["type"] == "websocket.disconnect" or data is None:
                return
            while connection.full:
                await asyncio.sleep(FULL_SECONDS)
            door.call(connection.arrive, data)
