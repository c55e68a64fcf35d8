"""The authors' released program, with a switch for each departure from the paper.

Gao, Zhang, Fang, Yuan 2018, their ROS package. With every switch on, it behaves as released; with `ends_early`,
`two_more_points` and `skips_after_erased` off, its bugs are fixed. The form of its lines, y = k·x + c, affects the
result only if the cross moment is exactly 0, see `slope_form`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Annotated, NamedTuple

import numpy as np

from ..kernel import entry_kernel, kernel
from ..knobs import Thresholds, switch
from ..params import Delta, Epsilon, MinLength, MinPoints, SeedPoints
from ..region_growing.checks import CHECKS, DELTA, END, EPSILON, MERGE_ANGLE, MIN_LENGTH, MIN_POINTS, NEARER, NONE
from ..region_growing.lines import DROPPED, LINE, Dropping, append, drop, line_at, remove
from ..scan import Scan
from ..total_least_squares import Moments, add, empty, line_of, project, signed_distance
from ..tracing.log import ROW, note, note_pair, written
from ..tracing.vocabulary import Kind, Vocabulary
from .endpoints import place_endpoints
from .logged import LoggedMethod, Run

# [rad], fixed in the program.
PARALLEL = 0.1


@dataclass(frozen=True)
class AuthorsParams(Thresholds):
    """Thresholds with the names and values of the launch file, and a switch for each departure from the paper."""

    epsilon: Epsilon = 0.03
    delta: Delta = 0.10
    seed_points: SeedPoints = 6
    min_points: MinPoints = 10
    min_length: MinLength = 0.60
    every_beam: Annotated[
        bool,
        switch("1", "beams without a return are points", "Treats each dropout as a point, where a line then ends."),
    ] = True
    slope_form: Annotated[
        bool,
        switch(
            "2",
            "lines as y = kx + c",
            "Fits a vertical line if the cross moment is exactly 0, even to a horizontal wall.",
        ),
    ] = True
    line_first: Annotated[
        bool,
        switch("3", "line distance before predicted distance", "Tests ε before δ in a seed. The result is the same."),
    ] = True
    ends_early: Annotated[
        bool,
        switch(
            "4", "never to the first or last beam",
            "Ends a line that reaches the last beam one beam early, and fits it without its last point. A line that "
            "reaches beam 0 starts at beam 1.",
        ),
    ] = True  # fmt: skip
    two_more_points: Annotated[
        bool, switch("5", "P_min + 2 points", "Requires last − first > P_min: two points more than P_min.")
    ] = True
    raw_length: Annotated[
        bool,
        switch("5′", "length between raw points", "Compares L_min with the distance between the measured end points."),
    ] = True
    any_pair: Annotated[
        bool,
        switch(
            "7",
            "merge any overlapping pair",
            "Merges nearly parallel lines that overlap even if they are not neighbours.",
        ),
    ] = True
    unchecked_cuts: Annotated[
        bool, switch("7′", "P_min unchecked after a cut", "Keeps a line that has too few points after a cut.")
    ] = True
    skips_after_erased: Annotated[
        bool,
        switch(
            "8",
            "skip the line after an erased one",
            "Does not check the line after one that was erased as too short.",
        ),
    ] = True


class Rules(NamedTuple):
    """`AuthorsParams` as the kernels take them."""

    epsilon: float
    delta: float
    seed_points: int
    min_points: int
    min_length: float
    every_beam: bool
    slope_form: bool
    line_first: bool
    ends_early: bool
    two_more_points: bool
    raw_length: bool
    any_pair: bool
    unchecked_cuts: bool
    skips_after_erased: bool


SEED_REJECTED, SEED_FOUND, GROWTH_STOPPED, END_REACHED, LINE_KEPT, LINE_DROPPED = range(6)
LINES_MERGED, LINES_KEPT_APART, OVERLAP_CUT, LINE_ERASED, PASSED_OVER, ENDPOINTS = range(6, 12)
VOCABULARY = Vocabulary(
    (
        Kind("seed rejected", "seed", "none", "refusal", "no seed: {span}; beam {beam}, {value:.3f} > {limit:.3f} m"),
        Kind("seed found", "seed", "shown", "seed", "seed found: {span}"),
        Kind(
            "growth stopped", "growth", "shown", "refusal",
            "growth stopped at beam {beam}: {value:.3f} m from the line, ε = {limit:.3f} m; now {span}",
        ),
        Kind("end reached", "growth", "shown", "", "growth reached the end of the scan; the line has {span}"),
        Kind("line kept", "growth", "stands", "line", "line kept: {span}, {value:.3f} m ≥ L_min = {limit:.3f} m"),
        Kind("line dropped", "growth", "gone", "drop", "line dropped: {span}; {refusal}"),
        Kind("lines merged", "overlap", "joined", "merge", "lines merged: {value:deg} apart; now {span}"),
        Kind("lines kept apart", "overlap", "none", "", "overlapping lines not merged: {value:deg} apart"),
        Kind(
            "overlap cut", "overlap", "parted", "cut",
            "overlap cut at beam {beam}, {value:.3f} m from the first line, {limit:.3f} m from the second",
        ),
        Kind("line erased", "overlap", "gone", "drop", "line erased: {span}; {refusal}"),
        Kind("line passed over", "overlap", "none", "", "line not checked: {span} follows an erased line"),
        Kind("endpoints", "endpoints", "placed", "", "endpoints placed: {span}, {limit:.3f} m apart"),
    ),
    CHECKS,
)  # fmt: skip


def run(scan: Scan, params: AuthorsParams, logged: bool) -> Run:
    """The same lines as the authors' program."""
    beam = np.arange(len(scan)) if params.every_beam else np.flatnonzero(scan.valid)
    ranges, rays = scan.ranges[beam].astype(np.float64), np.ascontiguousarray(scan.rays[:, beam])
    rules = Rules(*(getattr(params, name) for name in Rules._fields))
    lines, dropped = np.empty(len(beam) + 1, LINE), np.empty(2 * len(beam) + 1, DROPPED)
    xy, used = np.empty((2, len(beam))), np.zeros(1, np.int32)
    call = partial(extract_lines, ranges, rays, rules, xy, lines, dropped, used)
    count, rows = written(call, 4 * len(beam) + 64) if logged else (call(None), np.empty(0, ROW))
    return Run(lines[:count], dropped[: used[0]], beam, rows)


