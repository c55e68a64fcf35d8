"""A progress bar for long work on a terminal, and stopping with Ctrl-C."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

from lineseg.readers import Reading, open_recording
from lineseg.scan import Recording

T = TypeVar("T")
_interrupted = threading.Event()


@contextmanager
def interruptible() -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt; if a finaliser swallows it, the next step of the progress bar raises it again.

    Compilation runs many finalisers, and Python only prints the exceptions they raise.
    """

    def interrupt(number: int, frame: FrameType | None) -> None:
        _interrupted.set()
        raise KeyboardInterrupt

    def unraisable(lost: Any) -> None:
        if not issubclass(lost.exc_type, KeyboardInterrupt):
            former_hook(lost)

    _interrupted.clear()
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        # Another program's handler, or a background job that ignores Ctrl-C.
        yield
        return
    former_hook, sys.unraisablehook = sys.unraisablehook, unraisable
    signal.signal(signal.SIGINT, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        sys.unraisablehook = former_hook


@contextmanager
def progress_bar(what: str, unit: str) -> Iterator[Callable[[int, int], None]]:
    """A progress bar on stderr, only on a terminal and only for work that takes a while."""
    from tqdm import tqdm

    with tqdm(desc=what, unit=unit, unit_scale=True, leave=False, disable=None, delay=0.5) as bar:

        def advance(done: int, total: int) -> None:
            if _interrupted.is_set():
                raise KeyboardInterrupt
            bar.total = total or None
            bar.update(done - bar.n)

        yield advance


def counted(items: Iterable[T], total: int, what: str) -> Iterator[T]:
    """The items, counted by a progress bar."""
    with progress_bar(what, "scan") as advance:
        for done, item in enumerate(items):
            advance(done, total)
            yield item


def open_with_progress(file: Path, reading: Reading, tell: bool = True) -> Recording:
    """The recording of a file; tell: whether to print on stderr what cannot be, and what was skipped."""
    with progress_bar("read", "B") as advance:
        recording = open_recording(file, reading, progress=advance)
    account = recording.account
    assert account is not None
    for text in (*(notice.advice for notice in account.notices), account.skipped_text):
        if text and tell:
            print(f"lineseg: {recording.name}: {text}", file=sys.stderr)
    return recording
