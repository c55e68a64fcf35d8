"""The body of a request, up to a limit."""

from __future__ import annotations

from fastapi import Request
from starlette.exceptions import HTTPException


async def body_of(request: Request, most: int, what: str) -> bytes:
    """All bytes of the body; answers 413, with what was too long, if there are more than `most`."""
    body = b""
    async for chunk in request.stream():
        body += chunk
        if len(body) > most:
            raise HTTPException(413, f"{what} at most {most} bytes; this one is longer")
    return body
