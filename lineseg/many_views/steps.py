"""Where a wall steps: a door in its recess, a window or a cabinet is another wall than the one it stands in."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ..posed.walls import Walls
from .profiles import MAD, Profiles

# Length of the stretches in which steps are looked for [m], and how many of them are compared on each side.
FINE, BESIDE = 0.05, 4
# A step is higher than this [m], and so many times as high as the surface is uneven on so many stretches beside it.
LEAST_STEP, TIMES_USUAL, ALONG = 0.015, 3.0, 20
# Where boards bend, the surface jumps everywhere: a step is so many times as high as this percentile of all jumps.
TIMES_BENT, BENT = 3.0, 85
# Over so many stretches the evenness of walls is measured.
LONG = 60
# Between two steps are more stretches than this.
APART = 5
# Shorter parts are left out [m].
LEAST_PART = 0.20

Floats = NDArray[np.float64]


def divided_at_steps(pieces: Walls, wall_of: NDArray[np.int64], fine: Profiles) -> tuple[Walls, NDArray[np.int64]]:
    """The parts of the pieces between the steps, each on the line of its new wall, and the wall of each part.

    Pieces are in order along their walls; fine: their profiles, in stretches of length FINE.
    """
    known = np.flatnonzero(fine.points > 0)
    piece = fine.wall[known]
    steps = steps_in(fine.height[known], wall_of[piece])
    begins = steps | (np.diff(wall_of[piece], prepend=-1) != 0)
    wall = np.cumsum(begins) - 1
    first = np.flatnonzero(begins | (np.diff(piece, prepend=-1) != 0))
    parts, limits = np.split(known, first[1:]), np.flatnonzero(begins)
    lines = [_line_of(fine, whole) for whole in np.split(known, limits[1:])] if len(known) else []
    rows = [_part_of(pieces, fine, part, lines[wall[at]]) for part, at in zip(parts, first.tolist(), strict=False)]
    table = np.array(rows).reshape(-1, 6)
    long = table[:, 4] - table[:, 3] >= LEAST_PART
    return Walls.of(table[long]), wall[first][long]


def steps_in(height: Floats, wall: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(s,) whether the surface steps before each stretch, given the heights (s,) and the walls (s,) of all in order."""
    jump = jumps_of(height, wall)
    found = np.zeros(len(height), np.bool_)
    known = jump[np.isfinite(jump)]
    least = max(LEAST_STEP, TIMES_BENT * float(np.percentile(known, BENT))) if len(known) else LEAST_STEP
    for one in np.unique(wall[jump > least]).tolist():
        first, stop = np.searchsorted(wall, (one, one + 1))
        places = first + np.flatnonzero(jump[first:stop] > least)
        for place in places[np.argsort(-jump[places], kind="stable")].tolist():
            if not found[max(place - APART, 0) : place + APART + 1].any():
                found[place] = True
        edges = [first, *(first + np.flatnonzero(found[first:stop])).tolist(), stop]
        for before, place, after in zip(edges, edges[1:-1], edges[2:], strict=False):
            sides = height[max(before, place - ALONG) : place], height[place : min(after, place + ALONG)]
            found[place] = jump[place] > TIMES_USUAL * max(_unevenness(side) for side in sides)
    return found


def evenness(height: Floats, wall: NDArray[np.int64]) -> float:
    """How far the straightest walls lie from straight [m]: the lower quartile over long parts; 0 without a long wall.

    Without one, nothing tells bends of walls from trees and pillars.
    """
    limits = np.append(np.searchsorted(wall, np.unique(wall)), len(wall)).tolist()
    parts = [(k, k + LONG) for first, stop in pairwise(limits) for k in range(first, stop - LONG, LONG // 2)]
    return float(np.percentile([_unevenness(height[a:b]) for a, b in parts], 25)) if parts else 0.0


def _unevenness(height: Floats) -> float:
    """Robust standard deviation of heights (s,) from a line [m]."""
    number = np.arange(len(height))
    off = height - np.polyval(np.polyfit(number, height, 1), number)
    return float(np.median(np.abs(off - np.median(off)))) / MAD


def jumps_of(height: Floats, wall: NDArray[np.int64]) -> Floats:
    """(s,) how far the surface jumps before each stretch [m], NaN where it has too few stretches on either side.

    Where it bends, the medians of both sides differ, but lines through them meet: the smaller difference counts.
    """
    jump = np.full(len(height), np.nan)
    if len(height) < 2 * BESIDE:
        return jump
    windows = sliding_window_view(height, BESIDE)
    number = np.arange(BESIDE) - (BESIDE - 1) / 2
    rise = number * (BESIDE / 2) / (number @ number)
    middle, ahead, back = np.median(windows, axis=1), windows @ (1 / BESIDE + rise), windows @ (1 / BESIDE - rise)
    level, line = middle[BESIDE:] - middle[:-BESIDE], back[BESIDE:] - ahead[:-BESIDE]
    same = wall[2 * BESIDE - 1 :] == wall[: len(wall) - 2 * BESIDE + 1]
    least = np.where(level * line > 0, np.minimum(np.abs(level), np.abs(line)), 0.0)
    jump[BESIDE : len(height) - BESIDE + 1] = np.where(same, least, np.nan)
    return jump


def _line_of(fine: Profiles, whole: NDArray[np.intp]) -> tuple[float, float, float]:
    """Middle along the old line, height and slope over it, of the line through the stretches `whole` of one wall."""
    at, height = fine.at[whole], fine.height[whole]
    weights = np.minimum(fine.points[whole], 20)
    middle, mean = np.average(at, weights=weights), np.average(height, weights=weights)
    spread = np.average((at - middle) ** 2, weights=weights)
    slope = np.average((at - middle) * (height - mean), weights=weights) / max(spread, 1e-9) if len(whole) > 3 else 0.0
    return float(middle), float(mean), float(slope)


def _part_of(pieces: Walls, fine: Profiles, part: NDArray[np.intp], line: tuple[float, float, float]) -> Floats:
    """(6,) normal, offset, low, high, rms of a part: stretches of one piece, on the line of its wall."""
    middle, mean, slope = line
    piece = fine.wall[part[0]]
    (nx, ny), offset = pieces.normal[piece], pieces.offset[piece]
    turned = np.hypot(1.0, slope)
    normal = np.array((nx + slope * ny, ny - slope * nx)) / turned
    foot = np.array((nx, ny)) * (offset + mean) + np.array((-ny, nx)) * middle
    at, begin = fine.at[part], foot @ np.array((-normal[1], normal[0]))
    ends = at[0] - FINE / 2, min(at[-1] + FINE / 2, pieces.high[piece])
    rms = np.sqrt(np.mean((fine.height[part] - mean - slope * (at - middle)) ** 2)) / turned
    return np.array((*normal, foot @ normal, *(begin + (end - middle) * turned for end in ends), rms))
