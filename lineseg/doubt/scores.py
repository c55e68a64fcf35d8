"""The scores without truth, each with its kernel, from a frame and the one before it."""

from __future__ import annotations

import math
from collections import namedtuple
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..region_growing import grow_lines
from ..region_growing.limits import loosened, near, unpacked
from ..region_growing.lines import line_at
from ..region_growing.overlap import resolve_overlaps
from ..region_growing.points import Points
from ..total_least_squares import squared_distance

# A score must not follow the threshold it judges, so these do not depend on merge_angle and max_gap.
SPLIT_ANGLE = 0.1
SPLIT_GAP = 0.3
LOOSER = 2.0
NEAR_EPSILON = 0.5
LEAST_GAP = 0.3
CHANGE_OF_THRESHOLD = 0.05


@dataclass(frozen=True)
class Score:
    """The name and meaning of a score; worse: whether higher or lower values are doubtful.

    least: smallest difference between frames that matters; weight: its weight in the suspicion; counts: whether its
    value itself is the doubt, not how far it stands out. See suspicion.py.
    """

    name: str
    label: str
    unit: str
    help: str
    worse: Literal["higher", "lower"]
    least: float
    weight: float
    counts: bool = False


SCORES = {
    score.name: score
    for score in [
        Score("segments", "segments", "", "Number of segments.", "lower", least=2.0, weight=0.0),
        Score(
            "coverage", "coverage", "",
            "Share of the valid beams that belong to a segment.",
            "lower", least=0.05, weight=0.0,
        ),
        Score(
            "invalid", "invalid beams", "", "Share of the beams without a return.", "higher", least=0.1, weight=2.0
        ),
        Score(
            "rms", "largest rms", "m",
            "Largest root mean square distance from the points of a segment to its line.",
            "higher", least=0.003, weight=0.0,
        ),
        Score(
            "splits", "over-split neighbours", "",
            f"Pairs of neighbouring segments on one line: less than {SPLIT_ANGLE} rad and {SPLIT_GAP} m apart, "
            f"with facing endpoints within {LOOSER:g}·ε of each other's line.",
            "higher", least=0.5, weight=0.0,
        ),
        Score(
            "gap", "widest gap bridged", "m",
            f"Largest difference between a gap inside a segment and the wider of the two gaps next to it. "
            f"Gaps of up to {LEAST_GAP:g} m do not count.",
            "higher", least=0.2, weight=0.0,
        ),
        Score(
            "misses", "probable misses", "",
            f"Lines found in the points without a segment when ε and δ are {LOOSER:g} times as large.",
            "higher", least=0.5, weight=0.0,
        ),
        Score(
            "change", "change", "",
            "Share of the covered bearings that changed segment since the previous frame.",
            "higher", least=0.05, weight=0.0,
        ),
        Score(
            "near", "fits near ε", "",
            f"Segments with a root mean square distance above {NEAR_EPSILON:g}·ε: they only just fit.",
            "higher", least=0.5, weight=0.0,
        ),
        Score(
            "brief", "short-lived lines", "m",
            "Total length of the segments that neither the previous nor the next frame has, after correcting for "
            "motion.",
            "higher", least=0.3, weight=0.0,
        ),
        Score(
            "gone", "interrupted lines", "m",
            "Total length of the segments that the previous and the next frame have and this one lacks, after "
            "correcting for motion.",
            "higher", least=0.3, weight=0.0,
        ),
        Score(
            "jump", "jump of the count", "",
            "How many more, or fewer, segments the frame has than both the previous and the next frame.",
            "higher", least=1.0, weight=0.0,
        ),
        Score(
            "jolt", "jolt", "rad",
            "Angle by which the sensor turned to this frame and back again to the next, estimated from the segments. "
            "It is suspicious by how much it exceeds the usual turns of the recording.",
            "higher", least=0.1, weight=6.0,
        ),
        Score(
            "turn", "turn", "rad",
            "Angle by which the sensor turned since the previous frame, estimated from the segments.",
            "higher", least=0.1, weight=0.0,
        ),
        Score(
            "unstable", "unstable segments", "",
            f"Largest number of segments that appear or disappear when one threshold changes by "
            f"{CHANGE_OF_THRESHOLD:.0%}, "
            "or by at least 1 if it is a whole number.",
            "higher", least=0.5, weight=0.0,
        ),
        Score(
            "disputed", "disputed lines", "",
            "Lines missed or false, on average, if each of six careful extractions were the truth: they use 0.8 to "
            "1.6 times the ε that fits this laser, and join the pieces of a wall.",
            "higher", least=1.0, weight=1.0, counts=True,
        ),
        Score(
            "lapsed", "undisputed lines interrupted", "m",
            "Total length of the interrupted lines that three of the same six extractions find in the previous frame, "
            "and of which this frame shows enough: nothing nearer hides a part of them, and its own segments do not "
            "cover most of their beams.",
            "higher", least=0.5, weight=3.0,
        ),
        Score(
            "blank", "walls of a frame without lines", "",
            "Lines that the same six extractions find, on average, in a frame that has no segment.",
            "higher", least=0.5, weight=6.0, counts=True,
        ),
    ]
}  # fmt: skip
# The column of each score, as a named tuple because kernels cannot look up names in a dict.
COLUMN = namedtuple("Columns", SCORES)(*range(len(SCORES)))


