"""The findings of a method in one frame, with the numbers that the page shows."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lineseg import EXTRACTORS, Extraction, Recording, Scan, Thresholds, Trace
from lineseg.colours import segment_colours
from lineseg.knobs import Knob
from lineseg.region_growing.checks import number_of
from lineseg.region_growing.prediction import predicted_ranges
from lineseg.region_growing.trace import GrowthTrace

BINS = 24
# The time of this thread alone, because other threads may interrupt it; it is too coarse on Windows.
CLOCK = time.thread_time if time.get_clock_info("thread_time").resolution < 1e-6 else time.perf_counter


@dataclass(frozen=True)
class Histogram:
    """Histogram of the quantity that a threshold limits; `passed` and `failed` have the same bins."""

    low: float
    high: float
    log: bool
    passed: tuple[int, ...]
    failed: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Findings:
    """One frame under a method and its thresholds. extraction_us: time of the extraction without the trace."""

    scan: Scan
    extraction: Extraction
    trace: Trace
    extraction_us: float

    @cached_property
    def seeds(self) -> dict[int, tuple[int, int]]:
        """First and last beam of the seed of each candidate; none if the method has no seeds."""
        if "seed found" not in self.trace.vocabulary.names:
            return {}
        log, found = self.trace.log, self.trace.indices("seed found")
        spans = self.trace.as_beams(np.array((log["first"][found], log["last"][found]))).T.tolist()
        return {
            candidate: (first, last)
            for candidate, (first, last) in zip(log["candidate"][found].tolist(), spans, strict=True)
        }

    @cached_property
    def drops(self) -> NDArray[np.intp]:
        """Indices of the decisions that dropped a line."""
        return self.trace.jump("drop")

    @cached_property
    def drop_spans(self) -> NDArray[np.int64]:
        """(2, drops): first and last beam of each dropped line."""
        rows = self.trace.log[self.drops]
        return self.trace.as_beams(np.maximum((rows["first"], rows["last"]), 0))

    @cached_property
    def drop_ends(self) -> NDArray[np.float64]:
        """(drops, 2, 2): the outermost points of each dropped line [m]; 0 if it has no valid beam."""
        count = len(self.drops)
        beams, drops = self.trace.beams_of(*self.drop_spans)
        outermost = np.searchsorted(drops, np.arange(count + 1))
        some = np.diff(outermost) > 0
        ends = np.zeros((count, 2, 2))
        ends[some, 0] = self.scan.xy[beams[outermost[:-1][some]]]
        ends[some, 1] = self.scan.xy[beams[outermost[1:][some] - 1]]
        return ends

    @cached_property
    def colours(self) -> NDArray[np.uint8]:
        """(segments, 3) sRGB."""
        return segment_colours(self.extraction.segments)

    @cached_property
    def marks(self) -> dict[str, list[int]]:
        """Indices of the decisions at which the replay may pause."""
        marks = {name: self.trace.jump(name).tolist() for name in ("seed", "line", "drop", "merge")}
        return marks | {"phase": self.trace.starts("phase").tolist()}

    @cached_property
    def histograms(self) -> dict[str, Histogram]:
        return histograms(self)


def findings(recording: Recording, frame: int, method: str, params: Thresholds) -> Findings:
    """Run the method on one frame."""
    return findings_in(recording[frame], method, params)


def findings_in(scan: Scan, method: str, params: Thresholds) -> Findings:
    """Run the method on a scan, which is faster if the scan is the same object for other thresholds."""
    extractor = EXTRACTORS[method]
    begun = CLOCK()
    extractor.extract(scan, params)
    elapsed = CLOCK() - begun
    trace = extractor.trace(scan, params)
    return Findings(scan, trace.extraction, trace, elapsed * 1e6)


def histograms(found: Findings) -> dict[str, Histogram]:
    """For ε and δ, every distance that was compared with it; for P_min and L_min, every line that was grown."""
    measured = _lines_measured(found)
    if isinstance(found.trace, GrowthTrace):
        measured |= _distances_measured(found, found.trace)
    params = found.trace.params
    knobs = {name: knob.reaching(getattr(params, name)) for name, _, knob in params.knobs() if name in measured}

    def of(knob: Knob, passed: NDArray | list, failed: NDArray | list) -> Histogram:
        return histogram(np.asarray(passed, float), np.asarray(failed, float), knob.low, knob.high, knob.log)

    return {name: of(knob, *measured[name]) for name, knob in knobs.items()}


def _lines_measured(found: Findings) -> dict[str, tuple[Any, Any]]:
    """(kept, dropped): the numbers of points and the lengths of all lines."""
    segments, dropped = found.extraction.segments, found.extraction.dropped
    return {
        "min_points": ([s.points for s in segments], [d.points for d in dropped if d.check == "min_points"]),
        "min_length": ([s.length for s in segments], [d.length for d in dropped if d.check == "min_length"]),
    }


def _distances_measured(found: Findings, trace: GrowthTrace) -> dict[str, tuple[Any, Any]]:
    """(accepted, refused): the distances to the line and to the predicted point."""
    to_line, to_predicted = _seed_distances(found)
    growth = trace.log["value"][trace.indices("point added")]
    return {
        "epsilon": (np.concatenate((to_line, growth)), _refused(trace, "epsilon")),
        "delta": (to_predicted, _refused(trace, "delta")),
    }


def histogram(passed: NDArray, failed: NDArray, low: float, high: float, log: bool) -> Histogram:
    """Counts in bins from low to high, logarithmic if `log`; values beyond fall into the outermost bins."""
    scale: Callable[[Any], Any] = np.log if log else np.asarray
    values = np.concatenate((passed, failed))
    known = ~np.isnan(values)
    place = (scale(np.minimum(np.maximum(values[known], low), high)) - scale(low)) / (scale(high) - scale(low))
    bins = np.minimum((place * BINS).astype(int), BINS - 1)
    split = int(np.count_nonzero(known[: len(passed)]))
    counts = (tuple(np.bincount(part, minlength=BINS).tolist()) for part in (bins[:split], bins[split:]))
    return Histogram(low, high, log, *counts)


def _seed_distances(found: Findings) -> tuple[NDArray, NDArray]:
    """Distances to the line and to the predicted point, for all points of the seeds found."""
    rows = found.trace.indices("seed found")
    if not len(rows):
        return np.empty(0), np.empty(0)
    inside, seeds = found.trace.beams_of(*np.array(list(found.seeds.values())).T)
    a, b, c = (found.trace.log["line"][name][rows[seeds]] for name in "abc")
    xy, predicted = found.scan.xy[inside], predicted_ranges((a, b, c), found.scan.rays[:, inside])
    return np.abs(a * xy[:, 0] + b * xy[:, 1] + c), np.abs(found.scan.ranges[inside] - predicted)


def _refused(trace: GrowthTrace, check: str) -> NDArray:
    rows = np.concatenate((trace.indices("seed rejected"), trace.indices("growth stopped")))
    return trace.log["value"][rows[trace.log["check"][rows] == number_of(check)]]
