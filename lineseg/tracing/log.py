"""The log of the kernels: one row for each decision, or nothing if there is no log.

A kernel compiled for `log = None` contains no logging at all; compiled for a `Log`, the same code writes rows.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel

_LINE = np.dtype([(name, np.float64) for name in ("a", "b", "c")])
_ENDS = np.dtype([(name, np.float64) for name in ("x1", "y1", "x2", "y2")])
# The fields of `Row`.
ROW = np.dtype(
    [
        *((name, np.int8) for name in ("kind", "check", "direction")),
        *((name, np.int32) for name in ("candidate", "partner", "first", "last", "beam")),
        *((name, _LINE) for name in ("line", "other")),
        ("ends", _ENDS),
        *((name, np.float64) for name in ("value", "limit")),
    ]
)

Line = tuple[float, float, float]
Ends = tuple[float, float, float, float]
NOWHERE: Line = (0.0, 0.0, 0.0)
NO_ENDS: Ends = (0.0, 0.0, 0.0, 0.0)
T = TypeVar("T")


class Row(NamedTuple):
    """A logged decision, `Row(*rows[i].item())`; `Decision` explains the fields.

    kind, check: numbers in the method's vocabulary. first, last, beam: positions. line, other: (0, 0, 0) if there is
    none; ends: four zeros unless endpoints are placed.
    """

    kind: int
    check: int
    direction: int
    candidate: int
    partner: int
    first: int
    last: int
    beam: int
    line: Line
    other: Line
    ends: Ends
    value: float
    limit: float

    @property
    def points(self) -> int:
        """Number of positions it spans."""
        return max(0, self.last - self.first + 1)


class Log(NamedTuple):
    """rows: (capacity,) of ROW; used: (1,) int64, number of rows, including those that did not fit."""

    rows: NDArray
    used: NDArray[np.int64]


@kernel
def note(log, kind, check, candidate, direction, span, beam, line, value, limit):
    """Log a decision about one candidate; span: (first, last) of the tested window, or of the line afterwards."""
    write(log, kind, check, (candidate, -1), direction, span, beam, line, (0.0, 0.0, 0.0), value, limit)


@kernel
def note_pair(log, kind, check, pair, span, beam, line, other, value, limit):
    """Log a decision about two candidates; line, other: the line of each."""
    write(log, kind, check, pair, 0, span, beam, line, other, value, limit)


@kernel
def note_ends(log, kind, candidate, span, line, ends, length):
    """Log that a line has endpoints (x1, y1, x2, y2), `length` apart."""
    i = log.used[0]
    write(log, kind, 0, (candidate, -1), 0, span, -1, line, (0.0, 0.0, 0.0), length, length)
    if i < len(log.rows):
        placed = log.rows[i].ends
        placed.x1, placed.y1, placed.x2, placed.y2 = ends


@kernel
def write(log, kind, check, pair, direction, span, beam, line, other, value, limit):
    i = log.used[0]
    log.used[0] = i + 1
    if i >= len(log.rows):
        return
    row = log.rows[i]
    row.kind, row.check, row.direction = kind, check, direction
    row.candidate, row.partner = pair
    row.first, row.last = span
    row.beam = beam
    mine, others, ends = row.line, row.other, row.ends
    mine.a, mine.b, mine.c = line
    others.a, others.b, others.c = other
    ends.x1, ends.y1, ends.x2, ends.y2 = 0.0, 0.0, 0.0, 0.0
    row.value, row.limit = value, limit


def written(call: Callable[[Log], T], rows: int) -> tuple[T, NDArray[np.void]]:
    """The result of `call`, and the rows it logged; calls it again with more memory if `rows` was too small."""
    log = Log(_rows_of_thread(rows), np.zeros(1, np.int64))
    result = call(log)
    if log.used[0] > rows:
        log = Log(np.empty(log.used[0], ROW), np.zeros(1, np.int64))
        result = call(log)
    # A copy, because few rows of the memory are used, and a trace may be kept for long. As bytes: numpy copies
    # structured rows field by field.
    return result, log.rows.view(np.uint8)[: log.used[0] * ROW.itemsize].copy().view(ROW)


# More rows than this are rarely needed, and their memory, 144 bytes each, is not worth keeping.
MOST_KEPT = 20_000
_THREAD = threading.local()


def _rows_of_thread(rows: int) -> NDArray[np.void]:
    """Memory for this many rows, which this thread keeps: to get new memory takes longer than a run writes to it."""
    if rows > MOST_KEPT:
        return np.empty(rows, ROW)
    kept: NDArray[np.void] | None = getattr(_THREAD, "rows", None)
    if kept is None or len(kept) < rows:
        kept = _THREAD.rows = np.empty(rows, ROW)
    return kept[:rows]


class Notes:
    """A log written from Python, for methods with few decisions."""

    def __init__(self) -> None:
        self._rows: list[Row] = []

    def add(
        self,
        kind: int,
        candidate: int,
        span: tuple[int, int],
        line: Line = NOWHERE,
        *,
        partner: int = -1,
        other: Line = NOWHERE,
        beam: int = -1,
        check: int = 0,
        value: float = 0.0,
        limit: float = 0.0,
    ) -> None:
        """Log a decision; see `Decision`."""
        row = Row(kind, check, 0, candidate, partner, *span, beam, line, other, NO_ENDS, value, limit)
        self._rows.append(row)

    @property
    def rows(self) -> NDArray[np.void]:
        return np.array(self._rows, ROW)
