"""Takes the motion of the laser within a sweep out of its scans: each beam as if measured at the stamp of its scan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...poses import Poses, in_world, seen_from
from ...scan import Recording, Scan
from ..account import Notes
from .moving import Motion, Rigid

Array = NDArray[np.floating]


def without_motion(recording: Recording, notes: Notes) -> Recording:
    """The recording with the beams of each scan moved to its stamp. Raises ValueError if poses or times are missing."""
    if recording.time_increment is None or not recording.time_increment.any():
        raise ValueError(
            f"{recording.name}: motion cannot be removed, because the time between two beams is not known; "
            "give it with time_increment."
        )
    if recording.poses is None or recording.track is None:
        why = recording.pose_source.missing or "there are none"
        raise ValueError(f"{recording.name}: motion cannot be removed, because the scans have no poses: {why}.")
    poses_at = recording.track.found.at or _between(recording.stamps, recording.poses)
    upside_down = recording.pose_source.upside_down
    rows = zip(recording, recording.poses, recording.time_increment.tolist(), strict=True)
    scans = [_at_stamp(scan, pose, pause, poses_at, upside_down) for scan, pose, pause in rows]
    left = sum(scan is None for scan in scans)
    if left:
        notes.notice(
            "motion", f"{left} of {len(scans)} scans have no pose while they were taken; their motion is left in."
        )
    moved = [kept if scan is None else scan for scan, kept in zip(scans, recording, strict=True)]
    fresh = Recording.from_scans(moved)
    names = ("ranges", "angle_min", "angle_increment", "bearings")
    return replace(recording, **{name: getattr(fresh, name) for name in names})


def _between(stamps: Array, poses: Poses) -> Callable[[Array], Poses]:
    motion = Motion.of(stamps, Rigid.on_plane(poses))
    assert motion is not None
    return lambda times: motion.at(times).flat()[0]


def _at_stamp(
    scan: Scan, pose: Array, pause: float, poses_at: Callable[[Array], Poses], upside_down: bool
) -> Scan | None:
    """The scan as seen from its pose; None if the poses do not cover its sweep."""
    if not np.isfinite(pose).all():
        return None
    times = scan.stamp + pause * np.arange(len(scan))
    # The last scan may end after the last pose.
    poses = poses_at(times)
    if not np.isfinite(poses).all():
        return None
    ranges = np.where(scan.valid, scan.ranges, 1.0).astype(float)
    points = (ranges * scan.rays).T
    moved = seen_from(in_world(points[:, None], poses, upside_down)[:, 0], pose, upside_down)
    turned = np.arctan2(moved[:, 1], moved[:, 0]) - scan.bearings
    # A beam without a return only turns.
    sense = -1.0 if upside_down else 1.0
    turned = np.where(scan.valid, turned, sense * (poses[:, 2] - pose[2]))
    bearings = scan.bearings + (turned + np.pi) % (2 * np.pi) - np.pi
    measured = np.hypot(*moved.T).astype(scan.ranges.dtype)
    return replace(scan, ranges=np.where(scan.valid, measured, scan.ranges), bearings=bearings, known=None)
