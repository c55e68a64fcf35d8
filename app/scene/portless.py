"""A viser server that listens on no port: whoever accepts a browser's socket hands it over inside of the process.

viser itself checks neither origin nor token, so any program or page that reached a port of it could read the scene and
move the sliders. viser is pinned to one version, and this relies on some of its internals: viser looks `serve`,
`new_event_loop` and `AsyncMessageBuffer` up in the module `viser.infra._infra`, and it asks a connection for no more
than `Connection` has.

All scenes share the event loop of the server. In loops of their own, forty tabs would have forty more threads that
wait for each other at every picture, because Python runs one at a time.
"""

from __future__ import annotations

import asyncio
import contextlib
import threading
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
from viser.infra._async_message_buffer import AsyncMessageBuffer
from websockets.exceptions import ConnectionClosedOK

MOST_WAITING = 64
PARTING_SECONDS = 1.0
GOING_AWAY = 1001

Send = Callable[[bytes], Coroutine[Any, Any, None]]


class Connection:
    """What viser sees of a browser. `send` is awaited in the loop that made the connection; all else runs in viser's.

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
            if self._outside is asyncio.get_running_loop():
                await self._send(data)
            else:
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
        if self.loop is None or self.loop.is_closed() or self._handler is None:
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


class Borrowed(asyncio.AbstractEventLoop):
    """A loop that runs in another thread, for viser, which makes a loop and runs it until its server stops."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.loop = loop
        self.create_task = loop.create_task
        self.create_future = loop.create_future
        self.call_soon_threadsafe = loop.call_soon_threadsafe

    def run_until_complete(self, future: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(future, self.loop).result()

    def is_closed(self) -> bool:
        return self.loop.is_closed()

    def stop(self) -> None:
        """Other servers use it."""

    def close(self) -> None:
        """Other servers use it."""


class Arrival(asyncio.Event):
    """Set in its loop only.

    viser sets its events in other threads too, which may break off there, and then once more in the loop.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__()
        self._home = loop.loop if isinstance(loop, Borrowed) else loop

    def set(self) -> None:
        with contextlib.suppress(RuntimeError):
            if asyncio.get_running_loop() is self._home:
                super().set()


class Buffer(AsyncMessageBuffer):
    """viser's messages on their way to the browser."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.message_event = Arrival(self.event_loop)


# The loop for the server that is being made, and the lock that lets one be made at a time.
_lent: list[asyncio.AbstractEventLoop] = []
_making = threading.Lock()


def _new_event_loop() -> asyncio.AbstractEventLoop:
    return Borrowed(_lent[0]) if _lent else asyncio.new_event_loop()


infra.asyncio = SimpleNamespace(  # pyright: ignore[reportAttributeAccessIssue, reportPrivateImportUsage]
    **vars(asyncio) | {"new_event_loop": _new_event_loop}
)
infra.AsyncMessageBuffer = Buffer  # pyright: ignore[reportPrivateImportUsage]
infra.websockets = SimpleNamespace(  # pyright: ignore[reportAttributeAccessIssue, reportPrivateImportUsage]
    asyncio=SimpleNamespace(server=SimpleNamespace(serve=_serve)),
    datastructures=websockets.datastructures,
    exceptions=websockets.exceptions,
)


class PortlessServer(viser.ViserServer):
    """A viser server that is reached through its `door` only, and that never opens a share tunnel.

    loop: runs in another thread, and serves the scene; with None, viser makes a loop of its own.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop | None = None) -> None:
        # viser prints to stdout, which belongs to the command line.
        rich.get_console().quiet = True
        self.door = Door()
        with _making:
            _lent[:] = [] if loop is None else [loop]
            super().__init__(host=self.door, port=0, label="lineseg", verbose=False)
        if self.door.loop is None:
            self.stop()
            raise RuntimeError(f"viser {viser.__version__} opened a port of its own; install version 1.1.1")

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None
