"""Line segment extraction by seeded region growing.

Gao, Zhang, Fang, Yuan: A line segment extraction algorithm using laser data based on seeded region growing.
Int. J. Advanced Robotic Systems 15(1), 2018, DOI 10.1177/1729881418755245.
"""

from __future__ import annotations

import threading
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..params import Params
from ..scan import Scan
from ..total_least_squares import line_through
from ..tracing.log import note, written
from .acceptance import shortfall
from .checks import LINE_DROPPED, LINE_KEPT, NONE
from .endpoints import place_endpoints
from .growth import grow
from .limits import limits_of, unpacked
from .lines import DROPPED, LINE, Dropping, append, drop
from .overlap import resolve_overlaps
from .points import points_of
from .seed import NOWHERE, find_seed


class Run(NamedTuple):
    """The output of one run. first and last are positions; beam: (m,) int32 maps positions to beams.

    points: number of valid beams, without those on ignored objects.
    """

    lines: NDArray
    dropped: NDArray
    beam: NDArray[np.int32]
    points: int
    log: NDArray | None


@entry_kernel
def extract_lines(ranges, rays, range_min, range_max, around, limits, xy, numbers, lines, dropped, log):
    """Run the four procedures: (number of lines, of dropped candidates, of points, of valid beams).

    ranges, rays, around: of a `Scan`; limits: see `limits_of`; the rest is `Memory`.
    """
    limits = unpacked(limits)
    lines, dropped = lines.view(LINE), Dropping(dropped.view(DROPPED), numbers[3])
    dropped.used[0] = 0
    points = points_of(ranges, rays, range_min, range_max, around, limits, xy, numbers)
    count = grow_lines(points, limits, lines, dropped, log)
    count = resolve_overlaps(points, lines, count, dropped, limits, log)
    place_endpoints(points, lines, count, log)
    return count, dropped.used[0], points.period, points.returns


@kernel
def grow_lines(points, limits, lines, dropped, log):
    """Find each seed and grow it to its end, from the first point to the last."""
    count = candidate = 0
    start = points.start
    stop = start + points.period
    if points.around == 0:
        stop -= max(limits.min_points, limits.seed_points) - 1
    elif points.period < 2 * limits.seed_points:
        stop = start
    while True:
        seed, scatter = find_seed(points, start, stop, limits, candidate, log)
        if seed < 0:
            return count
        first, last, scatter = grow(points, seed, scatter, limits, candidate, log)
        enough_points = last - first + 1 >= limits.min_points
        line = NOWHERE
        # Most candidates have too few points, and only the log needs their line.
        if enough_points or log is not None:
            line = line_through(scatter)
        check, value, limit = shortfall(points, first, last, line, limits)
        if check == NONE:
            count = append(lines, count, first, last, candidate, line)
        else:
            drop(dropped, first, last, check, value, limit)
        if log is not None:
            kind = LINE_KEPT if check == NONE else LINE_DROPPED
            note(log, kind, check, candidate, 0, (first, last), -1, line, value, limit)
        start = last + 1 if enough_points else seed + 1
        candidate += 1


class Memory:
    """The memory of the kernels, for scans of up to `beams` beams.

    xy, numbers: the points, see `points_of`; lines, dropped: (capacity,) of LINE and DROPPED.
    """

    def __init__(self, beams: int, circle: bool) -> None:
        self.beams, self.circle = beams, circle
        places = (4 * beams if circle else beams) + 1
        self.xy = np.empty((6, places))
        self.numbers = np.empty((6, places), np.int32)
        self.lines = np.empty(beams + 1, LINE)
        self.dropped = np.empty(2 * beams + 1, DROPPED)
        self.arguments = self.xy, self.numbers, self.lines.view(np.float64), self.dropped.view(np.float64)

    def written(self, lines: int, dropped: int) -> tuple[NDArray[np.void], NDArray[np.void]]:
        """Copies of the first lines and dropped candidates."""
        # As plain numbers, because numpy copies structured rows field by field.
        _, _, line_numbers, dropped_numbers = self.arguments
        found = line_numbers[: LINE.itemsize // 8 * lines].copy().view(LINE)
        return found, dropped_numbers[: DROPPED.itemsize // 8 * dropped].copy().view(DROPPED)

    @classmethod
    def of_thread(cls, beams: int, circle: bool) -> Memory:
        """The memory that this thread keeps for its next scan; one of its own for a scan of very many beams."""
        if beams > MOST_KEPT:
            return cls(beams, circle)
        kept: Memory = getattr(_THREAD, "memory", NO_MEMORY)
        if kept.beams < beams or (circle and not kept.circle):
            kept = _THREAD.memory = cls(max(beams, kept.beams), circle or kept.circle)
        return kept


# Scans of more beams than this are rare, and their memory is not worth keeping.
MOST_KEPT = 20_000
_THREAD = threading.local()
NO_MEMORY = Memory(0, circle=False)


def run(scan: Scan, params: Params, logged: bool = False) -> Run:
    """Extract the lines of one scan; log every decision if `logged`."""
    around = scan.around
    memory = Memory.of_thread(len(scan), around > 0)
    ranges, nearest, farthest = scan.ranges.astype(np.float64), float(scan.range_min), float(scan.range_max)
    scene = (ranges, scan.rays, nearest, farthest, around, limits_of(params))
    rows = None
    if logged:
        run_once = partial(extract_lines, *scene, *memory.arguments)
        (count, drops, points, _), rows = written(run_once, 4 * len(scan) + 64)
    else:
        count, drops, points, _ = extract_lines(*scene, *memory.arguments, None)
    beam = memory.numbers[0, : 4 * points] % around if around > 0 else memory.numbers[0, :points].copy()
    lines, dropped = memory.written(count, drops)
    return Run(lines, dropped, beam, points, rows)


def thin_things(scan: Scan, params: Params | None = None) -> NDArray[np.bool_]:
    """(n,) which valid beams end at objects that lines pass behind, see `look_past`."""
    kept = np.zeros(len(scan), np.bool_)
    kept[run(scan, params or Params()).beam] = True
    return scan.valid & ~kept
