"""Counts in how many lines a survey differs from a committee: extractions made with care, taken for the truth in turn.

A judge is region growing at an ε near the one that fits the noise of the recording (`propose`), and joins the pieces
of a wall that is seen past objects. The seeds of four judges are long, so that no line begins on clutter. Long seeds
find no room on a short piece of wall between chairs, so those of the fifth are as long as usual. Far walls have few and
noisy points: the sixth begins on as few as a piece has, and its ε is nowhere below what the noise there asks for
(`fitting_everywhere`). What judges find does not depend on the thresholds that are judged, so it is computed once for a
recording and kept.

As in the truth, a segment on a wall that just misses P_min or L_min is not false.

Frame by frame, their faults have a mean rank correlation of 0.70 with those that the truth counts, and of 0.73 with
those that it counts strictly (`tests/benchmarks/suspicion.py`). Judges of other methods made it no better, nor did
judges with a larger ε at all ranges: they find hedges, too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple, Self
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording
from ..doubt.neighbours import VOTES, mark_frame, moved, views_of
from ..doubt.scores import COLUMN
from ..doubt.visible import is_there, shows_enough
from ..kernel import entry_kernel, kernel
from ..noise import RangeNoise
from ..params import Params
from ..proposal import LOWEST, propose, rescaled
from ..scan import Recording
from ..total_least_squares import Scatter, line_through, signed_distance
from ..truth import SHORT, demands_of
from .difference import length_of, shared_beams
from .geometry import geometry_of
from .result import Survey
from .threads import survey

# ε of the judges with long seeds, as multiples of the one that fits; the seeds of one more, with that ε, are as usual.
SPREAD = (0.8, 1.0, 1.25, 1.6)
SEED_POINTS = 10
# The least that a piece of a wall may be: points, and length [m]. The seeds of a last judge are no longer than that.
PIECE_POINTS, PIECE_LENGTH = 4, 0.15
# An ε that grows faster than this with the range [m/m] takes in what stands before far walls.
MOST_GROWTH = 0.05
# Two pieces less than this apart [m] are one wall if one line fits both; as many pieces of others may lie between them.
APART = 0.3
AHEAD = 8
# A line that only this frame lacks counts if so many judges find it in the previous one.
CONFIRMING = 3
WALL = np.dtype(
    [
        *((name, np.int32) for name in ("first", "last", "points")),
        *((name, np.float32) for name in ("length", "x1", "y1", "x2", "y2")),
    ]
)


class Walls(NamedTuple):
    """The lines of one judge. rows: array of WALL, frame after frame; offsets: (frames + 1,)."""

    rows: NDArray[np.void]
    offsets: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Committee:
    """The judges of a recording: their thresholds, and the lines of those that have been surveyed so far."""

    judges: tuple[Params, ...]
    walls: list[Walls]

    @classmethod
    def of_some(cls, part: Recording, judges: tuple[Params, ...]) -> Self:
        """These judges on a few frames of their recording."""
        return cls(judges, [walls_of(part, judge, threads=1) for judge in judges])

    @property
    def complete(self) -> bool:
        return len(self.walls) == len(self.judges)

    def walls_in(self, frame: int) -> list[NDArray[np.void]]:
        """The lines of each judge in a frame."""
        return [rows[offsets[frame] : offsets[frame + 1]] for rows, offsets in self.walls]


_KNOWN: WeakKeyDictionary[Recording, Committee] = WeakKeyDictionary()


def judges_of(recording: Recording) -> tuple[Params, ...]:
    """The judges' thresholds, found once and kept as long as the recording.

    Where no ε can be proposed, such as with few frames, they are near the default ε.
    """
    return _begun(recording).judges


def _begun(recording: Recording) -> Committee:
    known = _KNOWN.get(recording)
    if known is not None:
        return known
    need_recording(recording)
    found = propose(recording)
    fitting = found.fitting if isinstance(found.fitting, Params) else Params()
    pieces = fitting.but(min_points=PIECE_POINTS, min_length=PIECE_LENGTH)
    careful = pieces.but(seed_points=SEED_POINTS)
    far = fitting_everywhere(pieces.but(seed_points=PIECE_POINTS), found.noise)
    judges = (*(rescaled(careful, factor) for factor in SPREAD), pieces, far)
    return _KNOWN.setdefault(recording, Committee(judges, []))


def fitting_everywhere(params: Params, noise: RangeNoise) -> Params:
    """`params` where ε grows with the range so much that it is at least LOWEST times the noise wherever that is known.

    The noise of many lasers is the same up to some range and several times as large beyond. The ε that fits a recording
    follows a smooth law, below the noise of the farther part, and grows less than that, to keep doors out of walls.
    """
    middles = 0.5 * (noise.edges[:-1] + noise.edges[1:])
    lacking = (LOWEST * noise.sigma) ** 2 - params.epsilon**2
    told = np.isfinite(lacking) & (lacking > 0.0)
    growth = np.sqrt(lacking[told]) / middles[told]
    return params.but(epsilon_growth=min(float(growth.max(initial=params.epsilon_growth)), MOST_GROWTH))


def known_committee(recording: Recording) -> Committee | None:
    """The committee of a recording if it has been computed to the end."""
    known = _KNOWN.get(recording)
    return known if known is not None and known.complete else None


def committee_of(
    recording: Recording,
    cancelled: NDArray[np.bool_] | None = None,
    progress: Callable[[int, int], None] | None = None,
    threads: int | None = None,
) -> Committee:
    """The committee of a recording, computed once and kept as long as the recording; see `survey` for the arguments.

    When it was stopped, the next call goes on with the judge that was interrupted.
    """
    found = _begun(recording)
    while not found.complete:
        done = len(found.walls)
        walls = walls_of(recording, found.judges[done], cancelled, threads)
        # Another thread may have done the same.
        if len(found.walls) == done:
            found.walls.append(walls)
        if progress is not None:
            progress(len(found.walls), len(found.judges))
    return found


def walls_of(
    recording: Recording, judge: Params, cancelled: NDArray[np.bool_] | None = None, threads: int | None = None
) -> Walls:
    """The lines that one judge finds in each frame."""
    pieces = survey(recording, judge, cancelled, scores=False, threads=threads)
    rows, taken = np.empty(len(pieces.segments), WALL), np.empty(len(pieces.segments), np.int32)
    counts = np.zeros(len(pieces), np.int64)
    used = join_frames(pieces.segments, pieces.offsets, judge.epsilon, judge.epsilon_growth, taken, rows, counts)
    return Walls(rows[:used].copy(), np.concatenate(([0], np.cumsum(counts))))


def with_disputes(
    recording: Recording,
    base: Survey,
    cancelled: NDArray[np.bool_] | None = None,
    progress: Callable[[int, int], None] | None = None,
    threads: int | None = None,
) -> Survey:
    """The survey with the scores "disputed", "lapsed" and "blank", by the committee of the recording; see `survey`.

    The first call for a recording takes about as long as six surveys, any later one milliseconds. Raises ValueError
    for a survey without scores, `Cancelled` when stopped.
    """
    base.need_scores()
    committee = committee_of(recording, cancelled, progress, threads)
    return disputed(recording, base, committee, np.arange(len(recording)))


def disputed(recording: Recording, base: Survey, committee: Committee, frames: NDArray[np.integer]) -> Survey:
    """The survey of some frames of what the committee knows, with the scores that it gives them.

    recording: these frames; frames: (len(recording),) their numbers for the committee. A survey of triples of
    neighbouring frames has the right "lapsed" in the middle of each.
    """
    frames, beams = np.asarray(frames, np.int64), np.diff(recording.offsets).astype(np.int64)
    faults, seen, votes = np.zeros(len(base)), np.zeros(len(base)), np.zeros(len(base.segments), np.int32)
    wanted = demands_of(base.params)
    for rows, offsets in committee.walls:
        count_faults(
            base.segments, base.offsets, rows, offsets, frames, beams, float(wanted.min_points), wanted.min_length,
            faults, seen, votes,
        )  # fmt: skip
    scores, judges = base.need_scores().copy(), len(committee.walls)
    scores[:, COLUMN.disputed] = faults / judges
    scores[:, COLUMN.blank] = np.where(np.diff(base.offsets) == 0, seen / judges, 0.0)
    if len(base):
        scores[:, COLUMN.lapsed] = _lapsed(recording, base, votes, wanted)
    return replace(base, scores=scores)


def _lapsed(recording: Recording, base: Survey, votes: NDArray[np.int32], wanted: Params) -> NDArray[np.float64]:
    lapsed = base.need_scores()[:, COLUMN.gone].astype(np.float64)
    marks = np.empty((2, int(np.diff(base.offsets).max(initial=0))), np.bool_)
    _, rays, place, _ = geometry_of(recording, 0, len(recording))
    confirm_gone(
        base.segments, base.offsets, views_of(recording), votes, CONFIRMING, np.empty(VOTES), marks,
        recording.ranges, recording.offsets, rays, place, recording.range_min, recording.range_max,
        float(wanted.min_points), wanted.min_length, lapsed,
    )  # fmt: skip
    return lapsed


@entry_kernel
def join_frames(pieces, offsets, epsilon, growth, taken, rows, counts):
    """Write the walls of each frame to `rows`, and their number to `counts`; returns the number of all."""
    used = 0
    for frame in range(len(counts)):
        start, stop = offsets[frame], offsets[frame + 1]
        counts[frame] = join(pieces[start:stop], epsilon, growth, taken[start:stop], rows[used:])
        used += counts[frame]
    return used


@kernel
def join(pieces, epsilon, growth, taken, rows):
    """Chain the pieces of each wall, forwards and backwards along the scan; returns the number of walls."""
    taken[:] = 0
    count, n = 0, len(pieces)
    for i in range(n):
        if taken[i]:
            continue
        taken[i] = 1
        first = last = i
        scatter = scatter_in(pieces[i])
        points = pieces[i].points
        for way in (1, -1):
            k, since = 1, 0
            while since < AHEAD and k < n:
                j = (i + way * k) % n
                k, since = k + 1, since + 1
                if taken[j]:
                    continue
                before, behind = (pieces[last], pieces[j]) if way > 0 else (pieces[j], pieces[first])
                if (behind.x1 - before.x2) ** 2 + (behind.y1 - before.y2) ** 2 > APART**2:
                    continue
                both = together(scatter, pieces[j])
                if not fits(both, pieces[first], pieces[last], pieces[j], epsilon, growth):
                    continue
                scatter, taken[j], since = both, 1, 0
                points += pieces[j].points
                first, last = (first, j) if way > 0 else (j, last)
        row, begin, end = rows[count], pieces[first], pieces[last]
        row.first, row.last, row.points = begin.first, end.last, points
        row.x1, row.y1, row.x2, row.y2 = begin.x1, begin.y1, end.x2, end.y2
        row.length = math.sqrt((end.x2 - begin.x1) ** 2 + (end.y2 - begin.y1) ** 2)
        count += 1
    return count


@kernel
def scatter_in(piece):
    """The scatter of a piece whose points lie evenly along it."""
    dx, dy, share = piece.x2 - piece.x1, piece.y2 - piece.y1, piece.points / 12.0
    x, y = 0.5 * (piece.x1 + piece.x2), 0.5 * (piece.y1 + piece.y2)
    return Scatter(x, y, int(np.int64(piece.points)), share * (dx * dx - dy * dy), 2.0 * share * dx * dy)


@kernel
def together(one, piece):
    """The scatter of the points of a wall and of one more piece."""
    other = scatter_in(piece)
    n = one.n + other.n
    dx, dy, weight = other.x - one.x, other.y - one.y, one.n * other.n / n
    cosine = one.cosine + other.cosine + weight * (dx * dx - dy * dy)
    sine = one.sine + other.sine + 2.0 * weight * dx * dy
    return Scatter(one.x + other.n * dx / n, one.y + other.n * dy / n, n, cosine, sine)


@kernel
def fits(scatter, first, last, piece, epsilon, growth):
    """Whether the ends of a wall and of a piece all lie within ε of the line through both."""
    line = line_through(scatter)
    for end in (first, last, piece):
        for x, y in ((end.x1, end.y1), (end.x2, end.y2)):
            distance = signed_distance(line, x, y)
            if distance * distance > epsilon * epsilon + growth * growth * (x * x + y * y):
                return False
    return True


@entry_kernel
def count_faults(segments, offsets, walls, places, frames, beams, min_points, min_length, faults, seen, votes):
    """Add what a judge holds for missed or false in each frame to `faults`, and the number of its walls to `seen`.

    votes: (segments,) one more for each segment that is one of its walls. As in `truth.match`, these share more than
    half of the beams that they have together, and a segment on a wall that just misses the demands is not false.
    """
    for k in range(len(frames)):
        here = segments[offsets[k] : offsets[k + 1]]
        there = walls[places[frames[k]] : places[frames[k] + 1]]
        for j in range(len(there)):
            if not meets(there[j], 1.0, min_points, min_length):
                continue
            seen[k] += 1
            found = index_of((there[j].first, there[j].last), here, beams[k], 0.0, min_points, min_length)
            if found >= 0:
                votes[offsets[k] + found] += 1
            else:
                faults[k] += 1
        for i in range(len(here)):
            span = here[i].first, here[i].last
            faults[k] += index_of(span, there, beams[k], 1.0 - SHORT, min_points, min_length) < 0


@kernel
def meets(row, share, min_points, min_length):
    """Whether a line has this share of the points and of the length that are asked for."""
    return (row.points >= share * min_points) & (row.length >= share * min_length)


@kernel
def index_of(span, rows, beams, share, min_points, min_length):
    """The first of these lines that meets this share of the demands and is the one with these beams, or −1."""
    for i in range(len(rows)):
        other = rows[i].first, rows[i].last
        shared = shared_beams(span, other, beams)
        same = 2 * shared > length_of(span, beams) + length_of(other, beams) - shared
        if same and meets(rows[i], share, min_points, min_length):
            return i
    return -1


@entry_kernel
def confirm_gone(
    segments, offsets, views, votes, confirming, memory, marks, ranges, beams, rays, place, range_min, range_max,
    min_points, min_length, lapsed,
):  # fmt: skip
    """Leave in `lapsed`, at first the score "gone", what so many judges find in the previous frame [m].

    Only lines of which the frame shows enough, and which it does not have in another way. beams: where the ranges of
    each frame begin; place: see `Geometry`.
    """
    for frame in range(1, len(offsets) - 2):
        if lapsed[frame] > 0.0:
            here = segments[offsets[frame] : offsets[frame + 1]]
            before = segments[offsets[frame - 1] : offsets[frame]]
            behind = segments[offsets[frame + 1] : offsets[frame + 2]]
            to_here, _ = mark_frame(before, here, behind, views[frame], memory, marks[0], marks[1])
            seen = ranges[beams[frame] : beams[frame + 1]]
            sight = rays[2 * place[frame] : 2 * (place[frame] + len(seen))]
            low, high = range_min[frame], range_max[frame]
            lapsed[frame] = 0.0
            for i in range(len(before)):
                if marks[1, i] and votes[offsets[frame - 1] + i] >= confirming:
                    ends = moved(before[i], to_here)
                    missing = shows_enough(ends, sight, seen, low, high, min_points, min_length)
                    if missing and not is_there(ends, here, sight, seen):
                        lapsed[frame] += before[i].length
