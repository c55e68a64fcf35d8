"""Which lines are one: Mahalanobis' distance between lines that lie beside each other, the longest first.

A line is the height h and the slope s of (h + s·u) over a reference line, u along it. A line z with the covariance R at
u fits a map line x with the covariance P if (z − H·x)ᵀ·(H·P·Hᵀ + R)⁻¹·(z − H·x) is below the quantile of χ² for two
degrees of freedom, H = ((1, u), (0, 1)). It joins the best fitting one, by adding the information Hᵀ·R⁻¹·H.

The longest line begins, and each line is compared with the map lines near it: those of the squares around it, from a
table that grows with the map.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from .posed import Floats

# The quantile of χ² for two degrees of freedom at 99 %.
GATE = 9.21
# Lines turned by more are different walls [cosine], and so are lines farther apart than this [m].
ALIKE, FARTHEST = math.cos(math.radians(15.0)), 0.30
# Lines follow each other on one wall within this distance [m].
GAP = 0.30
# Side of the squares in which lines are looked up [m], and the most of them.
SIDE, MOST_SQUARES = 1.0, 4_000_000
# Lines between two looks at whether the work is still wanted.
CHUNK = 20_000


class _Table(NamedTuple):
    """The map lines of each square as chained entries: head (squares,), chain and line (entries,), used (1,)."""

    head: NDArray[np.int64]
    chain: NDArray[np.int64]
    line: NDArray[np.int64]
    used: NDArray[np.int64]


def joined_lines(middle: Floats, normal: Floats, half: Floats, covariance: Floats, wanted) -> NDArray[np.int64]:
    """(n,) the number of the map line that each line belongs to, the longest first.

    wanted: called now and then with the share of the work that is done; may raise.
    """
    n = len(half)
    owner = np.full(n, -1, np.int64)
    if not n:
        return owner
    low = (middle - half[:, None]).min(axis=0) - 2 * SIDE
    size = (middle + half[:, None]).max(axis=0) + 2 * SIDE - low
    side = max(SIDE, math.sqrt(float(size.prod()) / MOST_SQUARES))
    columns, rows = (int(each) + 1 for each in size / side)
    entries = int((2 * half / (side / 2) + 4).astype(np.int64).sum())
    table = _Table(
        np.full(columns * rows, -1, np.int64), np.empty(entries, np.int64), np.empty(entries, np.int64),
        np.zeros(1, np.int64),
    )  # fmt: skip
    # Reference line (x, y, nx, ny), information (3) and its vector (2), from, to.
    lines, stamps, count = np.zeros((n, 11)), np.full(n, -1, np.int64), np.zeros(1, np.int64)
    spots = np.column_stack((middle - low, normal, half))
    spreads = np.column_stack((covariance[:, 0, 0], covariance[:, 0, 1], covariance[:, 1, 1]))
    order = np.argsort(-half, kind="stable")
    for begin in range(0, n, CHUNK):
        join_lines(spots, spreads, order[begin : begin + CHUNK], side, columns, *table, lines, stamps, count, owner)
        wanted(min(begin + CHUNK, n) / n)
    return owner


@entry_kernel
def join_lines(spots, spreads, order, side, columns, head, chain, line, used, lines, stamps, count, owner):
    """See `joined_lines`."""
    for i in order:
        spot, spread = spots[i], spreads[i]
        best, found = GATE, -1
        steps = int(2 * spot[4] / side) + 1
        for k in range(steps + 1):
            at = 2 * spot[4] * k / steps - spot[4]
            column, row = int((spot[0] - spot[3] * at) / side), int((spot[1] + spot[2] * at) / side)
            for square_row in range(row - 1, row + 2):
                for square in range(square_row * columns + column - 1, square_row * columns + column + 2):
                    entry = head[square]
                    while entry >= 0:
                        number = line[entry]
                        entry = chain[entry]
                        if stamps[number] != i:
                            stamps[number] = i
                            distance = distance_of(spot, spread, lines[number])
                            if distance < best:
                                best, found = distance, number
        if found < 0:
            found = count[0]
            count[0] += 1
            for j in range(4):
                lines[found, j] = spot[j]
            lines[found, 9], lines[found, 10] = np.inf, -np.inf
        owner[i] = found
        add(spot, spread, lines[found])
        enter(spot, found, side, columns, head, chain, line, used)


@kernel
def over(spot, row):
    """Where the middle of a line is over a reference line: along it and how high, and its slope."""
    dx, dy = spot[0] - row[0], spot[1] - row[1]
    along, height = -row[3] * dx + row[2] * dy, row[2] * dx + row[3] * dy
    cos, sin = row[2] * spot[2] + row[3] * spot[3], row[3] * spot[2] - row[2] * spot[3]
    return along, height, sin / cos, cos


@kernel
def distance_of(spot, spread, row):
    """The square of Mahalanobis' distance between a line and a map line, infinite if they are not on one wall."""
    along, height, slope, cos = over(spot, row)
    if cos < ALIKE or along - spot[4] > row[10] + GAP or along + spot[4] < row[9] - GAP:
        return np.inf
    determinant = row[4] * row[6] - row[5] * row[5]
    p00, p01, p11 = row[6] / determinant, -row[5] / determinant, row[4] / determinant
    h, s = p00 * row[7] + p01 * row[8], p01 * row[7] + p11 * row[8]
    away, turned = height - h - s * along, slope - s
    if abs(away) > FARTHEST:
        return np.inf
    v00 = p00 + 2 * along * p01 + along * along * p11 + spread[0]
    v01, v11 = p01 + along * p11 + spread[1], p11 + spread[2]
    return (v11 * away * away - 2 * v01 * away * turned + v00 * turned * turned) / (v00 * v11 - v01 * v01)


@kernel
def add(spot, spread, row):
    """Add the information of a line to a map line."""
    along, height, slope, _ = over(spot, row)
    determinant = spread[0] * spread[2] - spread[1] * spread[1]
    r00, r01, r11 = spread[2] / determinant, -spread[1] / determinant, spread[0] / determinant
    row[4] += r00
    row[5] += along * r00 + r01
    row[6] += along * along * r00 + 2 * along * r01 + r11
    first, second = r00 * height + r01 * slope, r01 * height + r11 * slope
    row[7] += first
    row[8] += along * first + second
    row[9], row[10] = min(row[9], along - spot[4]), max(row[10], along + spot[4])


@kernel
def enter(spot, number, side, columns, head, chain, line, used):
    """Enter a line in the squares that it crosses, unless it is the newest one there."""
    steps = int(4 * spot[4] / side) + 1
    for k in range(steps + 1):
        at = 2 * spot[4] * k / steps - spot[4]
        square = int((spot[1] + spot[2] * at) / side) * columns + int((spot[0] - spot[3] * at) / side)
        if head[square] < 0 or line[head[square]] != number:
            line[used[0]], chain[used[0]] = number, head[square]
            head[square] = used[0]
            used[0] += 1
