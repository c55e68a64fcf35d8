"""Splitting stretches of points until each is straight; shared by the split methods."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel
from ..knobs import Knob
from ..region_growing.acceptance import length_of
from ..region_growing.checks import CHECKS, MIN_LENGTH, MIN_POINTS, NONE
from ..region_growing.lines import append, drop, line_at
from ..scan import Scan
from ..total_least_squares import line_of, moments_of
from ..tracing.log import note, note_pair
from ..tracing.vocabulary import Check, Kind
from .chord import chord, farthest, widest_step

SplitDistance = Annotated[
    float,
    Knob(
        "d_split", 0.005, 0.3, "m", 0.001, log=True, least=1e-6, most=100.0, ros="min_split_dist", scatter=1.3,
        label="distance that splits",
        why="a distance of 0 would split at every point",
        help="Splits a stretch at its farthest point if that lies at least this far from the line through its ends. "
        "Higher splits less.",
    ),
]  # fmt: skip
LineGap = Annotated[
    float,
    Knob(
        "G_max", 0.05, 5.0, "m", 0.01, log=True, least=1e-6, most=1000.0, ros="max_line_gap",
        label="gap that splits",
        why="a gap of 0 would separate every point from the next",
        help="Splits a stretch at a gap at least this wide between neighbouring points. Higher splits less.",
    ),
]  # fmt: skip


class Splitting(NamedTuple):
    """The limits for splits and for keeping lines.

    loses_points: whether each split loses two points; by_fit: whether to test straightness against the fitted line
    instead of the line through the ends. The line through the ends always decides where to split.
    """

    split_distance: float
    max_gap: float
    min_points: int
    min_length: float
    loses_points: bool = False
    by_fit: bool = False


FARTHEST, WIDEST_GAP, SPLIT, POINT_LEFT, STRETCH_KEPT, LINE_DROPPED = range(6)
# The vocabulary of every split method begins with these.
KINDS = (
    Kind("farthest point", "split", "shown", "", "farthest of {span}: beam {beam}, {value:.3f} ≥ {limit:.3f} m off"),
    Kind("widest gap", "split", "shown", "", "widest gap of {span}: {value:.3f} ≥ {limit:.3f} m, at beam {beam}"),
    Kind("split", "split", "parted", "seed", "split at beam {beam}: the first part is {span}"),
    Kind("point left", "split", "gone", "", "beam {first} is left over as a single point"),
    Kind("stretch kept", "split", "stands", "", "straight: {span}, all within {value:.3f} < {limit:.3f} m"),
    Kind("line dropped", "select", "gone", "drop", "line dropped: {span}; {refusal}"),
)
SPLIT_CHECKS = (*CHECKS, Check("split_distance"), Check("max_gap"))
SPLIT_DISTANCE, LINE_GAP = range(len(CHECKS), len(CHECKS) + 2)


def loop_of(scan: Scan) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """(beams with a return, their points (2, n)); a full circle starts at its farthest point, which is a corner."""
    beam = np.flatnonzero(scan.valid)
    if scan.full_circle and len(beam):
        beam = np.roll(beam, -int(np.argmax(scan.ranges[beam])))
    return beam, np.ascontiguousarray(scan.xy[beam].T)


@kernel
def fitted(x, y, first, last):
    """The total least squares line through the points first..last."""
    return line_of(moments_of(x, y, first, last))


@kernel
def split(x, y, last_point, rules, stack, lines, log):
    """Number of straight stretches of the points 0..last_point, split at farthest points, else at gaps.

    stack: (n + 2, 3) int64, memory for waiting stretches.
    """
    count, waiting, names = 0, 1, 1
    stack[0, 0], stack[0, 1], stack[0, 2] = 0, last_point, 0
    while waiting > 0:
        waiting -= 1
        first, last, name = stack[waiting, 0], stack[waiting, 1], stack[waiting, 2]
        if last <= first:
            if log is not None and last == first:
                note(log, POINT_LEFT, NONE, name, 0, (first, last), -1, chord(x, y, first, last), 0.0, 0.0)
            continue
        line = chord(x, y, first, last)
        place, away = farthest(x, y, first, last, line)
        if rules.by_fit:
            # In a bent stretch the point farthest from the fit often lies next to an end; it would be split off alone.
            line = fitted(x, y, first, last)
            other, away = farthest(x, y, first, last, line)
            place = other if place == first else place
        behind, gap = widest_step(x, y, first, last)
        check, value, limit = NONE, away, rules.split_distance
        if away >= rules.split_distance:
            check = SPLIT_DISTANCE
        elif gap >= rules.max_gap:
            check, value, limit = LINE_GAP, gap, rules.max_gap
            # The program splits one point early, except for a gap at the start.
            place = behind - 1 if rules.loses_points and first < behind - 1 else behind
        if check == NONE:
            count = append(lines, count, first, last, name, line)
            if log is not None:
                note(log, STRETCH_KEPT, NONE, name, 0, (first, last), -1, line, value, limit)
            continue
        if log is not None:
            kind = FARTHEST if check == SPLIT_DISTANCE else WIDEST_GAP
            note(log, kind, check, name, 0, (first, last), place, line, value, limit)
        end, stop = (place - 2, last - 1) if rules.loses_points else (place - 1, last)
        if log is not None and end >= first and stop >= place:
            parts = chord(x, y, first, end), chord(x, y, place, stop)
            note_pair(log, SPLIT, check, (name, names), (first, end), place, *parts, value, limit)
        stack[waiting, 0], stack[waiting, 1], stack[waiting, 2] = place, stop, names
        stack[waiting + 1, 0], stack[waiting + 1, 1], stack[waiting + 1, 2] = first, end, name
        waiting, names = waiting + 2, names + 1
    return count


@kernel
def select(x, y, rules, lines, count, dropped, log):
    """Drop lines that are too short between their ends or have too few points."""
    kept = 0
    for i in range(count):
        first, last = lines[i].first, lines[i].last
        if rules.by_fit:
            length = length_of(x, y, first, last, line_at(lines, i))
        else:
            length = math.hypot(x[last] - x[first], y[last] - y[first])
        check, value, limit = MIN_LENGTH, length, rules.min_length
        if value >= limit:
            check, value, limit = MIN_POINTS, float(last - first + 1), float(rules.min_points)
        if value >= limit:
            lines[kept] = lines[i]
            kept += 1
            continue
        drop(dropped, first, last, check, value, limit)
        if log is not None:
            note(log, LINE_DROPPED, check, lines[i].candidate, 0, (first, last), -1, line_at(lines, i), value, limit)
    return kept
