"""Poses in space, as a position and a quaternion: interpolated in time, chained, and laid on the plane."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...poses import Poses

Array = NDArray[np.floating]
# Between poses that are farther apart [s], a scan has no pose, unless the robot stood still meanwhile [m], [rad].
LONGEST_GAP = 1.0
STILL, STILL_ANGLE = 0.01, 0.005


class Rigid(NamedTuple):
    """place: (n, 3) [m]; turn: (n, 4) unit quaternions, x, y, z, w."""

    place: Array
    turn: Array

    @classmethod
    def of(cls, rows: Array) -> Rigid:
        """From rows (n, 7) of x, y, z and a quaternion of any length; NaN for one of length 0."""
        length = np.linalg.norm(rows[:, 3:], axis=1, keepdims=True)
        return cls(rows[:, :3], rows[:, 3:] / np.where(length > 1e-6, length, np.nan))

    @classmethod
    def on_plane(cls, poses: Array) -> Rigid:
        """From x, y, heading (n, 3)."""
        nothing, half = np.zeros(len(poses)), poses[:, 2] / 2
        place = np.column_stack((poses[:, :2], nothing))
        return cls(place, np.column_stack((nothing, nothing, np.sin(half), np.cos(half))))

    def then(self, inner: Rigid) -> Rigid:
        """The motion of `inner`, which is given in the frame of `self`."""
        return Rigid(self.place + rotated(self.turn, inner.place), product(self.turn, inner.turn))

    def inverse(self) -> Rigid:
        turn = self.turn * (-1, -1, -1, 1)
        return Rigid(-rotated(turn, self.place), turn)

    def flat(self) -> tuple[Poses, Array]:
        """x, y and the heading of the x axis (n, 3), and how far the z axis points up (n,), from −1 to 1."""
        ahead = rotated(self.turn, np.broadcast_to((1.0, 0.0, 0.0), self.place.shape))
        up = rotated(self.turn, np.broadcast_to((0.0, 0.0, 1.0), self.place.shape))
        return np.column_stack((self.place[:, :2], np.arctan2(ahead[:, 1], ahead[:, 0]))), up[:, 2]


class Motion(NamedTuple):
    """Poses (n,) at rising times (n,) [s]; still: they are all the same, at any time."""

    times: Array
    poses: Rigid
    still: bool

    @classmethod
    def of(cls, times: Array, poses: Rigid, fixed: bool = False) -> Motion | None:
        """None if there is no pose. fixed: whether the latest holds at all times."""
        good = np.isfinite(times) & np.isfinite(poses.place).all(axis=1) & np.isfinite(poses.turn).all(axis=1)
        if not good.any():
            return None
        times, order = np.unique(times[good], return_index=True)
        place, turn = poses.place[good][order], poses.turn[good][order]
        if fixed:
            times, place, turn = times[-1:], place[-1:], turn[-1:]
        same = np.ptp(place, axis=0).max() < 1e-9 and (np.abs(turn @ turn[0]) > 1 - 1e-12).all()
        return cls(times, Rigid(place, turn), bool(same))

    def at(self, times: Array) -> Rigid:
        """The poses at other times, interpolated; NaN outside, and in a gap."""
        if self.still:
            return Rigid(*(np.broadcast_to(each[0], (len(times), each.shape[1])) for each in self.poses))
        after = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        before = after - 1
        span = self.times[after] - self.times[before]
        share = ((times - self.times[before]) / span)[:, None]
        one, other = (Rigid(*(each[index] for each in self.poses)) for index in (before, after))
        dot = np.sum(one.turn * other.turn, axis=1, keepdims=True)
        angle = np.arccos(np.clip(np.abs(dot), 0, 1))
        near = np.sin(angle) < 1e-9
        sine = np.where(near, 1.0, np.sin(angle))
        first = np.where(near, 1 - share, np.sin((1 - share) * angle) / sine)
        second = np.where(near, share, np.sin(share * angle) / sine) * np.where(dot < 0, -1, 1)
        place, turn = (1 - share) * one.place + share * other.place, first * one.turn + second * other.turn
        moved = np.linalg.norm(other.place - one.place, axis=1) > STILL
        gap = (span > LONGEST_GAP) & (moved | (2 * angle[:, 0] > STILL_ANGLE))
        exact = (times == self.times[before]) | (times == self.times[after])
        outside = (times < self.times[0]) | (times > self.times[-1]) | ~np.isfinite(times)
        unknown = (outside | (gap & ~exact))[:, None]
        return Rigid(np.where(unknown, np.nan, place), np.where(unknown, np.nan, turn))

    def apart(self, times: Array) -> Array:
        """The time from each of `times` to the nearest pose [s]; 0 for what does not move."""
        if self.still:
            return np.zeros(len(times))
        after = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        return np.minimum(np.abs(times - self.times[after - 1]), np.abs(self.times[after] - times))


def product(one: Array, other: Array) -> Array:
    """The product of quaternions (n, 4)."""
    x, y, z, w = one.T
    a, b, c, d = other.T
    return np.stack(
        (w * a + x * d + y * c - z * b, w * b - x * c + y * d + z * a, w * c + x * b - y * a + z * d,
         w * d - x * a - y * b - z * c), axis=1,
    )  # fmt: skip


def rotated(turn: Array, vectors: Array) -> Array:
    """Vectors (n, 3) turned by unit quaternions (n, 4)."""
    axis, scalar = turn[:, :3], turn[:, 3:]
    twice = 2 * np.cross(axis, vectors)
    return vectors + scalar * twice + np.cross(axis, twice)
