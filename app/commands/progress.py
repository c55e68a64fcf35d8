"""A progress bar for long work on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from lineseg.readers import Reading, open_recording
from lineseg.scan import Recording

T = TypeVar("T")


@contextmanager
def progress_bar(what: str, unit: str) -> Iterator[Callable[[int, int], None]]:
    """A progress bar on stderr, only on a terminal and only for work that takes a while."""
    from tqdm import tqdm

    with tqdm(desc=what, unit=unit, unit_scale=True, leave=False, disable=None, delay=0.5) as bar:

        def advance(done: int, total: int) -> None:
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


def tell_by_views(said: Mapping[str, str]) -> None:
    """Print on stderr what is said of truths that many views agree on, by the files that they belong to."""
    for file, text in said.items():
        print(f"lineseg: {Path(file).name}: truth by many views: {text}", file=sys.stderr)
