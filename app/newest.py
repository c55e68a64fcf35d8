"""Runs only the newest piece of work: newest wins."""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Generic, TypeVar

T = TypeVar("T")
R = TypeVar("R")
NICENESS = 10


class Newest(Generic[T]):
    """A thread that does one piece of work at a time. A newer piece replaces the waiting one; the last is always done.

    work: called in the thread for each piece; what it raises is not caught. behind: let other threads go first.
    The thread starts with the first piece.
    """

    def __init__(self, name: str, work: Callable[[T], None], behind: bool = False) -> None:
        self._work, self._behind = work, behind
        self._changed = threading.Condition()
        self._waiting: list[T] = []
        self._due = 0.0
        self._closing = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def put(self, piece: T, due: float = 0.0) -> None:
        """Do this next, but not before `due`, a time of `time.monotonic`. Ignored after `close`."""
        with self._changed:
            if self._closing:
                return
            self._waiting, self._due = [piece], due
            if not self._thread.is_alive():
                self._thread.start()
            self._changed.notify_all()

    def hold(self, due: float) -> None:
        """Do not begin the piece that waits, if any, before `due`."""
        with self._changed:
            self._due = max(self._due, due)

    def drop(self) -> None:
        """Forget the piece that waits, if any."""
        with self._changed:
            self._waiting = []

    def close(self) -> None:
        """Stop. Waits up to ten seconds for the current piece."""
        with self._changed:
            self._waiting, self._closing = [], True
            self._changed.notify_all()
            started = self._thread.is_alive()
        if started:
            self._thread.join(timeout=10)

    def _run(self) -> None:
        if self._behind:
            step_back()
        while pieces := self._next():
            self._work(pieces[0])

    def _next(self) -> list[T]:
        with self._changed:
            while not self._closing:
                rest = self._due - time.monotonic()
                if self._waiting and rest <= 0:
                    break
                self._changed.wait(rest if self._waiting else None)
            pieces, self._waiting = self._waiting, []
            return pieces


def done_behind(work: Callable[[], R]) -> R:
    """The result of work that another thread does with low priority while the caller waits.

    Only for work that leaves Python for most of its time. While a thread of low priority has the interpreter, whatever
    else keeps the machine busy holds up all other threads.
    """
    with ThreadPoolExecutor(1, initializer=step_back) as pool:
        return pool.submit(work).result()


def step_back() -> None:
    """Lower the priority of this thread and those that it starts, where threads have one."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
