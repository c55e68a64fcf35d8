"""Bounding boxes of scans and recordings [m], and the beam nearest to a point."""

from __future__ import annotations

import numpy as np

from lineseg import Recording, Scan

# x₁, y₁, x₂, y₂
Bounds = tuple[float, float, float, float]
FRAMES_FOR_BOUNDS = 60


def bounds_of(recording: Recording) -> Bounds:
    """A box around the laser and nearly all points of the recording; ignores stray far points."""
    frames = np.unique(np.linspace(0, len(recording) - 1, FRAMES_FOR_BOUNDS).astype(int)) if len(recording) else []
    scans = [recording[int(frame)] for frame in frames]
    xy = np.concatenate([scan.xy[scan.valid] for scan in scans]) if scans else np.empty((0, 2))
    if not len(xy):
        return -5.0, -5.0, 5.0, 5.0
    low, high = np.percentile(xy, [2, 98], axis=0)
    margin = 0.05 * max(float((high - low).max()), 1.0)
    low, high = np.minimum(low, 0.0) - margin, np.maximum(high, 0.0) + margin
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def extent_of(scan: Scan, bounds: Bounds) -> Bounds:
    """The box around the points of one scan; the box of the recording if it has none."""
    xy = scan.xy[scan.valid]
    if not len(xy):
        return bounds
    (x1, y1), (x2, y2) = xy.min(axis=0), xy.max(axis=0)
    return float(x1), float(y1), float(x2), float(y2)


def united(one: Bounds, other: Bounds) -> Bounds:
    """The smallest box around both."""
    return min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), max(one[3], other[3])


def beam_near(scan: Scan, point: tuple[float, float], radius: float) -> int | None:
    """The beam whose point is nearest to `point`; None if no point lies within `radius`."""
    if not scan.valid.any():
        return None
    distances = np.hypot(*(scan.xy - point).T)
    nearest = int(np.nanargmin(distances))
    return nearest if distances[nearest] <= radius else None
