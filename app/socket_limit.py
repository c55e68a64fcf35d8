"""A limit for the number of WebSockets of each kind."""

from __future__ import annotations

from collections import Counter

from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

# Of a tab, at most one of each kind is open; twice as many as tabs, because some are about to end.
MOST_SOCKETS = 128
TRY_AGAIN_LATER = 1013


class SocketLimit:
    """ASGI middleware. /api/session and /api/tuning, for example, are two kinds."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._open: Counter[str] = Counter()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "websocket":
            await self._app(scope, receive, send)
            return
        kind = "/".join(scope["path"].removeprefix("/api").split("/")[:2])
        if self._open[kind] >= MOST_SOCKETS:
            socket = WebSocket(scope, receive, send)
            await socket.accept()
            await socket.close(TRY_AGAIN_LATER, f"{MOST_SOCKETS} connections like this are open; close other tabs")
            return
        self._open[kind] += 1
        try:
            await self._app(scope, receive, send)
        finally:
            self._open[kind] -= 1
