"""The world around a frame: where the laser drove, what it saw elsewhere, and the lines of all frames."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording, Survey
from lineseg.poses import in_world

from ..frame.geometry import Bounds
from .palette import Theme
from .shapes import Lines, Points, lines_between, points_at

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

Pose = tuple[float, float, float]

# Of a long recording so many scans are drawn, and points of them.
MOST_SCANS, MOST_POINTS = 2000, 200_000
# Of each of the last scans, if only these are drawn.
MOST_LAST_POINTS = 30_000
MOST_LINES = 60_000
# Scans whose points in the world are kept.
MOST_PLACED = 256
# Points of the whole recording that share a square of this side are one [m].
SQUARE = 0.05
# The robot does not drive faster [m between scans]; beyond, its trajectory is not joined.
LONGEST_STEP = 3.0
# Newer points lie over older ones, by less than the drawing's layers are apart [m].
RISE = 0.01


@dataclass(frozen=True, eq=False)
class World:
    """The poses of a recording (frames, 3), NaN where unknown, and whether the laser is mounted upside down."""

    recording: Recording
    poses: NDArray[np.floating]
    upside_down: bool

    @classmethod
    def of(cls, recording: Recording) -> World | None:
        """None if no scan has a pose. The first call may read the file once more."""
        poses = recording.poses
        return None if poses is None else cls(recording, poses, recording.pose_source.upside_down)

    def pose(self, frame: int) -> Pose | None:
        """Of the laser at a frame."""
        x, y, heading = self.poses[frame].tolist()
        return (x, y, heading) if np.isfinite(self.poses[frame]).all() else None

    @cached_property
    def known(self) -> NDArray[np.intp]:
        """The frames with a pose."""
        return np.flatnonzero(np.isfinite(self.poses).all(axis=1))

    @cached_property
    def _seen(self) -> NDArray[np.floating]:
        """(n, 2) what the laser saw over the whole recording, a point for each square."""
        frames = self.known[:: -(-len(self.known) // MOST_SCANS)]
        xy = self.points_of(frames, 20 * MOST_POINTS)
        if not len(xy):
            return xy
        side = SQUARE
        while True:
            _, first = np.unique(np.round(xy / side).astype(np.int64) @ np.array([1 << 32, 1]), return_index=True)
            if len(first) <= MOST_POINTS:
                return xy[np.sort(first)]
            side *= 1.4

    def points_of(self, frames: NDArray[np.integer], most: int) -> NDArray[np.floating]:
        """(n, 2) the points of these frames, about `most` of them, frame after frame."""
        beams = int((self.recording.offsets[frames + 1] - self.recording.offsets[frames]).sum())
        every = 1 << max(0, beams // most).bit_length()
        parts = [self._points(frame, every) for frame in frames.tolist()]
        return np.concatenate(parts) if parts else np.empty((0, 2))

    def _points(self, frame: int, every: int) -> NDArray[np.floating]:
        # While frames are gone through, most of the last ones stay.
        key = frame, every
        if key not in self._placed:
            scan = self.recording[frame]
            self._placed[key] = in_world(scan.xy[scan.valid][::every], self.poses[frame], self.upside_down)
            if len(self._placed) > MOST_PLACED:
                self._placed.pop(next(iter(self._placed)))
        return self._placed[key]

    @cached_property
    def _placed(self) -> dict[tuple[int, int], NDArray[np.floating]]:
        return {}

    @cached_property
    def bounds(self) -> Bounds:
        """A box around the trajectory and nearly all that was seen."""
        seen, driven = self._seen, self.poses[self.known, :2]
        low, high = np.percentile(seen, [1, 99], axis=0) if len(seen) else (driven.min(axis=0), driven.max(axis=0))
        low, high = np.minimum(low, driven.min(axis=0)), np.maximum(high, driven.max(axis=0))
        margin = 0.04 * max(float((high - low).max()), 1.0)
        (x1, y1), (x2, y2) = (low - margin).tolist(), (high + margin).tolist()
        return x1, y1, x2, y2

    def all_seen(self, theme: Theme) -> Points:
        """What the laser saw over the whole recording; always the same object, which is sent once."""
        return self._kept(("seen", theme), lambda: points_at(self._seen, theme.past))

    def last_seen(self, frame: int, scans: int, theme: Theme) -> Points:
        """The points of the scans before a frame, the newest on top."""
        frames = self.known[(self.known < frame) & (self.known >= frame - scans)]
        points = points_at(self.points_of(frames, MOST_LAST_POINTS), theme.past)
        points.xyz[:, 2] = np.linspace(0, RISE, len(points.xyz))
        return points

    def trajectory(self, theme: Theme) -> Lines:
        """From pose to pose, with gaps where they are unknown or jump."""
        return self._kept(("trajectory", theme), lambda: self._driven(theme))

    def _driven(self, theme: Theme) -> Lines:
        starts, ends = self.poses[:-1, :2], self.poses[1:, :2]
        near = np.hypot(*(ends - starts).T) < LONGEST_STEP
        return lines_between(starts[near], ends[near], theme.trajectory)

    def all_lines(self, survey: Survey, theme: Theme) -> Lines:
        """The lines of all frames; of a long recording, of evenly spread ones."""
        return self._kept((survey, theme), lambda: self._lines_of(survey, theme))

    def _lines_of(self, survey: Survey, theme: Theme) -> Lines:
        frames = np.repeat(np.arange(len(survey)), np.diff(survey.offsets))
        every = max(1, -(-len(survey.segments) // MOST_LINES))
        chosen = np.isfinite(self.poses[frames]).all(axis=1) & (frames % every == 0)
        rows, poses = survey.segments[chosen], self.poses[frames[chosen]]
        ends = np.stack([np.column_stack((rows[f"x{end}"], rows[f"y{end}"])) for end in (1, 2)], axis=1)
        placed = in_world(ends, poses, self.upside_down)
        return lines_between(placed[:, 0], placed[:, 1], theme.past_line)

    def line_map(self, found: LineMap, theme: Theme) -> Lines:
        """The lines of all frames, merged."""
        starts, ends = found.ends[:, :2], found.ends[:, 2:]
        return self._kept(("map", found, theme), lambda: lines_between(starts, ends, theme.mapped))

    @cached_property
    def _shapes(self) -> dict:
        return {}

    def _kept(self, key: tuple, make):
        """The shape that was made last for this kind of key, if it is the same."""
        kind = key[0] if isinstance(key[0], str) else "lines"
        kept = self._shapes.get(kind)
        if kept is None or kept[0] != key:
            kept = self._shapes[kind] = key, make()
        return kept[1]
