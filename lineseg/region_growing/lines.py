"""The output of the kernels: lines and dropped candidates."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel

# All fields have 8 bytes, so the arrays reach the kernels as plain numbers, which numba takes in half the time.
LINE = np.dtype(
    [
        *((name, np.int64) for name in ("first", "last", "candidate")),
        *((name, np.float64) for name in ("a", "b", "c", "x1", "y1", "x2", "y2", "length", "rms")),
    ]
)
DROPPED = np.dtype(
    [
        *((name, np.int64) for name in ("first", "last", "check")),
        *((name, np.float64) for name in ("value", "limit")),
    ]
)


class Dropping(NamedTuple):
    """rows: (capacity,) of DROPPED; used: (1,) int32, number of rows."""

    rows: NDArray
    used: NDArray[np.int32]


@kernel
def line_at(lines, i):
    """(a, b, c) of line i."""
    return lines[i].a, lines[i].b, lines[i].c


@kernel
def append(lines, count, first, last, candidate, line):
    row = lines[count]
    row.first, row.last, row.candidate = first, last, candidate
    row.a, row.b, row.c = line
    return count + 1


@kernel
def remove(lines, count, i):
    for k in range(i, count - 1):
        lines[k] = lines[k + 1]
    return count - 1


@kernel
def drop(dropped, first, last, check, value, limit):
    row = dropped.rows[dropped.used[0]]
    row.first, row.last, row.check = first, last, check
    row.value, row.limit = value, limit
    dropped.used[0] += 1
