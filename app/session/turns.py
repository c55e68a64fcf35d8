"""Lets work in the background take turns."""

from __future__ import annotations

import asyncio
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")

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


def in_loop(loop: asyncio.AbstractEventLoop, work: Callable[[], T]) -> T:
    """The result of short work, which is done in the thread of a running loop while the caller waits.

    numpy lets go of the interpreter at every array of more than 500 numbers. A thread beside a loop that answers
    messages would lose it each time and win it back by a switch of threads, and these took longer than a picture.
    """
    done: Future[T] = Future()

    def run() -> None:
        try:
            done.set_result(work())
        except BaseException as error:
            done.set_exception(error)

    loop.call_soon_threadsafe(run)
    return done.result()
