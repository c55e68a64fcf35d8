"""How the kernels write their decisions down: one row each, or nothing at all if there is no log.

A kernel compiled for `log = None` has no trace of this left in it; compiled for a `Log` it is the same code, writing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel

ROW = np.dtype(
    [
        ("kind", np.int8),
        ("check", np.int8),
        ("direction", np.int8),
        ("candidate", np.int32),
        ("partner", np.int32),
        ("first", np.int32),
        ("last", np.int32),
        ("beam", np.int32),
        *((name, np.float64) for name in ("a", "b", "c", "a2", "b2", "c2", "value", "limit")),
    ]
)


Line = tuple[float, float, float]
NOWHERE: Line = (0.0, 0.0, 0.0)
T = TypeVar("T")


class Row(NamedTuple):
    """One of ROW as plain numbers: `Row(*rows[i].item())`."""

    kind: int
    check: int
    direction: int
    candidate: int
    partner: int
    first: int
    last: int
    beam: int
    a: float
    b: float
    c: float
    a2: float
    b2: float
    c2: float
    value: float
    limit: float

    @property
    def line(self) -> Line:
        return self.a, self.b, self.c

    @property
    def other(self) -> Line:
        return self.a2, self.b2, self.c2

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
    note_pair(log, kind, check, (candidate, -1), direction, span, beam, line, (0.0, 0.0, 0.0), value, limit)


@kernel
def note_pair(log, kind, check, pair, direction, span, beam, line, other, value, limit):
    """Write a decision about two candidates."""
    i = log.used[0]
    log.used[0] = i + 1
    if i >= len(log.rows):
        return
    row = log.rows[i]
    row.kind, row.check, row.direction = kind, check, direction
    row.candidate, row.partner = pair
    row.first, row.last = span
    row.beam = beam
    row.a, row.b, row.c = line
    row.a2, row.b2, row.c2 = other
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
        self._rows: list[tuple[Any, ...]] = []

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
        """Write a decision down; see `Decision`, and `ROW` for the order."""
        self._rows.append((kind, check, 0, candidate, partner, *span, beam, *line, *other, value, limit))

    @property
    def rows(self) -> NDArray[np.void]:
        return np.array(self._rows, ROW)
