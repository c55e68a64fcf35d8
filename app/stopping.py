"""Ctrl-C and SIGTERM end a command at any moment, also while it is still loading."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

AGAIN_SECONDS = 0.02


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
