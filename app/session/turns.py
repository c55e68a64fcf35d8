"""Lets work in the background take turns."""

from __future__ import annotations

import asyncio
import contextlib
import threading
import time
from collections import deque
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any

MOST_REST = 0.5


class Turns:
    """Threads work one at a time, and together for about `share` of the time: each turn is followed by a rest.

    No rest is longer than half a second, so that a single long turn does not make the others wait.
    """

    def __init__(self, share: float) -> None:
        self._rest = 1 / share - 1
        self._free_at = 0.0
        self._lock = threading.Lock()

    @contextmanager
    def turn(self) -> Iterator[None]:
        with self._lock:
            time.sleep(max(0.0, self._free_at - time.monotonic()))
            begun = time.monotonic()
            try:
                yield
            finally:
                ended = time.monotonic()
                self._free_at = ended + min(self._rest * (ended - begun), MOST_REST)


class InOrder:
    """Lets one thread in at a time, in the order in which they came; a lock may let the same one in again and again."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[threading.Lock] = deque()
        self._taken = False

    def __enter__(self) -> None:
        with self._lock:
            if not self._taken:
                self._taken = True
                return
            mine = threading.Lock()
            mine.acquire()
            self._waiting.append(mine)
        mine.acquire()

    def __exit__(self, *error: object) -> None:
        with self._lock:
            if self._waiting:
                self._waiting.popleft().release()
            else:
                self._taken = False


class Rounds:
    """Short work of many tabs in the thread of an event loop: one piece in each pass of the loop, in order of asking.

    Between two pieces the loop hears what has arrived, so that each tab draws its newest View. Threads would be slower:
    numpy lets go of the interpreter at every array of more than 500 numbers, and a thread beside a busy loop would lose
    it each time and win it back by a switch of threads, and these took longer than a picture.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.loop = loop
        self._turn = asyncio.Lock()
        self._tasks = set[asyncio.Task[None]]()

    async def __aenter__(self) -> None:
        await self._turn.acquire()

    async def __aexit__(self, *error: object) -> None:
        # In the next pass, so that what has arrived is heard before the next piece.
        self.loop.call_soon(self._turn.release)

    def start(self, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Run a coroutine in the loop; may be called in any thread. Nothing happens once the loop is closed."""

        def begin() -> None:
            task = self.loop.create_task(work())
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

        if asyncio._get_running_loop() is self.loop:
            begin()
        else:
            with contextlib.suppress(RuntimeError):
                self.loop.call_soon_threadsafe(begin)
