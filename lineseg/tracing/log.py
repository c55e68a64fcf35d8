"""How the kernels write their decisions down: one row each, or nothing at all if there is no log.

A kernel compiled for `log = None` has no trace of this left in it; compiled for a `Log` it is the same code, writing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel

_LINE = np.dtype([(name, np.float64) for name in ("a", "b", "c")])
_ENDS = np.dtype([(name, np.float64) for name in ("x1", "y1", "x2", "y2")])
# The fields are those of `Row`.
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
    """A decision as it is written down, for what the fields say see `Decision`: `Row(*rows[i].item())`.

    kind, check: numbers of the method's vocabulary. first, last, beam: positions. line, other: (0, 0, 0) where there is
    none; ends: four zeros unless they are placed.
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
        """How many positions it spans."""
        return max(0, self.last - self.first + 1)


class Log(NamedTuple):
    """rows: (capacity,) of ROW; used: (1,) int64, how many there are, even where they did not fit."""

    rows: NDArray
    used: NDArray[np.int64]


@kernel
def note(log, kind, check, candidate, direction, span, beam, line, value, limit):
    """Write a decision about one candidate; span: (first, last) of the window under test, or of the line after it."""
    write(log, kind, check, (candidate, -1), direction, span, beam, line, (0.0, 0.0, 0.0), value, limit)


@kernel
def note_pair(log, kind, check, pair, span, beam, line, other, value, limit):
    """Write a decision about two candidates; line, other: the line of each."""
    write(log, kind, check, pair, 0, span, beam, line, other, value, limit)


@kernel
def note_ends(log, kind, candidate, span, line, ends, length):
    """Write down that a line has its endpoints (x1, y1, x2, y2), `length` apart."""
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
    """What `call` returns, and the rows it wrote; it is called again where `rows` were too few."""
    log = Log(np.empty(rows, ROW), np.zeros(1, np.int64))
    result = call(log)
    if log.used[0] > rows:
        log = Log(np.empty(log.used[0], ROW), np.zeros(1, np.int64))
        result = call(log)
    return result, log.rows[: log.used[0]]


class Notes:
    """A log that Python writes to, for methods whose decisions are few."""

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
        """Write a decision down; see `Decision`."""
        row = Row(kind, check, 0, candidate, partner, *span, beam, line, other, NO_ENDS, value, limit)
        self._rows.append(row)

    @property
    def rows(self) -> NDArray[np.void]:
        return np.array(self._rows, ROW)
