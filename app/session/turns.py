"""Lets work in the background take turns."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

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
