"""Relays the iframe of a session to its viser server: viser's page and its WebSocket."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import hashlib
from functools import cache
from pathlib import Path

import viser
from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.typing import Subprotocol

LARGEST_MESSAGE = 50 * 1024 * 1024


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


async def relay(outer: WebSocket, port: int) -> None:
    """Carry messages between the browser and the viser server on `port` until either side closes.

    Each direction sends a message before it reads the next, so nothing piles up here.
    """
    offered = [Subprotocol(name) for name in outer.scope.get("subprotocols", []) if name.startswith("viser-v")]
    try:
        inner = await connect(
            f"ws://127.0.0.1:{port}",
            subprotocols=offered or None,
            max_size=LARGEST_MESSAGE,
            max_queue=4,
            compression=None,
            proxy=None,
        )
    except (OSError, WebSocketException):
        await outer.close(1013, "the scene is not ready yet")
        return
    async with inner:
        await outer.accept(subprotocol=inner.subprotocol)
        tasks = [asyncio.create_task(_inward(outer, inner)), asyncio.create_task(_outward(inner, outer))]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
        if outer.application_state is WebSocketState.CONNECTED and outer.client_state is WebSocketState.CONNECTED:
            with contextlib.suppress(RuntimeError):
                await outer.close(inner.close_code if inner.close_code in (1000, 1001, 1002) else 1001)


async def _inward(outer: WebSocket, inner: ClientConnection) -> None:
    with contextlib.suppress(WebSocketDisconnect, ConnectionClosed):
        while True:
            message = await outer.receive()
            if message["type"] == "websocket.disconnect":
                return
            data = message.get("bytes")
            await inner.send(data if data is not None else message["text"])


async def _outward(inner: ClientConnection, outer: WebSocket) -> None:
    with contextlib.suppress(WebSocketDisconnect, ConnectionClosed, RuntimeError):
        async for data in inner:
            if isinstance(data, bytes):
                await outer.send_bytes(data)
            else:
                await outer.send_text(data)
