"""Overlap region processing (Algorithm 3)."""

from __future__ import annotations

import math

from ..kernel import kernel
from ..total_least_squares import least_squares_of, line_of, moments_of, signed_distance, squares_of
from ..tracing.log import note, note_pair
from .acceptance import shortfall
from .checks import (
    LINE_DROPPED,
    LINES_KEPT_APART,
    LINES_MERGED,
    MERGE_ANGLE,
    NEARER,
    NONE,
    OVERLAP_CUT,
    number_of,
)
from .lines import drop, line_at, remove
from .seed import is_whole

MERGE_RMS = number_of("merge_rms")


@kernel
def resolve_overlaps(points, lines, count, dropped, limits, log):
    """Merge collinear overlapping neighbours, then cut the rest; returns how many lines are left, sharing no point.

    The listing stops at the first pair without an overlap, but means every pair. On a full circle the last line is a
    neighbour of the first.
    """
    count = merge_collinear(points, lines, count, limits, log)
    count = cut_overlaps(points, lines, count, dropped, log)
    return keep_sufficient(points, lines, count, dropped, limits, log)


@kernel
def merge_collinear(points, lines, count, limits, log):
    """Merge neighbours that overlap and differ by less than `merge_angle` into one line over all points of both.

    An extension: with `merge_rms`, only if the merged line fits about as well as the two did; then also neighbours
    that are separated by a few stray points.
    """
    i = 0
    while i + 1 < count:
        if merged(points, lines, i, i + 1, 0, limits, log):
            count = remove(lines, count, i + 1)
        else:
            i += 1
    if points.around > 0 and count > 1 and merged(points, lines, count - 1, 0, points.period, limits, log):
        count = remove(lines, count, 0)
    return count


@kernel
def merged(points, lines, i, j, turn, limits, log):
    """Whether line j, `turn` positions further on, was merged into line i."""
    first, last = lines[i].first, lines[i].last
    first_2, last_2 = lines[j].first + turn, lines[j].last + turn
    if first_2 > last and not parted_by_strays(points, last, first_2, limits):
        return False
    line, other = line_at(lines, i), line_at(lines, j)
    pair = lines[i].candidate, lines[j].candidate
    start = min(first, first_2)
    stop = min(max(last, last_2), start + points.period - 1)
    check, limit = MERGE_ANGLE, limits.merge_angle
    value = angle = math.asin(min(1.0, abs(line[0] * other[1] - line[1] * other[0])))
    agree = angle < limit
    if agree and limits.merge_rms > 0.0:
        squares = squares_of(points.x, points.y, first, last, line)
        squares += squares_of(points.x, points.y, first_2, last_2, other)
        rms = math.sqrt(squares / (last - first + last_2 - first_2 + 2))
        value = math.sqrt(least_squares_of(moments_of(points.x, points.y, start, stop)) / (stop - start + 1))
        # On walls without noise both rms are 0 and cannot grow by a factor.
        check, limit = MERGE_RMS, limits.merge_rms * max(rms, 0.1 * limits.epsilon)
        agree = value <= limit
    # On a full circle the same line may have been grown on both sides of the seam.
    if not agree and not (first == first_2 and last == last_2):
        if log is not None:
            note_pair(log, LINES_KEPT_APART, check, pair, (first, last), -1, line, other, value, limit)
        return False
    refit(points, lines, i, start, stop)
    if log is not None:
        line = line_at(lines, i)
        note_pair(log, LINES_MERGED, MERGE_ANGLE, pair, (start, stop), -1, line, other, angle, limits.merge_angle)
    return True


@kernel
def parted_by_strays(points, last, first, limits):
    """Whether at most `max_dropout` points and no break lie between two lines (an extension)."""
    few = first - last - 1 <= limits.max_dropout
    return limits.merge_rms > 0.0 and few and is_whole(points, last, first, limits)


@kernel
def cut_overlaps(points, lines, count, dropped, log):
    """Cut overlapping neighbours; a line without points is removed, and its neighbours are compared with each other."""
    i = 0
    while i + 1 < count:
        swallowed = cut(points, lines, i, i + 1, 0, dropped, log)
        if swallowed >= 0:
            count = remove(lines, count, swallowed)
            i = max(i - 1, 0)
        else:
            i += 1
    while points.around > 0 and count > 1:
        swallowed = cut(points, lines, count - 1, 0, points.period, dropped, log)
        if swallowed < 0:
            break
        count = remove(lines, count, swallowed)
    return count


@kernel
def cut(points, lines, i, j, turn, dropped, log):
    """Cut line i from line j, `turn` positions further on, at the first shared point that is not nearer to line i.

    Returns the line that has no points left, or −1. If line j starts before line i, the points before line i are not
    shared.
    """
    first, last = lines[i].first, lines[i].last
    first_2, last_2 = lines[j].first + turn, lines[j].last + turn
    start, stop = max(first, first_2), min(last, last_2) + 1
    if start >= stop:
        return -1
    line, other = line_at(lines, i), line_at(lines, j)
    k = start
    here = there = 0.0
    while k < stop:
        here = abs(signed_distance(line, points.x[k], points.y[k]))
        there = abs(signed_distance(other, points.x[k], points.y[k]))
        if here >= there:
            break
        k += 1
    if k == first:
        return swallow(lines, i, j, there, here, dropped, log)
    if k == last_2 + 1:
        return swallow(lines, j, i, here, there, dropped, log)
    refit(points, lines, i, first, k - 1)
    refit(points, lines, j, k - turn, lines[j].last)
    if log is not None:
        line, other = line_at(lines, i), line_at(lines, j)
        pair = lines[i].candidate, lines[j].candidate
        note_pair(log, OVERLAP_CUT, NEARER, pair, (first, k - 1), k, line, other, here, there)
    return -1


@kernel
def swallow(lines, i, j, to_other, to_own, dropped, log):
    """Log that line i leaves all its points to line j, which is nearer."""
    first, last, line = lines[i].first, lines[i].last, line_at(lines, i)
    if log is not None:
        note(log, LINE_DROPPED, NEARER, lines[i].candidate, 0, (first, last), -1, line, to_own, to_other)
    drop(dropped, first, last, NEARER, to_own, to_other)
    return i


@kernel
def refit(points, lines, i, first, last):
    """Assign the positions first..last to line i; with fewer than 2 points the fit does not change."""
    lines[i].first, lines[i].last = first, last
    if last > first:
        lines[i].a, lines[i].b, lines[i].c = line_of(moments_of(points.x, points.y, first, last))


@kernel
def keep_sufficient(points, lines, count, dropped, limits, log):
    """Drop lines that no longer meet P_min and L_min."""
    i = 0
    while i < count:
        first, last = lines[i].first, lines[i].last
        check, value, limit = shortfall(points, first, last, line_at(lines, i), limits)
        if check == NONE:
            i += 1
            continue
        if log is not None:
            note(log, LINE_DROPPED, check, lines[i].candidate, 0, (first, last), -1, line_at(lines, i), value, limit)
        drop(dropped, first, last, check, value, limit)
        count = remove(lines, count, i)
    return count
