"""Where the laser was in the world at each scan: `Track`, and what is said of it, `PoseSource`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

Poses = NDArray[np.floating]


@dataclass(frozen=True)
class PoseSource:
    """What is said of the poses of a recording.

    text: where they come from, such as "FLASER lines"; "" if there are none. frames: from the world's to the laser's.
    apart: median time between a scan and the nearest pose message [s]. upside_down: whether the laser is mounted so
    that its beams turn clockwise seen from above. missing: why scans have no pose, "" if all have one.
    mounted: whether they are those of this laser; if not, those of the robot are taken for them.
    """

    text: str = ""
    frames: tuple[str, ...] = ()
    apart: float = 0.0
    upside_down: bool = False
    missing: str = ""
    mounted: bool = True


class Found(NamedTuple):
    """Poses (frames, 3) of x, y [m] and heading [rad] of the laser in the world, NaN where unknown.

    at: the same at other times (n,) [s], None if only the scans have poses.
    """

    poses: Poses
    source: PoseSource
    at: Callable[[NDArray[np.floating]], Poses] | None = None

    def only(self, frames: NDArray[np.integer]) -> Found:
        return self._replace(poses=self.poses[frames])


class Track:
    """The poses of a recording, found when they are first asked for: those of a bag take another pass over the file."""

    def __init__(self, find: Callable[[], Found]) -> None:
        self._find = find

    @classmethod
    def of(cls, poses: Poses, source: PoseSource) -> Self:
        """A track of known poses."""
        return cls(partial(Found, poses, source))

    @cached_property
    def found(self) -> Found:
        return self._find()

    def only(self, frames: NDArray[np.integer]) -> Track:
        """The track of some of the scans."""
        return Track(partial(_only, self, frames))

    def __getstate__(self) -> dict:
        return {"_find": self._find}


def _only(track: Track, frames: NDArray[np.integer]) -> Found:
    return track.found.only(frames)


def in_world(xy: NDArray[np.floating], poses: Poses, upside_down: bool = False) -> NDArray[np.floating]:
    """Points (…, n, 2) seen by the laser, in the world; poses: (…, 3), one for each group of n points."""
    x, y = xy[..., 0], -xy[..., 1] if upside_down else xy[..., 1]
    cos, sin = np.cos(poses[..., 2:]), np.sin(poses[..., 2:])
    return np.stack((poses[..., :1] + cos * x - sin * y, poses[..., 1:2] + sin * x + cos * y), axis=-1)


def seen_from(xy: NDArray[np.floating], pose: NDArray[np.floating], upside_down: bool = False) -> NDArray[np.floating]:
    """Points (n, 2) of the world as a laser at `pose` (3,) sees them; the inverse of `in_world`."""
    x, y = (xy - pose[:2]).T
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return np.column_stack((cos * x + sin * y, (sin * x - cos * y) if upside_down else (cos * y - sin * x)))


def said_of(poses: Poses | None, source: PoseSource) -> str:
    """One sentence about the poses of a recording."""
    if poses is None:
        return f"none: {source.missing}"
    known = int(np.isfinite(poses).all(axis=1).sum())
    frames = f" ({' → '.join(filter(None, source.frames))})" if source.frames else ""
    upside = ", laser mounted upside down" if source.upside_down else ""
    text = f"{known} of {len(poses)} scans, from {source.text}{frames}, {1e3 * source.apart:.0f} ms apart{upside}"
    return f"{text}; {source.missing}" if source.missing else text
