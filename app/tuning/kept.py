"""Results of long work that many tabs ask for, such as a class that opens one recording."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar
from weakref import WeakKeyDictionary

from lineseg import Recording

T = TypeVar("T")


class Kept(Generic[T]):
    """The newest results for each recording; those of a recording that is closed go with it.

    Who asks for what another thread is working out waits for it. most: results kept for each recording.
    """

    def __init__(self, most: int = 24) -> None:
        self._most = most
        self._lock = threading.Lock()
        self._known: WeakKeyDictionary[Recording, OrderedDict[Hashable, T]] = WeakKeyDictionary()
        self._turns: dict[tuple[Recording, Hashable], threading.Lock] = {}

    def get(self, recording: Recording, key: Hashable, work: Callable[[], T]) -> T:
        """Return the result for `key`, from `work` if it is new. What `work` raises is passed on, and nothing kept."""
        with self._lock:
            turn = self._turns.setdefault((recording, key), threading.Lock())
        with turn:
            try:
                return self._known_or(recording, key, work)
            finally:
                with self._lock:
                    self._turns.pop((recording, key), None)

    def _known_or(self, recording: Recording, key: Hashable, work: Callable[[], T]) -> T:
        with self._lock:
            known = self._known.setdefault(recording, OrderedDict())
            if key in known:
                known.move_to_end(key)
                return known[key]
        found = work()
        with self._lock:
            known[key] = found
            if len(known) > self._most:
                known.popitem(last=False)
        return found
