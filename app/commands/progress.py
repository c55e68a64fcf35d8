"""A progress bar for long work on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from lineseg.readers import Reading, open_recording
from lineseg.readers.walling import with_walls_if_any
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


def tell_by_views(file: str, taken: bool, said: str) -> None:
    """Print on stderr what is said of a truth that many views agree on, or why a recording is left without; "" for no
    word.
    """
    if said:
        print(f"lineseg: {Path(file).name}: {'' if taken else 'no '}truth by many views: {said}", file=sys.stderr)


def open_with_truth(file: Path, reading: Reading) -> Recording:
    """The recording of a file, with the truth by many views where it has no other; tells so."""
    recording = open_with_progress(file, reading)
    with progress_bar("truth", "step") as advance:
        recording, said = with_walls_if_any(recording, advance)
    tell_by_views(recording.name, recording.wall is not None, said)
    return recording
