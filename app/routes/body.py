"""The body of a request: text up to a limit, or a file that is stored."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from fastapi import Request
from starlette.exceptions import HTTPException

from ..shelf.uploads import TooLargeError, TooManyError


async def body_of(request: Request, most: int, what: str) -> bytes:
    """All bytes of the body; answers 413, with what was too long, if there are more than `most`."""
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > most:
            raise HTTPException(413, f"{what} at most {most} bytes; this one is longer")
    return bytes(body)


def announced_size(request: Request) -> int | None:
    """The length of the body that the header states, in bytes."""
    length = request.headers.get("content-length", "")
    return int(length) if length.isascii() and length.isdigit() else None


@contextmanager
def storing(name: str) -> Iterator[None]:
    """Answers with the sentence of what goes wrong while a file is received."""
    try:
        yield
    except TooLargeError as error:
        raise HTTPException(413, str(error)) from None
    except TooManyError as error:
        raise HTTPException(429, str(error)) from None
    except ValueError as error:
        raise HTTPException(400, str(error)) from None
    except OSError as error:
        raise HTTPException(507, f"{name[:80]} could not be stored: {error.strerror}") from None
