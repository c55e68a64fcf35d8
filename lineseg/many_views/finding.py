"""The truth by many views: walls that many scans agree on, and for each beam its wall."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..posed.nearest import nearest_walls
from ..posed.returns import Returns, views_of
from ..posed.walls import Walls
from ..poses import Track
from ..scan import Recording
from ..truth import UNKNOWN
from .cells import cells_of
from .checks import check, trust
from .growing import BEND, grown_walls
from .merging import merged_walls, pieces_of, without_shadows
from .openings import divided_at_openings
from .profiles import STRETCH, Profiles, calmed, is_even, is_straight, profiles_of, scatter_by_range, stretches_of
from .refining import refined
from .settling import settled
from .steps import FINE, divided_at_steps, evenness
from .twins import doubled, without_outdone

# A wall and a place without one are known if so many views, or more, saw them.
LEAST_VIEWS = 3
# Side of the squares in which the views of a place are counted [m].
PLACE = 0.20
# Points lie within so many standard deviations of their wall; bounds of that distance [m]. It is unknown whether those
# a little farther away belong to it.
DEVIATIONS, NEAREST, FARTHEST, DOUBTFUL = 3.5, 0.02, 0.10, 1.25
# A surface that steps less than this from the line of a wall may still be taken for it [m].
STEPPED = 0.15
# Where a wall bends, its surface is at most this far from its line [m].
BENT = 0.12
# What bends or is rough and is shorter than this is a pillar, a person or the like [m].
LONG = 1.0
# Past the end of a wall, it is unknown for so long whether returns so near to its line belong to it [m].
ONWARD, NEAR = 0.30, 0.02
ROUNDS = 3
# Of a longer recording, so many returns make the walls; then each return gets its wall.
MOST_RETURNS = 1_500_000
# Squares of one surface follow each other within this distance, and so do pieces of one wall [m].
BAND = 0.04

Floats = NDArray[np.float64]
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class ManyViews:
    """What many scans of a recording agree on.

    recording: with `wall` of each beam (−1 none, UNKNOWN for too little support), `walls`, `text` as its `wall_source`,
    and the corrected poses.
    thickness: rms distance of the points from their walls [m], and before the poses were corrected; explained, unknown:
    shares of the returns. shift, turn: (frames with a pose,) corrections of the poses [m, rad]. trusted: whether
    rates measured with it are likely a few points off at most; usable: whether it is better than no truth; reason: how
    far off rates were in simulated worlds, or why it is not usable.
    """

    recording: Recording
    thickness: float
    thickness_before: float
    explained: float
    unknown: float
    shift: Floats
    turn: Floats
    trusted: bool
    usable: bool
    reason: str

    @property
    def text(self) -> str:
        """All of it in sentences."""
        walls = len(self.recording.walls if self.recording.walls is not None else ())
        return (
            f"{walls} walls, {1e3 * self.thickness:.0f} mm thick (rms; {1e3 * self.thickness_before:.0f} mm with the "
            f"given poses). {self.explained:.0%} of the returns lie on them; {self.unknown:.0%} are unknown. "
            f"Poses were corrected by {1e3 * np.median(self.shift):.0f} mm and "
            f"{np.degrees(np.median(self.turn)):.2f}° (median), at most {1e3 * self.shift.max():.0f} mm and "
            f"{np.degrees(self.turn.max()):.2f}°. {self.reason}"
        )


def truth_by_many_views(recording: Recording, progress: Progress | None = None) -> ManyViews:
    """Walls that many posed scans agree on, and for each beam its wall.

    No extraction of single frames goes in: all returns are put into the world, where surfaces that several views see
    are grown to straight walls. Poses are corrected within 0.25 m and 3° where that makes the walls thinner.
    progress: is told how much of the work is done; it may raise to stop it.
    Raises ValueError without poses, for poses that jump, a robot that stands still, and where there are no walls.
    """
    say = progress or (lambda done, total: None)
    say(0, ROUNDS + 2)
    given = check(recording)
    returns = Returns.of(recording, given)
    given = np.ascontiguousarray(given[returns.frames], dtype=np.float64)
    views, poses = views_of(given), given
    some = returns.thinned(views, MOST_RETURNS)
    scan = some.scan
    say(1, ROUNDS + 2)
    first = fit = _fit(some, scan, poses, views)
    say(2, ROUNDS + 2)
    for turn in range(1, ROUNDS):
        poses = refined(returns, given, poses, fit.walls, 0.20 / turn, max(fit.thickness, 0.01))
        fit = _fit(some, scan, poses, views)
        say(turn + 2, ROUNDS + 2)
    pieces, wall_of = parted(fit, scan, poses, views)
    known = Known.of(fit.placed, scan, poses, views, pieces)
    wall_of = divided_at_openings(pieces, wall_of, fit.placed, scan, poses, fit.thickness)
    piece, height = np.empty(len(returns), np.int32), np.empty(len(returns), np.float32)
    for part, here, scans in returns.parts():
        piece[here], height[here] = known.labels(part.in_world(poses[scans]), part.scan, poses[scans])
    ends = ends_of(pieces, wall_of, piece)
    wall = np.concatenate((wall_of, [UNKNOWN, -1]))[piece].astype(np.int32)
    return _result(recording, returns, given, poses, ends, wall, height, first.thickness)


class _Fit(NamedTuple):
    """What the returns make with some poses: their places in the world, the pieces of walls, the wall of each piece,
    and the rms distance of the returns from their pieces [m].
    """

    placed: NDArray[np.float32]
    walls: Walls
    wall_of: NDArray[np.int64]
    thickness: float


def _fit(returns: Returns, scan: NDArray[np.int32], poses: Floats, views: NDArray[np.int64]) -> _Fit:
    placed = returns.in_world(poses)
    walls, wall_of = walls_of(placed, scan, poses, views)
    _, height = nearest_walls(placed, scan, poses, walls, FARTHEST)
    return _Fit(placed, walls, wall_of, _rms(height))


def walls_of(
    placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats, views: NDArray[np.int64]
) -> tuple[Walls, NDArray[np.int64]]:
    """The uninterrupted pieces of walls in the points (n, 2) of all scans in the world, and the wall of each piece."""
    cells = cells_of(placed, scan, poses, views)
    walls, owner = grown_walls(cells, BAND)
    walls, owner = without_shadows(cells, walls, owner)
    walls, owner = merged_walls(cells, walls, owner, BAND)
    walls, owner = settled(cells, walls, owner)
    walls, owner = merged_walls(cells, walls, owner, BAND)
    return pieces_of(cells, *without_shadows(cells, walls, owner))


def parted(
    fit: _Fit, scan: NDArray[np.int32], poses: Floats, views: NDArray[np.int64]
) -> tuple[Walls, NDArray[np.int64]]:
    """The pieces of walls, divided where the surface steps, without those that outliers form; and the wall of each."""
    fine = _profiles(fit.placed, scan, poses, views, fit.walls, FINE, STEPPED)
    pieces, wall_of = divided_at_steps(fit.walls, fit.wall_of, fine)
    return without_outdone(pieces, wall_of, _profiles(fit.placed, scan, poses, views, pieces, STRETCH, BENT))


def _profiles(
    placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats, views: NDArray[np.int64], walls: Walls,
    length: float, reach: float,
) -> Profiles:  # fmt: skip
    found, height = nearest_walls(placed, scan, poses, walls, reach)
    near = np.flatnonzero(found >= 0)
    return profiles_of(placed[near], found[near], height[near], views[scan[near]], walls, length)


@dataclass(frozen=True, eq=False)
class Known:
    """What is known of the pieces of walls, by which each return gets its piece.

    firm: (w,) whether a piece is straight and even; smooth: (w,) whether it is even in single scans, so that only its
    bends or the poses blur it; profiles: of the pieces; height, scatter: (s,) of their stretches [m]; doubled: (s,)
    whether a stretch has another close in front or behind; by_range: how much points scatter, metre by metre of their
    range [m]; places: what was seen.
    """

    walls: Walls
    firm: NDArray[np.bool_]
    smooth: NDArray[np.bool_]
    profiles: Profiles
    height: Floats
    scatter: Floats
    doubled: NDArray[np.bool_]
    by_range: Floats
    places: Places

    @classmethod
    def of(
        cls, placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats, views: NDArray[np.int64], walls: Walls
    ) -> Known:
        """From the points (n, 2) of many scans in the world and the scan (n,) of each."""
        found, over = nearest_walls(placed, scan, poses, walls, BENT)
        near = np.flatnonzero(found >= 0)
        profiles = profiles_of(placed[near], found[near], over[near], views[scan[near]], walls)
        height = np.clip(calmed(profiles.height, profiles), -BEND, BEND)
        scatter = calmed(profiles.scatter, profiles)
        stretch = stretches_of(placed[near], found[near], walls, profiles.starts)
        away = np.hypot(*(placed[near] - poses[scan[near], :2]).T)
        off = np.abs(over[near] - height[stretch])
        by_range = scatter_by_range(off, away)
        fine = _profiles(placed, scan, poses, views, walls, FINE, BEND)
        bent = evenness(fine.height[fine.points > 0], fine.wall[fine.points > 0])
        firm = is_straight(fine, walls, bent) & is_even(stretch, off, away, by_range, profiles)
        both = np.flatnonzero((np.diff(found[near]) == 0) & (np.diff(scan[near]) == 0))
        step = np.abs(np.diff(over[near])[both]) / np.sqrt(2)
        smooth = is_even(stretch[both], step, away[both], by_range, profiles)
        twice, places = doubled(profiles, walls, firm), Places.of(placed, views[scan])
        return cls(walls, firm, smooth, profiles, height, scatter, twice, by_range, places)

    def labels(
        self, placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats
    ) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """(n,) the piece of each return, −1 for none, UNKNOWN where fewer than LEAST_VIEWS views saw the place; and
        (n,) its height over the piece [m].

        Returns that lie a little farther from their wall than others do are UNKNOWN, and so are long surfaces that bend
        or that the poses blur or show twice: whoever finds lines there is neither right nor wrong. Surfaces that are
        rough in single scans, such as a hedge, are no walls.
        """
        walls, profiles = self.walls, self.profiles
        found, height = nearest_walls(placed, scan, poses, walls, BENT)
        wall, near = np.full(len(placed), -1, np.int32), np.flatnonzero(found >= 0)
        if len(near):
            own = found[near]
            stretch = stretches_of(placed[near], own, walls, profiles.starts)
            off = np.abs(height[near] - self.height[stretch])
            metre = np.hypot(*(placed[near] - poses[scan[near], :2]).T).astype(np.int64)
            by_range = self.by_range[np.minimum(metre, len(self.by_range) - 1)]
            limit = np.clip(DEVIATIONS * np.maximum(self.scatter[stretch], by_range), NEAREST, FARTHEST)
            good, long = off < DOUBTFUL * limit, walls.high - walls.low > LONG
            wall[near[off < limit]] = own[off < limit]
            wall[near[good & (off >= limit)]] = UNKNOWN
            wall[near[good & ~self.firm[own]]] = -1
            wall[near[(~self.firm & self.smooth & long)[own] & good]] = UNKNOWN
            wall[near[((profiles.views[stretch] < LEAST_VIEWS) | self.doubled[stretch]) & good]] = UNKNOWN
        elsewhere = wall == -1
        wall[elsewhere & on_the_way(placed, scan, poses, walls.only(self.firm))] = UNKNOWN
        wall[elsewhere & (self.places.views_at(placed) < LEAST_VIEWS)] = UNKNOWN
        return wall, height


def on_the_way(placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats, walls: Walls) -> NDArray[np.bool_]:
    """(n,) whether each return lies where a wall would go on past its ends."""
    longer = Walls(walls.normal, walls.offset, walls.low - ONWARD, walls.high + ONWARD, walls.rms)
    return nearest_walls(placed, scan, poses, longer, NEAR)[0] >= 0


def ends_of(pieces: Walls, wall_of: NDArray[np.int64], piece: NDArray[np.int32]) -> Floats:
    """(w, 4) x1, y1, x2, y2 [m] of each wall, from the first to the last of its pieces that are in use."""
    ends = np.full((int(wall_of.max(initial=-1)) + 1, 4), np.nan)
    used = _used(piece, len(pieces))
    for wall in range(len(ends)):
        of = used[wall_of[used] == wall]
        if len(of):
            first = of[:1]
            low, high = pieces.low[of].min(keepdims=True), pieces.high[of].max(keepdims=True)
            whole = Walls(pieces.normal[first], pieces.offset[first], low, high, pieces.rms[first])
            ends[wall] = whole.ends[0]
    return ends


class Places(NamedTuple):
    """From how many views something was seen in each square of the world. origin: (2,) corner of the first [m]."""

    squares: NDArray[np.int64]
    counts: NDArray[np.int64]
    origin: NDArray[np.float32]

    @classmethod
    def of(cls, placed: NDArray[np.float32], view: NDArray[np.int64]) -> Places:
        origin = placed.min(axis=0)
        squares, number = np.unique(_squares(placed, origin), return_inverse=True)
        kinds = int(view.max()) + 1
        pairs = np.unique(number.astype(np.int64) * kinds + view)
        return cls(squares, np.bincount(pairs // kinds), origin)

    def views_at(self, placed: NDArray[np.float32]) -> NDArray[np.int64]:
        """(n,) from how many views something was seen in the square of each point (n, 2)."""
        square = _squares(placed, self.origin)
        at = np.minimum(np.searchsorted(self.squares, square), len(self.squares) - 1)
        return np.where(self.squares[at] == square, self.counts[at], 0)


def _squares(placed: NDArray[np.float32], origin: NDArray[np.float32]) -> NDArray[np.int64]:
    return np.floor((placed - origin) / PLACE).astype(np.int64) @ np.array([1 << 24, 1])


def _used(wall: NDArray[np.int32], walls: int) -> NDArray[np.intp]:
    """The walls that some returns (n,) lie on."""
    return np.flatnonzero(np.bincount(wall[wall >= 0], minlength=walls))


def _rms(height: NDArray[np.floating]) -> float:
    known = height[np.isfinite(height)]
    return float(np.sqrt(np.mean(known**2, dtype=np.float64))) if len(known) else 0.0


def _result(
    recording: Recording, returns: Returns, given: Floats, poses: Floats, walls: Floats, wall: NDArray[np.int32],
    height: NDArray[np.float32], before: float,
) -> ManyViews:  # fmt: skip
    used = _used(wall, len(walls))
    numbers = np.full(len(walls) + 2, -1, np.int32)
    numbers[used], numbers[UNKNOWN] = np.arange(len(used)), UNKNOWN
    wall = numbers[wall]
    of_beams = np.full(len(recording.ranges), UNKNOWN, np.int32)
    valid = np.concatenate([scan.valid for scan in recording])
    of_beams[~valid] = -1
    of_beams[returns.beam] = wall
    all_poses = np.full((len(recording), 3), np.nan)
    all_poses[returns.frames] = poses
    source = replace(recording.pose_source, text=f"{recording.pose_source.text}, corrected by many views")
    shift, turn = np.hypot(*(poses - given)[:, :2].T), np.abs(poses - given)[:, 2]
    explained = float(np.mean(wall >= 0)) if len(wall) else 0.0
    thickness, unknown = _rms(height[wall >= 0]), float(np.mean(wall == UNKNOWN))
    judged = trust(recording.name, thickness, explained, unknown, shift, turn)
    made = replace(recording, wall=of_beams, walls=walls[used], track=Track.of(all_poses, source))
    found = ManyViews(made, thickness, before, explained, unknown, shift, turn, *judged)
    return replace(found, recording=replace(made, wall_source=found.text))