class Spans(NamedTuple):
    """low, high: (capacity,) [rad] bearings where the segments of a frame start and end, rising; used: (1,) number of
    segments, −1 if there is no frame."""

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    used: NDArray[np.int64]


@kernel
def coverage_of(lines, count, points):
    """Valid beams in segments / valid beams; 0 if no beam is valid."""
    covered = 0
    for i in range(count):
        covered += lines[i].last - lines[i].first + 1
    return covered / points.returns if points.returns > 0 else 0.0


@kernel
def invalid_share(points, beams):
    """Invalid beams / beams; 1 if there are no beams."""
    return 1.0 - points.returns / beams if beams > 0 else 1.0


@kernel
def largest_rms(lines, count):
    """max over segments of √(Σd² / points) [m]; 0 without segments."""
    largest = 0.0
    for i in range(count):
        largest = max(largest, lines[i].rms)
    return largest


@kernel
def fits_near_epsilon(lines, count, limits):
    """Number of segments with √(Σd² / points) > NEAR_EPSILON·ε, with ε at the range of their middle."""
    found = 0
    for i in range(count):
        x, y = 0.5 * (lines[i].x1 + lines[i].x2), 0.5 * (lines[i].y1 + lines[i].y2)
        found += lines[i].rms > NEAR_EPSILON * math.sqrt(near(limits, x * x + y * y))
    return found


@kernel
def over_split(lines, count, circle, limits, pairs):
    """Number of pairs of neighbouring segments that are one line cut in two; on a full circle the last and the first
    are neighbours. Writes the first segment of each pair to `pairs`, up to its length."""
    neighbours = count if circle and count > 1 else count - 1
    found = 0
    for i in range(neighbours):
        if are_one_line(lines, i, i + 1 if i + 1 < count else 0, limits):
            if found < len(pairs):
                pairs[found] = i
            found += 1
    return found


@kernel
def are_one_line(lines, i, j, limits):
    """Whether segment j continues segment i.

    With (x₂, y₂) the end of i and (x₁, y₁) the start of j: |sin of the angle between the lines| < sin SPLIT_ANGLE,
    |(x₁, y₁) − (x₂, y₂)| ≤ SPLIT_GAP, and each of the two points lies within LOOSER·ε of the other's line.
    """
    line, other = line_at(lines, i), line_at(lines, j)
    x, y, x_next, y_next = lines[i].x2, lines[i].y2, lines[j].x1, lines[j].y1
    return (
        (abs(line[0] * other[1] - line[1] * other[0]) < math.sin(SPLIT_ANGLE))
        & ((x_next - x) ** 2 + (y_next - y) ** 2 <= SPLIT_GAP**2)
        & (squared_distance(line, x_next, y_next) <= LOOSER**2 * near(limits, x_next**2 + y_next**2))
        & (squared_distance(other, x, y) <= LOOSER**2 * near(limits, x**2 + y**2))
    )


@entry_kernel
def find_splits(segments, circle, limits, pairs):
    """`over_split` of the segments of a survey; limits: see `limits_of`."""
    return over_split(segments, len(segments), circle, unpacked(limits), pairs)


@kernel
def widest_gap(lines, count, points):
    """max over the neighbouring points p of each segment of |pₖ₊₁ − pₖ| − max(|pₖ − pₖ₋₁|, |pₖ₊₂ − pₖ₊₁|) [m], or 0.

    On a wall seen at a grazing angle all points are far apart, so the difference stays small. Steps of LEAST_GAP or
    less do not count.
    """
    widest = 0.0
    for i in range(count):
        first, last = lines[i].first, lines[i].last
        # Few segments have such a step; only these are examined step by step.
        if wide_steps(points.x[first : last + 1], points.y[first : last + 1]) == 0:
            continue
        before, here = 0.0, squared_step(points, first)
        for k in range(first, last):
            behind = squared_step(points, k + 1) if k + 1 < last else 0.0
            if here > LEAST_GAP**2:
                widest = max(widest, math.sqrt(here) - math.sqrt(max(before, behind)))
            before, here = here, behind
    return widest


@kernel
def wide_steps(x, y):
    """Number of steps of more than LEAST_GAP."""
    found = 0
    x_next, y_next = x[1:], y[1:]
    for k in range(len(x_next)):
        dx, dy = x_next[k] - x[k], y_next[k] - y[k]
        found += dx * dx + dy * dy > LEAST_GAP**2
    return found


