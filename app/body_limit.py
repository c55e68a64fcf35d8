"""A limit for the bodies of all requests but those that send a file."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST = 4 * 1024 * 1024
# Files, which have limits of their own.
FILES = ("/api/upload", "/api/sweep-table", "/api/lessons/file")


class BodyLimit:
    """ASGI middleware. JSON grows about thirtyfold when it is parsed, so the limit is low."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["path"] in FILES:
            await self._app(scope, receive, send)
            return
        sentence = f"a request like this has at most {LARGEST} bytes; this one is longer"
        announced, came = Headers(scope=scope).get("content-length", ""), 0
        if announced.isdigit() and int(announced[:20]) > LARGEST:
            await JSONResponse({"message": sentence}, status_code=413)(scope, receive, send)
            return

        async def counted() -> Message:
            nonlocal came
            message = await receive()
            came += len(message.get("body", b""))
            if came > LARGEST:
                raise HTTPException(413, sentence)
            return message

        await self._app(scope, counted, send)
