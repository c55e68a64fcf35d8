"""How long extraction takes, compared with the floor: the work that no implementation of the method can avoid."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter_ns
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from ..extractors import extract, trace
from ..kernel import keep
from ..params import Params
from ..region_growing import Memory, extract_lines
from ..region_growing.limits import limits_of
from ..scan import Recording, Scan
from ..survey import cores, survey
from .against import Against

FRAMES = 300
# A shorter survey would mostly measure the start of its threads.
SURVEY_BEAMS = 4_000_000
ROUNDS = 9
# The row of another program.
OTHER = "against"

# A pass over all frames; returns the time of each [ns]. A survey returns one value, their mean.
Pass = Callable[[], NDArray[np.float64]]


@dataclass(frozen=True)
class Timing:
    """Time of one frame [µs]: median, 95 %, minimum, maximum; ratio to the floor; frames per second.

    ratio: minimum time of each frame over that of the floor. The two run in turns, so drift cancels, and other load
    can only add time. A survey uses all cores, the floor one.
    """

    name: str
    median_us: float
    p95_us: float
    min_us: float
    max_us: float
    ratio: float
    frames_per_s: float
    cores: int


# Written separately, so that faster kernels do not change this yardstick.
@keep
@njit(nogil=True, error_model="numpy", fastmath={"contract"})
def floor_pass(x, y):
    """Add each point to the sums and fit the direction anew, as the method must at every point that it accepts."""
    total = n = sx = sy = sxx = sxy = syy = 0.0
    for k in range(len(x)):
        dx, dy = x[k] - x[0], y[k] - y[0]
        n, sx, sy = n + 1.0, sx + dx, sy + dy
        sxx, sxy, syy = sxx + dx * dx, sxy + dx * dy, syy + dy * dy
        half, xy = 0.5 * (n * (sxx - syy) - (sx * sx - sy * sy)), n * sxy - sx * sy
        root = math.sqrt(half * half + xy * xy)
        if half >= 0.0:
            total += half + root + xy
        else:
            total += xy + root - half
    return total


def bench(
    recording: Recording, params: Params | None = None, rounds: int = ROUNDS, against: str | None = None
) -> list[Timing]:
    """Times of the floor, of one frame in several ways, and of the whole recording.

    Single frames are up to FRAMES of the recording; for a survey they are repeated until there are SURVEY_BEAMS.
    against: command of another program to time on the same frames, see `Against`; raises AgainstError.
    """
    params = params or Params()
    scans = [recording[frame] for frame in np.unique(np.linspace(0, len(recording) - 1, FRAMES, dtype=int))]
    floor = _floor(scans)
    floor()
    timings, floors = [], []

    def time(name: str, used: int, run: Pass) -> None:
        run()
        before, times = zip(*((floor(), run()) for _ in range(rounds)), strict=True)
        floors.extend(before)
        timings.append(_timing(name, used, np.array(times), np.array(before)))

    for name, used, run in _passes(scans, params):
        time(name, used, run)
    if against is not None:
        with Against(against, scans) as other:
            time(OTHER, 1, other.run)
    return [_timing("floor", 1, np.array(floors), np.array(floors)), *timings]


def table(timings: list[Timing]) -> str:
    """The timings as text, one per line."""
    lines = [f"{'µs a frame':<22}{'median':>9}{'p95':>9}{'min':>9}{'max':>9}{'× floor':>9}{'frames/s':>11}{'cores':>7}"]
    for t in timings:
        times = "".join(f"{value:9.2f}" for value in (t.median_us, t.p95_us, t.min_us, t.max_us, t.ratio))
        lines.append(f"{t.name:<22}{times}{t.frames_per_s:11,.0f}{t.cores:7}")
    return "\n".join(lines)


def _timing(name: str, used: int, times: NDArray[np.float64], floor: NDArray[np.float64]) -> Timing:
    """times, floor: (rounds, frames) [ns], or (rounds, 1) for a survey."""
    ratio = times.min(axis=0).mean() / floor.min(axis=0).mean()
    least, median, p95, most = (float(value) / 1e3 for value in np.percentile(times, (0, 50, 95, 100)))
    return Timing(name, median, p95, least, most, float(ratio), 1e6 / median, used)


def _passes(scans: list[Scan], params: Params) -> Iterator[tuple[str, int, Pass]]:
    """(name, cores, pass) of everything that is timed besides the floor."""
    yield "kernel", 1, _kernel(scans, params)
    yield "extract", 1, _each(lambda scan: extract(scan, params), scans)
    yield "trace", 1, _each(lambda scan: trace(scan, params), scans)
    repeats = -(-SURVEY_BEAMS // max(sum(map(len, scans)), 1))
    repeated = Recording.from_scans(scans * min(repeats, 10_000))
    for name, scores in (("survey", False), ("survey with scores", True)):
        yield name, cores(), _whole(lambda scores=scores: survey(repeated, params, scores=scores), len(repeated))


def _floor(scans: list[Scan]) -> Pass:
    points = [np.ascontiguousarray(scan.xy[scan.valid].T) for scan in scans]
    return _each(lambda xy: floor_pass(xy[0], xy[1]), points)


def _kernel(scans: list[Scan], params: Params) -> Pass:
    """One call of the compiled code from Python, with memory at hand; preparing the points is part of it."""
    memory = Memory(max(map(len, scans)), any(scan.full_circle for scan in scans))
    scenes = [
        (scan.ranges.astype(np.float64), scan.rays, scan.range_min, scan.range_max, scan.around) for scan in scans
    ]
    limits = limits_of(params)
    return _each(lambda scene: extract_lines(*scene, limits, *memory.arguments, None), scenes)


def _each(call: Callable[[Any], object], items: list) -> Pass:
    def run() -> NDArray[np.float64]:
        times = np.empty(len(items))
        for i, item in enumerate(items):
            before = perf_counter_ns()
            call(item)
            times[i] = perf_counter_ns() - before
        return times

    return run


def _whole(call: Callable[[], object], frames: int) -> Pass:
    def run() -> NDArray[np.float64]:
        before = perf_counter_ns()
        call()
        return np.array([(perf_counter_ns() - before) / frames])

    return run
