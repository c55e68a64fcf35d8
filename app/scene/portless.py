"""A viser server that listens on no port: whoever accepts a browser's socket hands it over inside of the process.

viser itself checks neither origin nor token, so any program or page that reached a port of it could read the scene and
move the sliders. viser is pinned to one version, and this relies on two of its internals: viser looks `serve` up in
the module `viser.infra._infra`, and it asks a connection for no more than `Connection` has.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Coroutine
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

import rich
import viser
import viser.infra._infra as infra
import websockets.asyncio.server
import websockets.datastructures
from websockets.exceptions import ConnectionClosedOK

MOST_WAITING = 64
PARTING_SECONDS = 1.0
GOING_AWAY = 1001

Send = Callable[[bytes], Coroutine[Any, Any, None]]


class Connection:
    """What viser sees of a browser. `send` runs in the loop that made the connection; all else in viser's.

    subprotocol: what the browser offered, which tells viser the version of its page.
    """

    def __init__(self, send: Send, subprotocol: str | None) -> None:
        self.subprotocol = subprotocol
        self.close_code = GOING_AWAY
        self._send = send
        self._outside = asyncio.get_running_loop()
        self._waiting: deque[bytes] = deque()
        self._changed = asyncio.Event()
        self._closed = False

    async def send(self, data: bytes) -> None:
        """Returns when the browser's socket has taken the message, so that nothing piles up."""
        if self._closed:
            raise ConnectionClosedOK(None, None)
        try:
            await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(self._send(data), self._outside))
        except Exception:
            raise ConnectionClosedOK(None, None) from None

    async def recv(self) -> bytes:
        while not self._waiting:
            if self._closed:
                raise ConnectionClosedOK(None, None)
            self._changed.clear()
            await self._changed.wait()
        return self._waiting.popleft()

    async def close(self, code: int = GOING_AWAY, reason: str = "") -> None:
        self.close_code = code
        self.end()

    def arrive(self, data: bytes) -> None:
        self._waiting.append(data)
        self._changed.set()

    def end(self) -> None:
        self._closed = True
        self._changed.set()

    @property
    def full(self) -> bool:
        return len(self._waiting) >= MOST_WAITING


class Door(str):
    """Given to viser as its host; the only way in. As a plain string, it is the loopback."""

    def __new__(cls) -> Door:
        return super().__new__(cls, "127.0.0.1")

    def __init__(self) -> None:
        self.loop: asyncio.AbstractEventLoop | None = None
        self._handler: Callable[[Any], Awaitable[None]] | None = None
        self._guests: dict[asyncio.Task[None], Connection] = {}

    @contextlib.asynccontextmanager
    async def serving(self, handler: Callable[[Any], Awaitable[None]]) -> AsyncIterator[SimpleNamespace]:
        """What viser awaits in place of a listening server."""
        self._handler, self.loop = handler, asyncio.get_running_loop()
        try:
            yield SimpleNamespace(server=SimpleNamespace(sockets=()))
        finally:
            self._handler = None
            for guest in self._guests.values():
                guest.end()
            if self._guests:
                await asyncio.wait(self._guests, timeout=PARTING_SECONDS)
            for late in list(self._guests):
                late.cancel()

    def enter(self, connection: Connection) -> Future[None]:
        """Let viser serve a connection until it ends. Raises RuntimeError if viser has stopped."""
        if self.loop is None or self.loop.is_closed():
            raise RuntimeError("viser has stopped")
        return asyncio.run_coroutine_threadsafe(self._serve(connection), self.loop)

    def call(self, function: Callable[..., None], *arguments: Any) -> None:
        """Call a function in viser's loop. Raises RuntimeError if viser has stopped."""
        if self.loop is None:
            raise RuntimeError("viser has not started")
        self.loop.call_soon_threadsafe(function, *arguments)

    async def _serve(self, connection: Connection) -> None:
        if self._handler is None:
            return
        task = asyncio.current_task()
        assert task is not None
        self._guests[task] = connection
        try:
            await self._handler(connection)
        finally:
            del self._guests[task]


def _serve(handler: Callable[[Any], Awaitable[None]], host: str, *arguments: Any, **options: Any) -> Any:
    """`websockets.asyncio.server.serve`, unless the host is a Door."""
    if isinstance(host, Door):
        return host.serving(handler)
    return websockets.asyncio.server.serve(handler, host, *arguments, **options)


infra.websockets = SimpleNamespace(  # pyright: ignore[reportAttributeAccessIssue, reportPrivateImportUsage]
    asyncio=SimpleNamespace(server=SimpleNamespace(serve=_serve)),
    datastructures=websockets.datastructures,
    exceptions=websockets.exceptions,
)


class PortlessServer(viser.ViserServer):
    """A viser server that is reached through its `door` only, and that never opens a share tunnel."""

    def __init__(self) -> None:
        # viser prints to stdout, which belongs to the command line.
        rich.get_console().quiet = True
        self.door = Door()
        super().__init__(host=self.door, port=0, label="lineseg", verbose=False)
        if self.door.loop is None:
            self.stop()
            raise RuntimeError(f"viser {viser.__version__} opened a port of its own; install version 1.1.1")

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None