AUTHORS = LoggedMethod("authors", VOCABULARY, run)


@entry_kernel
def extract_lines(ranges, rays, rules, xy, lines, dropped, used, log):
    """Number of lines among the points at `ranges` (n,) along `rays` (2, n); xy (2, n) is memory for them."""
    x, y = xy[0], xy[1]
    for k in range(len(ranges)):
        x[k], y[k] = ranges[k] * rays[0, k], ranges[k] * rays[1, k]
    used[0] = 0
    dropping = Dropping(dropped, used)
    count = grow_lines(x, y, ranges, rays, rules, lines, dropping, log)
    count = merge(x, y, lines, count, rules, log)
    count = cut(x, y, lines, count, rules, dropping, log)
    count = erase(x, y, lines, count, rules, dropping, log)
    place_endpoints(x, y, lines, count, ENDPOINTS, log)
    return count


@kernel
def grow_lines(x, y, ranges, rays, rules, lines, dropped, log):
    """Find each seed and grow it to its end. With `every_beam`, the last start is N − P_min − 1."""
    count = candidate = start = 0
    least = rules.min_points + 2 if rules.two_more_points else rules.min_points
    stop = len(x) - max(rules.min_points, rules.seed_points) + (0 if rules.every_beam else 1)
    while start < stop:
        if not is_seed(x, y, ranges, rays, start, rules, candidate, log):
            start += 1
            continue
        first, last, line = grow(x, y, start, rules, candidate, log)
        n, length = last - first + 1, length_of(x, y, first, last, line, rules)
        check, value, limit = NONE, length, rules.min_length
        if n < least:
            check, value, limit = MIN_POINTS, float(n), float(least)
        elif length < rules.min_length:
            check = MIN_LENGTH
        if check == NONE:
            count = append(lines, count, first, last, candidate, line)
        else:
            drop(dropped, first, last, check, value, limit)
        if log is not None:
            kind = LINE_KEPT if check == NONE else LINE_DROPPED
            note(log, kind, check, candidate, 0, (first, last), -1, line, value, limit)
        start = last + 1 if n >= least else start + 1
        candidate += 1
    return count


