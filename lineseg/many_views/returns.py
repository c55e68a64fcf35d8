"""All returns of a recording whose scans have poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording

# Scans taken within a square of this side count as one view [m].
VIEW = 0.3


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


def views_of(poses: NDArray[np.float64]) -> NDArray[np.int64]:
    """(m,) the view that each pose belongs to, numbered from 0: scans from nearly the same place are one view."""
    _, views = np.unique(np.round(poses[:, :2] / VIEW).astype(np.int64), axis=0, return_inverse=True)
    return views.reshape(-1)
