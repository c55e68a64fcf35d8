"""Split-and-Merge as in the ROS package laser_line_extraction (Gallant, 2014), with a switch for each of its bugs.

Filters by range and for outliers; splits at the farthest point from the line through the ends, else at the widest gap;
fits each line weighted by the noise of its beams (Pfister et al. 2003); merges consecutive lines by the χ² distance of
their (R, α).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np

from ..kernel import entry_kernel, kernel
from ..knobs import Knob, Thresholds, switch
from ..params import MinLength, MinPoints
from ..region_growing.checks import NONE
from ..region_growing.lines import DROPPED, LINE, Dropping, line_at
from ..scan import Scan
from ..total_least_squares import project, signed_distance
from ..tracing.log import ROW, Notes, note, note_pair, written
from ..tracing.vocabulary import Check, Kind, Vocabulary
from .chord import chord
from .endpoints import measure
from .logged import LoggedMethod, Run
from .splitting import KINDS, SPLIT_CHECKS, LineGap, SplitDistance, Splitting, select, split
from .weighted_fit import Fitting, Polar, chi_squared, combined, fit_weighted


@dataclass(frozen=True)
class SplitAndMergeParams(Thresholds):
    """Thresholds with the names of the package, and a switch for each of its bugs."""

    split_distance: SplitDistance = 0.04
    max_gap: LineGap = 0.5
    min_points: MinPoints = 10
    min_length: MinLength = 0.60
    outlier_distance: Annotated[
        float,
        Knob(
            "d_out", 0.01, 1.0, "m", 0.005, log=True, least=1e-6, most=1000.0, ros="outlier_dist", scatter=2.0,
            label="range step of an outlier",
            why="a distance of 0 would make an outlier of every point",
            help="Drops a point whose range differs by more than this from both neighbours and that is off their line. "
            "Higher drops fewer points.",
        ),
    ] = 0.06  # fmt: skip
    range_noise: Annotated[
        float,
        Knob(
            "σ_r", 0.001, 0.1, "m", 0.001, log=True, least=1e-6, most=10.0, ros="range_std_dev", scatter=0.4,
            label="noise of a range",
            why="without noise no line has a covariance",
            help="Standard deviation of a range, for weighting points and comparing lines. Higher merges more lines.",
        ),
    ] = 0.012  # fmt: skip
    bearing_noise: Annotated[
        float,
        Knob(
            "σ_φ", 1e-6, 0.01, "rad", 1e-6, log=True, least=0.0, most=1.0, ros="bearing_std_dev",
            label="noise of a bearing",
            why="a standard deviation is never negative",
            help="Standard deviation of a bearing. Higher gives far points less weight and merges more lines.",
        ),
    ] = 1e-5  # fmt: skip
    merge_distance: Annotated[
        float,
        Knob(
            "χ²", 0.0, 30.0, "", 0.1, least=0.0, most=1e6,
            label="χ² that merges",
            why="a square is never negative",
            help="Consecutive lines with a smaller χ² distance are merged. Higher merges more; 0 merges none. The "
            "program uses 3.",
        ),
    ] = 3.0  # fmt: skip
    min_range: Annotated[
        float,
        Knob(
            "r_min", 0.0, 2.0, "m", 0.01, least=0.0, most=1000.0, ros="min_range",
            label="nearest range", why="a range is never negative", help="Ignores nearer points. Higher ignores more.",
        ),
    ] = 0.1  # fmt: skip
    max_range: Annotated[
        float,
        Knob(
            "r_max", 1.0, 1000.0, "m", 0.1, log=True, least=0.0, most=1e6, ros="max_range",
            label="farthest range", why="a range is never negative", help="Ignores farther points. Higher keeps more.",
        ),
    ] = 250.0  # fmt: skip
    loses_points: Annotated[
        bool,
        switch(
            "1", "each split loses points",
            "Loses the point before each split and the last point of its second part, and cuts gaps one point early.",
        ),
    ] = True  # fmt: skip
    loses_last_beam: Annotated[bool, switch("2", "the last beam is lost", "Ignores the last beam of a scan.")] = True
    unwrapped: Annotated[
        bool,
        switch(
            "3", "angles are not wrapped",
            "Never merges two lines with angles on both sides of ±π, or with opposite normals.",
        ),
    ] = True  # fmt: skip


# The program's fit has converged when it changes by less than this [m, rad].
ITERATION_STEP = 1e-4
OUTLIER, LINE_FITTED, LINES_MERGED, LINES_KEPT_APART, ENDPOINTS = range(len(KINDS), len(KINDS) + 5)
OUTLIER_DISTANCE, MERGE_DISTANCE = range(len(SPLIT_CHECKS), len(SPLIT_CHECKS) + 2)
VOCABULARY = Vocabulary(
    (
        *KINDS,
        Kind("outlier", "filter", "none", "refusal", "outlier: beam {beam} lies {value:.3f} m off its neighbours"),
        Kind("line fitted", "fit", "stands", "line", "line fitted: {span}, {points} points"),
        Kind("lines merged", "merge", "joined", "merge", "lines merged: χ² = {value:.2f} < {limit:g}; now {span}"),
        Kind("lines kept apart", "merge", "none", "", "lines not merged: χ² = {value:.3g} ≥ {limit:g}"),
        Kind("endpoints", "endpoints", "placed", "", "endpoints placed: {span}, {limit:.3f} m apart"),
    ),
    (*SPLIT_CHECKS, Check("outlier_distance"), Check("merge_distance")),
)


def run(scan: Scan, params: SplitAndMergeParams, logged: bool) -> Run:
    """The same lines as the package."""
    ranges = scan.ranges.astype(np.float64)
    near = scan.valid & (ranges >= params.min_range) & (ranges <= params.max_range)
    if params.loses_last_beam:
        near[len(scan) - 1 :] = False
    beam = np.flatnonzero(near)
    steps = np.zeros(len(beam))
    find_outliers(ranges[beam], *scan.xy[beam].T.copy(), params.outlier_distance, params.split_distance, steps)
    out, beam = beam[steps > 0], beam[steps == 0]
    n = len(beam)
    rules = Splitting(params.split_distance, params.max_gap, params.min_points, params.min_length, params.loses_points)
    merging = params.merge_distance, params.unwrapped
    how = Fitting(params.range_noise**2, params.bearing_noise**2, ITERATION_STEP, ITERATION_STEP)
    memory = np.empty((n + 2, 3), np.int64), np.empty((n + 1, 5))
    lines, dropped, used = np.empty(n + 1, LINE), np.empty(2 * n + 1, DROPPED), np.zeros(1, np.int32)
    rays, xy = np.ascontiguousarray(scan.rays[:, beam]), np.ascontiguousarray(scan.xy[beam].T)
    call = partial(extract_lines, ranges[beam], rays, xy, rules, merging, how, *memory, lines, dropped, used)
    count, rows = written(call, 4 * n + 64) if logged else (call(None), np.empty(0, ROW))
    notes = Notes()
    for k, step in enumerate(steps[steps > 0].tolist()):
        limit = params.outlier_distance
        notes.add(OUTLIER, -1, (n + k, n + k), beam=n + k, check=OUTLIER_DISTANCE, value=step, limit=limit)
    return Run(lines[:count], dropped[: used[0]], np.concatenate((beam, out)), np.concatenate((notes.rows, rows)))


SPLIT_AND_MERGE = LoggedMethod("split-and-merge", VOCABULARY, run)


@entry_kernel
def find_outliers(ranges, x, y, outlier_distance, split_distance, steps):
    """Write to `steps` (n,) the range difference between an outlier and the nearer of its two neighbours [m]."""
    n = len(ranges)
    for k in range(n if n > 2 else 0):
        i, j = (k + 1, k + 2) if k == 0 else (k - 2, k - 1) if k == n - 1 else (k - 1, k + 1)
        step = min(abs(ranges[k] - ranges[i]), abs(ranges[k] - ranges[j]))
        line = chord(x, y, i, j)
        if step > outlier_distance and abs(signed_distance(line, x[k], y[k])) > split_distance:
            steps[k] = step


@entry_kernel
def extract_lines(ranges, rays, xy, rules, merging, how, stack, models, lines, dropped, used, log):
    """Number of lines through points at `ranges` (n,) along `rays` (2, n), which are xy (2, n).

    stack (n + 2, 3), models (n + 1, 5): memory for waiting stretches and for lines in polar form.
    """
    x, y = xy[0], xy[1]
    used[0] = 0
    if len(x) <= max(rules.min_points, 3):
        return 0
    count = split(x, y, len(x) - 1, rules, stack, lines, log)
    count = select(x, y, rules, lines, count, Dropping(dropped, used), log)
    fit(x, y, ranges, rays, how, lines, models, count, log)
    count = merge(merging, lines, models, count, log)
    for i in range(count):
        measure(x, y, lines, i, ENDPOINTS, log)
    return count


@kernel
def fit(x, y, ranges, rays, how, lines, models, count, log):
    """Refit each line with weights, and project its outermost points onto it as endpoints."""
    for i in range(count):
        row = lines[i]
        polar = fit_weighted(ranges, rays[0], rays[1], row.first, row.last, line_at(lines, i), how)
        put(lines, models, i, polar)
        line = line_at(lines, i)
        row.x1, row.y1 = project(line, x[row.first], y[row.first])
        row.x2, row.y2 = project(line, x[row.last], y[row.last])
        if log is not None:
            note(log, LINE_FITTED, NONE, row.candidate, 0, (row.first, row.last), -1, line, 0.0, 0.0)


@kernel
def put(lines, models, i, polar):
    row = lines[i]
    models[i, 0], models[i, 1], models[i, 2], models[i, 3], models[i, 4] = polar
    sign = -1.0 if polar.radius < 0.0 else 1.0
    row.a, row.b, row.c = sign * math.cos(polar.angle), sign * math.sin(polar.angle), -abs(polar.radius)


@kernel
def merge(merging, lines, models, count, log):
    """Merge consecutive lines nearer than χ² into their weighted mean, and compare that with the next line."""
    limit, unwrapped = merging
    kept = 0
    for i in range(1, count):
        one = Polar(models[kept, 0], models[kept, 1], models[kept, 2], models[kept, 3], models[kept, 4])
        other = Polar(models[i, 0], models[i, 1], models[i, 2], models[i, 3], models[i, 4])
        if not unwrapped:
            other = beside(one, other)
        value = chi_squared(one, other)
        pair, span = (lines[kept].candidate, lines[i].candidate), (lines[kept].first, lines[i].last)
        line = line_at(lines, i)
        if not value < limit:
            if log is not None:
                note_pair(
                    log, LINES_KEPT_APART, MERGE_DISTANCE, pair, (lines[kept].first, lines[kept].last), -1,
                    line_at(lines, kept), line, value, limit,
                )  # fmt: skip
            kept += 1
            lines[kept] = lines[i]
            put(lines, models, kept, other)
            continue
        put(lines, models, kept, combined(one, other))
        row, mean = lines[kept], line_at(lines, kept)
        row.last = lines[i].last
        row.x1, row.y1 = project(mean, row.x1, row.y1)
        row.x2, row.y2 = project(mean, lines[i].x2, lines[i].y2)
        if log is not None:
            note_pair(log, LINES_MERGED, MERGE_DISTANCE, pair, span, -1, mean, line, value, limit)
    return kept + 1 if count > 0 else 0


@kernel
def beside(one, other):
    """The other line, in the form whose angle is nearest to that of the first."""
    turns = math.floor((other.angle - one.angle) / math.pi + 0.5)
    radius = -other.radius if turns % 2 else other.radius
    # Negating the radius also negates its covariance with the angle.
    ra = -other.ra if turns % 2 else other.ra
    return Polar(radius, other.angle - turns * math.pi, other.rr, ra, other.aa)
