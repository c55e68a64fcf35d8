"""A socket to listen on, and the server of an application there."""

from __future__ import annotations

import errno
import logging
import socket
from collections.abc import Callable

import uvicorn
from starlette.types import ASGIApp

from .connections import Connection, most_connections

SHUTDOWN_SECONDS = 3
LARGEST_PORT = 65_535
# Of a WebSocket.
LARGEST_MESSAGE = 4 * 1024 * 1024


class Server(uvicorn.Server):
    """A uvicorn server that says when it listens."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._ready()


# uvicorn calls it an error when a handshake is refused with an answer.
REFUSED = "ASGI callable returned without completing handshake."


def server_of(app: ASGIApp, ready: Callable[[], None] = lambda: None) -> Server:
    Connection.most = most_connections()
    config = uvicorn.Config(
        app,
        http=Connection,
        log_level="warning",
        access_log=False,
        server_header=False,
        ws_max_size=LARGEST_MESSAGE,
        ws_per_message_deflate=False,
        # Any client can claim in a header to come from elsewhere; guesses of the token are counted by address.
        proxy_headers=False,
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
    )
    logging.getLogger("uvicorn.error").addFilter(_is_news)
    return Server(config, ready)


def _is_news(record: logging.LogRecord) -> bool:
    return record.msg != REFUSED


def listen(host: str, port: int) -> socket.socket:
    """A listening socket; port 0 picks a free port."""
    if not 0 <= port <= LARGEST_PORT:
        raise ValueError(f"--port is {port}; give one from 1 to {LARGEST_PORT}, or 0 for a free one")
    try:
        family = socket.getaddrinfo(host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[0][0]
    except OSError:
        raise OSError(f"host is {host!r}, which is not an address of this machine; try 127.0.0.1") from None
    # With an explicit protocol, asyncio turns off Nagle's algorithm, which would delay a second message by 40 ms.
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen(128)
    except OSError as error:
        listener.close()
        raise OSError(_why_not(error, host, port)) from None
    return listener


def _why_not(error: OSError, host: str, port: int) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"port {port} of {host} is in use, perhaps by another lineseg; give another --port, or 0 for a free one"
    if error.errno == errno.EACCES:
        return f"you may not use port {port}; give a --port above 1023, or 0 for a free one"
    return f"{host}, port {port}: {error.strerror}"