@kernel
def fit(m, rules):
    """The line through the moments; in slope form it is upright if the cross moment is exactly 0."""
    if rules.slope_form and m.n * m.sxy == m.sx * m.sy:
        x = m.x0 + m.sx / m.n
        return (1.0, 0.0, -x) if x >= 0.0 else (-1.0, 0.0, x)
    return line_of(m)


@kernel
def sums(x, y, first, last):
    """Moments of first..last about the laser: a wrong number of points then shifts the line as in the program."""
    m = empty(0.0, 0.0)
    for k in range(first, last + 1):
        m = add(m, x[k], y[k])
    return m


@kernel
def is_seed(x, y, ranges, rays, first, rules, candidate, log):
    """Whether all points of the window are close to the line and to their predicted points; NaN counts as close."""
    last = first + rules.seed_points - 1
    line = fit(sums(x, y, first, last), rules)
    for k in range(first, last + 1):
        off = abs(signed_distance(line, x[k], y[k]))
        away = abs(ranges[k] + line[2] / (line[0] * rays[0, k] + line[1] * rays[1, k]))
        too_far, off_line = away > rules.delta, off > rules.epsilon
        if too_far or off_line:
            if log is not None:
                by_line = off_line and (rules.line_first or not too_far)
                check, value, limit = (EPSILON, off, rules.epsilon) if by_line else (DELTA, away, rules.delta)
                note(log, SEED_REJECTED, check, candidate, 0, (first, last), k, line, value, limit)
            return False
    if log is not None:
        note(log, SEED_FOUND, NONE, candidate, 0, (first, last), -1, line, 0.0, 0.0)
    return True


@kernel
def grow(x, y, seed, rules, candidate, log):
    """(first, last, line): grow forward while points lie nearer than ε, then backward."""
    first, last = seed, seed + rules.seed_points - 1
    m = sums(x, y, first, last)
    while last + 1 < len(x) and abs(signed_distance(fit(m, rules), x[last + 1], y[last + 1])) < rules.epsilon:
        last += 1
        m = add(m, x[last], y[last])
    line = fit(m, rules)
    note_stop(x, y, first, last, last + 1, line, 1, rules, candidate, log)
    if rules.ends_early and last == len(x) - 1:
        # The point stays in the sums, and in the line until the next fit.
        last -= 1
        m = Moments(m.x0, m.y0, m.n - 1.0, m.sx, m.sy, m.sxx, m.sxy, m.syy)
    while first > 0 and abs(signed_distance(line, x[first - 1], y[first - 1])) < rules.epsilon:
        first -= 1
        m = add(m, x[first], y[first])
        line = fit(m, rules)
    note_stop(x, y, first, last, first - 1, line, -1, rules, candidate, log)
    if rules.ends_early and first == 0 and seed > 0:
        first = 1
    return first, last, fit(sums(x, y, first, last), rules)


@kernel
def note_stop(x, y, first, last, beyond, line, direction, rules, candidate, log):
    if log is None:
        return
    if 0 <= beyond < len(x):
        value = abs(signed_distance(line, x[beyond], y[beyond]))
        note(log, GROWTH_STOPPED, EPSILON, candidate, direction, (first, last), beyond, line, value, rules.epsilon)
    else:
        note(log, END_REACHED, END, candidate, direction, (first, last), -1, line, 0.0, 0.0)


