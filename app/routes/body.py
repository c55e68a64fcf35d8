"""The body of a request, as long as it may be."""

from __future__ import annotations

from fastapi import Request
from starlette.exceptions import HTTPException


async def body_of(request: Request, most: int, what: str) -> bytes:
    """All bytes; more than `most` are an answer of 413 that says what was too long."""
    body = b""
    async for chunk in request.stream():
        body += chunk
        if len(body) > most:
            raise HTTPException(413, f"{what} no more than {most} bytes; this one is longer")
    return body
