"""Lets work in the background take turns."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager


class Turns:
    """Threads work one at a time, and together for at most `share` of the time: each turn is followed by a rest."""

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
                self._free_at = ended + self._rest * (ended - begun)
