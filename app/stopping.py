"""Ctrl-C and SIGTERM end a command at any moment, also while it is still loading."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

AGAIN_SECONDS = 0.02
_abandoned: list[threading.Thread] = []


def abandon(thread: threading.Thread) -> None:
    """Wait no longer for a thread that does not end, because a library in it waits for another machine."""
    _abandoned.append(thread)


def end_if_stuck(code: int) -> None:
    """End the process here if an abandoned thread still runs: Python would stop it inside its library, which aborts."""
    if any(thread.is_alive() for thread in _abandoned):
        for stream in (sys.stdout, sys.stderr):
            with suppress(OSError, ValueError):
                stream.flush()
        os._exit(code)


@contextmanager
def interruptible(terminated: int) -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt, SIGTERM SystemExit with the code `terminated`.

    Compilation runs many finalisers, and Python only prints the exceptions they raise; one that is lost so comes again
    a moment later. A signal that another program handles, or that a background job ignores, is left alone.
    """
    again: list[threading.Timer] = []

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    def terminate(number: int, frame: FrameType | None) -> None:
        raise SystemExit(terminated)

    def unraisable(lost: Any) -> None:
        number = {KeyboardInterrupt: signal.SIGINT, SystemExit: signal.SIGTERM}.get(lost.exc_type)
        if number is None:
            former_hook(lost)
            return
        again.append(threading.Timer(AGAIN_SECONDS, os.kill, (os.getpid(), number)))
        again[-1].start()

    usual = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
    taken = [number for number, handler in usual.items() if signal.getsignal(number) is handler]
    former_hook, sys.unraisablehook = sys.unraisablehook, unraisable
    for number in taken:
        signal.signal(number, interrupt if number == signal.SIGINT else terminate)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, usual[number])
        for timer in again:
            timer.cancel()
        sys.unraisablehook = former_hook
