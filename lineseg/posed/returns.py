"""All returns of a recording whose scans have poses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording

# Scans taken within a square of this side count as one view [m].
VIEW = 0.3
# A part has about so many returns.
PART = 500_000


@dataclass(frozen=True, eq=False)
class Returns:
    """The valid beams of all scans with a pose, scan after scan.

    xy: (n, 2) float32 [m] in the frame of the laser, seen from above; beam: (n,) its place in the recording's flat
    arrays; frames: (m,) the scans with a pose; offsets: (m + 1,) where each of them begins.
    """

    xy: NDArray[np.float32]
    beam: NDArray[np.int32]
    frames: NDArray[np.intp]
    offsets: NDArray[np.int64]

    @classmethod
    def of(cls, recording: Recording, poses: NDArray[np.floating]) -> Returns:
        """The returns of the scans whose pose is not NaN."""
        frames = np.flatnonzero(np.isfinite(poses).all(axis=1))
        xy = np.empty((len(recording.ranges), 2), np.float32)
        beam = np.empty(len(xy), np.int32)
        offsets = np.zeros(len(frames) + 1, np.int64)
        for k, frame in enumerate(frames.tolist()):
            scan = recording[frame]
            valid = np.flatnonzero(scan.valid)
            here = slice(offsets[k], offsets[k] + len(valid))
            xy[here], beam[here] = scan.xy[valid], recording.offsets[frame] + valid
            offsets[k + 1] = here.stop
        if recording.pose_source.upside_down:
            xy[:, 1] *= -1
        return cls(xy[: offsets[-1]], beam[: offsets[-1]], frames, offsets)

    def __len__(self) -> int:
        return len(self.xy)

    @property
    def scan(self) -> NDArray[np.int32]:
        """(n,) the position in `frames` of each return's scan."""
        return np.repeat(np.arange(len(self.frames), dtype=np.int32), np.diff(self.offsets))

    def in_world(self, poses: NDArray[np.float64]) -> NDArray[np.float32]:
        """(n, 2) [m] in the world; poses: (m, 3) of `frames`."""
        placed = np.empty_like(self.xy)
        for k, (x, y, heading) in enumerate(poses.tolist()):
            here = slice(self.offsets[k], self.offsets[k + 1])
            cos, sin = np.cos(heading), np.sin(heading)
            turned = np.array(((cos, sin), (-sin, cos)))
            placed[here] = self.xy[here] @ turned + (x, y)
        return placed

    def thinned(self, views: NDArray[np.int64], most: int) -> Returns:
        """At most about `most` of the returns, evenly; views that have more than others give up more.

        views: (m,) of each scan. What a robot saw while it stood still does not drown what it saw while it drove.
        """
        if len(self) <= most:
            return self
        counts = np.bincount(views, np.diff(self.offsets))
        each = 0.0
        for _ in range(20):
            each += (most - np.minimum(counts, each).sum()) / max(int((counts > each).sum()), 1)
        every = np.ceil(counts / each).astype(np.int64)[views].tolist()
        limits = self.offsets.tolist()
        kept = [
            np.arange(first + k % step, stop, step)
            for k, (first, stop, step) in enumerate(zip(limits, limits[1:], every, strict=False))
        ]
        offsets = np.concatenate(([0], np.cumsum([len(of_scan) for of_scan in kept])))
        chosen = np.concatenate(kept)
        return Returns(self.xy[chosen], self.beam[chosen], self.frames, offsets)

    def parts(self) -> Iterator[tuple[Returns, slice, slice]]:
        """The returns in parts of whole scans; which of the returns and which of the scans each part has."""
        first = 0
        while first < len(self.frames):
            stop = int(np.searchsorted(self.offsets, self.offsets[first] + PART, side="right")) - 1
            scans = slice(first, max(stop, first + 1))
            here = slice(int(self.offsets[scans.start]), int(self.offsets[scans.stop]))
            offsets = self.offsets[scans.start : scans.stop + 1] - here.start
            yield Returns(self.xy[here], self.beam[here], self.frames[scans], offsets), here, scans
            first = scans.stop


def views_of(poses: NDArray[np.floating]) -> NDArray[np.int64]:
    """(m,) the view that each pose belongs to, numbered from 0: scans from nearly the same place are one view."""
    _, views = np.unique(np.round(poses[:, :2] / VIEW).astype(np.int64), axis=0, return_inverse=True)
    return views.reshape(-1)
