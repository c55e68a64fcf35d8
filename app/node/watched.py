"""A file of thresholds that is read again when it changes."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Generic, TypeVar

from lineseg import Thresholds
from lineseg.writers.params_read import given_params, params_file

T = TypeVar("T", bound=Thresholds)
# Editors and copies take less; a file that is still unusable after this is told.
WRITING_SECONDS = 0.3


class WatchedParams(Generic[T]):
    """The thresholds in `file`; a file that cannot be used, or is only partly written, leaves them as they are.

    tell: called with a sentence for each change, and for a file that stays unusable. Raises ValueError or OSError if
    the file cannot be used at the start.
    """

    def __init__(self, file: Path, kind: type[T], tell: Callable[[str], None]) -> None:
        self._file, self._kind, self._tell = file, kind, tell
        self._seen = self._mark()
        try:
            self._given, self._whole_lines = self._read()
        except ValueError as error:
            raise ValueError(f"{file}: {error}") from None
        self._wrong = ""
        self._wrong_since = 0.0

    @property
    def given(self) -> dict[str, int | float]:
        """The values in the file, by field."""
        return self._given

    def changed(self) -> bool:
        """Look at the file; whether `given` is new. Costs a few microseconds if the file did not change."""
        try:
            mark = self._mark()
            if mark == self._seen:
                self._tell_wrong()
                return False
            self._seen = mark
            if not self._file.is_file():  # reading a pipe would wait
                raise ValueError("it is no longer a file")
            given, whole_lines = self._read()
            self._check_whole(given, whole_lines)
        except (ValueError, OSError) as error:
            self._note_wrong(getattr(error, "strerror", None) or str(error))
            return False
        self._wrong = ""
        before, self._given, self._whole_lines = self._given, given, whole_lines
        if before == given:
            return False
        self._tell(f"{self._file}: {_difference(before, given)}")
        return True

    def _mark(self) -> tuple[int, int, int]:
        found = self._file.stat()
        return found.st_mtime_ns, found.st_size, found.st_ino

    def _read(self) -> tuple[dict[str, int | float], bool]:
        text = params_file(self._file)
        return given_params(text, self._kind), text.endswith("\n")

    def _check_whole(self, given: dict[str, int | float], whole_lines: bool) -> None:
        """Raises ValueError for what looks like the beginning of a file that is being written."""
        missing = [name for name in self._given if name not in given]
        if missing:
            raise ValueError(f"it no longer has {', '.join(missing)}; write every threshold that it had")
        if self._whole_lines and not whole_lines:
            raise ValueError("its last line does not end")

    def _note_wrong(self, why: str) -> None:
        if why != self._wrong:
            self._wrong, self._wrong_since = why, time.monotonic()
        self._tell_wrong()

    def _tell_wrong(self) -> None:
        """Tell it once, as soon as it has stayed so for a while."""
        if self._wrong and self._wrong_since and time.monotonic() - self._wrong_since > WRITING_SECONDS:
            self._wrong_since = 0.0
            self._tell(f"{self._file}: {self._wrong.rstrip('.')}; the old values stay")


def _difference(before: dict[str, int | float], now: dict[str, int | float]) -> str:
    names = [name for name in now if before.get(name) != now[name]]
    return ", ".join(f"{name} {before[name]:g} → {now[name]:g}" if name in before else f"{name} {now[name]:g}"
                     for name in names)  # fmt: skip