@kernel
def length_of(x, y, first, last, line, rules):
    """Length between the outermost points, as measured or projected."""
    if rules.raw_length:
        return math.hypot(x[last] - x[first], y[last] - y[first])
    x1, y1 = project(line, x[first], y[first])
    x2, y2 = project(line, x[last], y[last])
    return math.hypot(x2 - x1, y2 - y1)


@kernel
def merge(x, y, lines, count, rules, log):
    """Merge lines that overlap and are nearly parallel, without checking residuals."""
    p = 0
    while p < count:
        q = p + 1
        while q < count and (q == p + 1 or rules.any_pair):
            if lines[p].last >= lines[q].first and merged(x, y, lines, p, q, rules, log):
                count = remove(lines, count, q)
            else:
                q += 1
        p += 1
    return count


@kernel
def merged(x, y, lines, p, q, rules, log):
    line, other = line_at(lines, p), line_at(lines, q)
    angle = math.asin(min(1.0, abs(line[0] * other[1] - line[1] * other[0])))
    pair = lines[p].candidate, lines[q].candidate
    if angle < PARALLEL:
        refit(x, y, lines, p, min(lines[p].first, lines[q].first), lines[q].last, rules)
        if log is not None:
            span = lines[p].first, lines[p].last
            note_pair(log, LINES_MERGED, MERGE_ANGLE, pair, span, -1, line_at(lines, p), other, angle, PARALLEL)
        return True
    if log is not None:
        span = lines[p].first, lines[p].last
        note_pair(log, LINES_KEPT_APART, MERGE_ANGLE, pair, span, -1, line, other, angle, PARALLEL)
    return False


@kernel
def cut(x, y, lines, count, rules, dropped, log):
    """Cut neighbours that still overlap at the first point that is nearer to the second line."""
    for p in range(count - 1):
        first, last, start = lines[p].first, lines[p].last, lines[p + 1].first
        if last < start:
            continue
        line, other = line_at(lines, p), line_at(lines, p + 1)
        k, here, there = start, 0.0, 0.0
        while k <= last:
            here, there = abs(signed_distance(line, x[k], y[k])), abs(signed_distance(other, x[k], y[k]))
            if here > there:
                break
            k += 1
        refit(x, y, lines, p, first, k - 1, rules)
        refit(x, y, lines, p + 1, k, lines[p + 1].last, rules)
        if log is not None:
            pair, span = (lines[p].candidate, lines[p + 1].candidate), (first, k - 1)
            mine, others = line_at(lines, p), line_at(lines, p + 1)
            note_pair(log, OVERLAP_CUT, NEARER, pair, span, k, mine, others, here, there)
    return count


@kernel
def refit(x, y, lines, i, first, last, rules):
    """Assign the points first..last to line i; with fewer than 2 points the fit does not change."""
    lines[i].first, lines[i].last = first, last
    if last > first:
        lines[i].a, lines[i].b, lines[i].c = fit(sums(x, y, first, last), rules)


@kernel
def erase(x, y, lines, count, rules, dropped, log):
    """Remove lines that are too short; the line after a removed one is not checked."""
    i = 0
    while i < count:
        first, last, line = lines[i].first, lines[i].last, line_at(lines, i)
        check, value, limit = NONE, length_of(x, y, first, last, line, rules), rules.min_length
        if value < limit:
            check = MIN_LENGTH
        elif not rules.unchecked_cuts and last - first + 1 < rules.min_points:
            check, value, limit = MIN_POINTS, float(last - first + 1), float(rules.min_points)
        if check == NONE:
            i += 1
            continue
        if log is not None:
            note(log, LINE_ERASED, check, lines[i].candidate, 0, (first, last), -1, line, value, limit)
        drop(dropped, first, last, check, value, limit)
        count = remove(lines, count, i)
        if rules.skips_after_erased and i < count:
            if log is not None:
                span = lines[i].first, lines[i].last
                note(log, PASSED_OVER, NONE, lines[i].candidate, 0, span, -1, line_at(lines, i), 0.0, 0.0)
            i += 1
    return count