@kernel
def squared_step(points, k):
    """|pₖ₊₁ − pₖ|² [m²]."""
    dx, dy = points.x[k + 1] - points.x[k], points.y[k + 1] - points.y[k]
    return dx * dx + dy * dy


@kernel
def probable_misses(lines, count, points, limits, dropped):
    """Number of lines found with LOOSER·ε and LOOSER·δ in the runs of points without a segment.

    A run lies between two neighbouring segments, before the first or after the last. Each is searched by itself, with
    P_min, L_min and the other limits unchanged. Writes them to the rows of `lines` from `count` on; overwrites
    `dropped`.
    """
    looser = loosened(limits, LOOSER)
    found = 0
    start, stop = points.start, points.start + points.period
    if points.around > 0 and count > 0:
        # The run that contains the opening comes after the last segment.
        start, stop = lines[0].first, lines[0].first + points.period
    for i in range(count + 1):
        end = lines[i].first if i < count else stop
        if end - start >= max(limits.min_points, limits.seed_points):
            found += lines_in(points, start, end, looser, lines[count + found :], dropped)
        if i < count:
            start = lines[i].last + 1
    return found


@kernel
def lines_in(points, start, end, limits, lines, dropped):
    """Number of lines in the positions start..end − 1, searched by themselves and written to `lines`."""
    run = Points(
        points.x[start:end],
        points.y[start:end],
        points.beam[start:end],
        points.breaks[start:end],
        0,
        end - start,
        0,
        end - start,
    )
    dropped.used[0] = 0
    count = resolve_overlaps(run, lines, grow_lines(run, limits, lines, dropped, None), dropped, limits, None)
    for i in range(count):
        row = lines[i]
        row.first += start
        row.last += start
    return count


@kernel
def spans_of(lines, count, points, bearings, spans):
    """Store the bearings (n,) [rad] where segments start and end; past the seam of a full circle they keep rising."""
    n, around = len(bearings), max(points.around, len(bearings))
    falling = n > 1 and bearings[n - 1] < bearings[0]
    turn = -2.0 * math.pi if falling else 2.0 * math.pi
    spans.used[0] = count
    for i in range(count):
        first, last = points.beam[lines[i].first], points.beam[lines[i].last]
        one = bearings[first % around] + first // around * turn
        other = bearings[last % around] + last // around * turn
        k = count - 1 - i if falling else i
        spans.low[k], spans.high[k] = min(one, other), max(one, other)


@kernel
def change_of(now, before, circle):
    """1 − Σ|Bᵢ ∩ B′ⱼ| / |∪B ∪ ∪B′|, in [0, 1]; 0 if neither frame has a segment, and for the first frame.

    B, B′: intervals of bearings of the segments in this and the previous frame. The sum is over pairs that count as
    the same segment: those whose intersection is more than half of their union.
    """
    if before.used[0] < 0:
        return 0.0
    covered = covered_by(now) + covered_by(before)
    common = same = 0.0
    for turn in range(-1 if circle else 0, 2 if circle else 1):
        shared, kept = shared_by(now, before, 2.0 * math.pi * turn)
        common += shared
        same += kept
    union = covered - common
    return max(0.0, 1.0 - same / union) if union > 0.0 else 0.0


@kernel
def covered_by(spans):
    total = 0.0
    for i in range(spans.used[0]):
        total += spans.high[i] - spans.low[i]
    return total


@kernel
def shared_by(now, before, turn):
    """Overlap [rad] of the intervals of both frames: of all of them, and of the pairs that are the same segment."""
    common = same = 0.0
    j = 0
    for i in range(now.used[0]):
        low, high = now.low[i] - turn, now.high[i] - turn
        while j < before.used[0] and before.high[j] <= low:
            j += 1
        k = j
        while k < before.used[0] and before.low[k] < high:
            shared = min(high, before.high[k]) - max(low, before.low[k])
            together = max(high, before.high[k]) - min(low, before.low[k])
            common += shared
            same += shared if 2.0 * shared > together else 0.0
            k += 1
    return common, same


@kernel
def score_frame(lines, count, points, beams, limits, dropped, now, before, scores):
    """Write the SCORES of a frame that do not need the next frame to `scores` (len(SCORES),)."""
    scores[COLUMN.segments] = count
    scores[COLUMN.coverage] = coverage_of(lines, count, points)
    scores[COLUMN.invalid] = invalid_share(points, beams)
    scores[COLUMN.rms] = largest_rms(lines, count)
    scores[COLUMN.splits] = over_split(lines, count, points.around > 0, limits, points.beam[:0])
    scores[COLUMN.gap] = widest_gap(lines, count, points)
    scores[COLUMN.misses] = probable_misses(lines, count, points, limits, dropped)
    scores[COLUMN.change] = change_of(now, before, points.around > 0)
    scores[COLUMN.near] = fits_near_epsilon(lines, count, limits)
