"""Lets work in the background take turns."""

from __future__ import annotations

import threading
import time
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
