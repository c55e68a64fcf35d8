"""One sweep of a 2D laser (`Scan`) and many of them (`Recording`)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .poses import PoseSource, Track

if TYPE_CHECKING:
    from .readers.account import Account

Floats = NDArray[np.floating]

# The ends of a full circle are at most this far apart [rad], and at most this many beams are missing between them.
SEAM = np.pi / 5
MOST_MISSING = 10


class Fan(NamedTuple):
    """Where the beams of a scan point; scans of a recording often share one.

    bearings: (n,) [rad]; rays: (2, n), see `Scan.rays`; around: see `Scan.around`.
    """

    bearings: Floats
    rays: NDArray[np.float64]
    around: int


@dataclass(frozen=True, eq=False)
class Scan:
    """One sweep, beam by beam in the order of measurement; beams without a return stay in place.

    ranges: (n,) [m]; NaN, ±inf, 0 and sentinels stand for "no return".
    bearings: (n,) [rad], counter-clockwise from the x axis; they may fall from beam to beam.
    range_min, range_max: [m]; a beam is valid if its range is finite, > 0, ≥ range_min and < range_max.
    wall: (n,) int, the true wall of each beam, −1 for none; None where the truth is unknown.
    known: values already computed from these bearings by another scan that shares them.
    """

    ranges: Floats
    bearings: Floats
    range_min: float = 0.0
    range_max: float = np.inf
    stamp: float = 0.0
    frame_id: str = ""
    wall: NDArray[np.integer] | None = None
    known: Fan | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        for name, array in (("ranges", self.ranges), ("bearings", self.bearings)):
            if not isinstance(array, np.ndarray):
                raise TypeError(f"{name} must be an array, not {type(array).__name__}; numpy.asarray({name}) makes one")
        if self.ranges.ndim != 1 or self.ranges.shape != self.bearings.shape:
            raise ValueError(
                f"a scan needs one range and one bearing for each beam; ranges have the shape {self.ranges.shape}, "
                f"bearings {self.bearings.shape}"
            )
        if self.wall is not None and self.wall.shape != self.ranges.shape:
            raise ValueError(f"wall has the shape {self.wall.shape}; it needs that of ranges, {self.ranges.shape}")

    @classmethod
    def regular(cls, ranges: Floats, angle_min: float, angle_increment: float, **fields) -> Scan:
        """A scan whose beams are `angle_increment` apart, as in sensor_msgs/LaserScan; its bearings are read-only."""
        ranges = np.asarray(ranges)
        fan = regular_fan(float(angle_min), float(angle_increment), ranges.size)
        return cls(ranges, fan.bearings, known=fan, **fields)

    def __len__(self) -> int:
        return len(self.ranges)

    @cached_property
    def valid(self) -> NDArray[np.bool_]:
        """(n,) bool: the beams that returned something."""
        return are_valid(self.ranges, self.range_min, self.range_max)

    @cached_property
    def fan(self) -> Fan:
        """Where the beams point."""
        # `replace` may have given the scan other bearings.
        if self.known is not None and self.known.bearings is self.bearings:
            return self.known
        return fan_of(self.bearings)

    @property
    def rays(self) -> NDArray[np.float64]:
        """(2, n): unit vectors along the beams; read-only, for numba compiles a kernel once more for the other kind."""
        return self.fan.rays

    @cached_property
    def xy(self) -> NDArray[np.float64]:
        """(n, 2) [m] in the frame of the laser; NaN where the beam is not valid."""
        ranges = np.where(self.valid, self.ranges, np.nan).astype(np.float64)
        return (ranges * self.rays).T

    @property
    def full_circle(self) -> bool:
        """Whether the last beam is next to the first, or only a few are missing between: it has no first beam."""
        return self.around > 0

    @property
    def around(self) -> int:
        """The number of beams in a whole turn, with those missing at the seam; 0 if the scan is not a full circle.

        The missing ones are a dropout: past the seam, beam numbers continue at `around`.
        """
        return self.fan.around


@dataclass(frozen=True)
class Topic:
    """A stream of scans inside a file, and how many it holds."""

    name: str
    scans: int


@dataclass(frozen=True)
class PackAbout:
    """Where the frame of a failure pack came from, how it was extracted, and its labels.

    labels: as in a label file, see `lineseg.truth.label_file.said_in`; None if nothing was said of the frame.
    """

    recording: str
    frame: int
    method: str
    params: dict[str, int | float]
    note: str
    labels: dict[str, Any] | None = None


@dataclass(frozen=True, eq=False)
class Recording:
    """Many scans in flat arrays; beam count and geometry may differ from scan to scan.

    ranges: (total,) float32 or float64 [m], scan after scan; offsets: (frames + 1,) where each of them begins.
    angle_min, angle_increment [rad], range_min, range_max [m], stamps [s]: (frames,) each.
    frame_ids: the name of the laser's frame, scan by scan.
    bearings: (total,) [rad], only for scans whose beams are not evenly spaced.
    wall: (total,) int, only if the truth is known; walls: (walls, 4) of x1, y1, x2, y2 [m] in the world's frame, for
    simulated recordings, or by many views. wall_source: what is said of walls that many views agree on, "" for others.
    track: the poses of the laser, see `poses` and `pose_source`; None if they are not known.
    time_increment: (frames,) time between beams [s], None if not known.
    topic, topics: the stream these scans come from, and all that the file offers.
    pack: origin of a failure pack; None for other recordings.
    numbers: (frames,) the frame of the file that each scan is, rising, if some were left out; None if none was.
    whole, began: how many frames the file has, and the stamp of its first [s], if some were left out.
    partial: whether more of its file follows, which was not read yet.
    account: what the file was taken for; None for recordings that were not read from a file.
    """

    name: str
    ranges: Floats
    offsets: NDArray[np.int64]
    angle_min: Floats
    angle_increment: Floats
    range_min: Floats
    range_max: Floats
    stamps: Floats
    frame_ids: tuple[str, ...]
    bearings: Floats | None = None
    wall: NDArray[np.integer] | None = None
    track: Track | None = None
    walls: Floats | None = None
    wall_source: str = ""
    time_increment: Floats | None = None
    topic: str = ""
    topics: tuple[Topic, ...] = field(default=())
    format: str = ""
    pack: PackAbout | None = None
    numbers: NDArray[np.int64] | None = None
    whole: int | None = None
    began: float | None = None
    partial: bool = False
    account: Account | None = None

    @classmethod
    def from_scans(cls, scans: Iterable[Scan], name: str = "", *, poses: Floats | None = None, **fields) -> Recording:
        """A recording of the given scans and perhaps the `poses` (frames, 3) of the laser.

        `fields` are those of Recording that no scan knows (topics, walls, …).
        """
        scans = list(scans)
        lengths = np.array([len(scan) for scan in scans], dtype=np.int64)
        have_wall = bool(scans) and all(scan.wall is not None for scan in scans)
        increments = np.array([_increment(scan.bearings) for scan in scans])
        regular = all(
            np.allclose(np.diff(scan.bearings), increment, rtol=0, atol=1e-6)
            for scan, increment in zip(scans, increments, strict=True)
        )
        return cls(
            name=name,
            ranges=_concatenate([scan.ranges for scan in scans]),
            offsets=np.concatenate(([0], np.cumsum(lengths))),
            angle_min=np.array([scan.bearings[0] if len(scan) else 0.0 for scan in scans]),
            angle_increment=increments,
            range_min=np.array([scan.range_min for scan in scans], dtype=float),
            range_max=np.array([scan.range_max for scan in scans], dtype=float),
            stamps=np.array([scan.stamp for scan in scans], dtype=float),
            frame_ids=tuple(scan.frame_id for scan in scans),
            bearings=None if regular else _concatenate([scan.bearings for scan in scans]),
            wall=_concatenate([scan.wall for scan in scans if scan.wall is not None]) if have_wall else None,
            track=None if poses is None else Track.of(np.asarray(poses, float), PoseSource("the program")),
            **fields,
        )

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, frame: int) -> Scan:
        if not -len(self) <= frame < len(self):
            raise IndexError(f"frame {frame} of {self.name or 'the recording'}: it has the frames 0 to {len(self) - 1}")
        frame %= len(self)
        numbers = self._numbers_of_frames()
        first, end = self.offsets[frame], self.offsets[frame + 1]
        return self._scan(first, end, [float(of[frame]) for of in numbers], self.frame_ids[frame])

    def __iter__(self) -> Iterator[Scan]:
        spans = pairwise(self.offsets.tolist())
        numbers = zip(*(of.tolist() for of in self._numbers_of_frames()), strict=True)
        frames = zip(spans, numbers, self.frame_ids, strict=True)
        return (self._scan(first, end, fields, frame_id) for (first, end), fields, frame_id in frames)

    def _numbers_of_frames(self) -> tuple[Floats, ...]:
        return self.angle_min, self.angle_increment, self.range_min, self.range_max, self.stamps

    def _scan(self, first: int, end: int, numbers: Sequence[float], frame_id: str) -> Scan:
        angle_min, increment, range_min, range_max, stamp = numbers
        wall = None if self.wall is None else self.wall[first:end]
        if self.bearings is not None:
            bearings, known = self.bearings[first:end], None
        else:
            # Most scans of a recording share their geometry, so its sines and cosines are computed once.
            known = regular_fan(angle_min, increment, int(end - first))
            bearings = known.bearings
        return Scan(self.ranges[first:end], bearings, range_min, range_max, stamp, frame_id, wall, known)

    def only(self, frames: NDArray[np.integer]) -> Recording:
        """The frames of these numbers, in this order."""
        spans = [slice(*self.offsets[frame : frame + 2]) for frame in frames.tolist()]

        def of_beams(array: NDArray | None) -> Any:
            return None if array is None else _concatenate([array[span] for span in spans])

        of_frames = ("angle_min", "angle_increment", "range_min", "range_max", "stamps")
        return replace(
            self,
            ranges=of_beams(self.ranges),
            bearings=of_beams(self.bearings),
            wall=of_beams(self.wall),
            offsets=np.concatenate(([0], np.cumsum(np.diff(self.offsets)[frames]))),
            frame_ids=tuple(self.frame_ids[frame] for frame in frames.tolist()),
            track=None if self.track is None else self.track.only(frames),
            time_increment=None if self.time_increment is None else self.time_increment[frames],
            numbers=None if self.numbers is None else self.numbers[frames],
            **{name: getattr(self, name)[frames] for name in of_frames},
        )

    @property
    def poses(self) -> Floats | None:
        """(frames, 3) of x, y [m] and heading [rad] of the laser in the world, NaN where unknown; None if all are.

        The first access may read the file once more.
        """
        poses = None if self.track is None else self.track.found.poses
        return poses if poses is not None and np.isfinite(poses).all(axis=1).any() else None

    @property
    def pose_source(self) -> PoseSource:
        """Where the poses come from, or why there are none."""
        return PoseSource(missing="the file has none") if self.track is None else self.track.found.source

    def number(self, frame: int) -> int:
        """The frame of the file that scan `frame` is, counted from 0."""
        return frame if self.numbers is None else int(self.numbers[frame])

    def position(self, number: int) -> int:
        """The scan that is frame `number` of the file, or the one nearest to it."""
        if self.numbers is None:
            return min(max(number, 0), len(self) - 1)
        return int(np.abs(self.numbers - number).argmin())

    def has(self, number: int) -> bool:
        """Whether frame `number` of the file is one of the scans."""
        return self.number(self.position(number)) == number

    @property
    def beams(self) -> tuple[int, int]:
        """The least and the greatest number of beams in a scan."""
        lengths = np.diff(self.offsets)
        return (int(lengths.min()), int(lengths.max())) if len(lengths) else (0, 0)


def are_valid(ranges: Floats, range_min: Floats | float, range_max: Floats | float) -> NDArray[np.bool_]:
    """Which ranges are returns; the limits are numbers, or one for each range. NaN compares false."""
    return (ranges > 0) & (ranges >= range_min) & (ranges < range_max)


@lru_cache(maxsize=64)
def regular_fan(angle_min: float, angle_increment: float, beams: int) -> Fan:
    """The fan of beams that are `angle_increment` apart, read-only."""
    bearings = angle_min + angle_increment * np.arange(beams)
    bearings.flags.writeable = False
    return fan_of(bearings)


def fan_of(bearings: Floats) -> Fan:
    """The fan of beams that point there."""
    rays = np.array((np.cos(bearings), np.sin(bearings)))
    rays.flags.writeable = False
    return Fan(bearings, rays, beams_around(bearings))


def beams_around(bearings: Floats) -> int:
    """See `Scan.around`; the median step tells how many beams fit between the ends."""
    if len(bearings) < 3:
        return 0
    steps = np.abs(np.diff(bearings))
    seam, step = 2 * np.pi - steps.sum(), np.median(steps)
    for missing in range(MOST_MISSING + 1 if seam <= SEAM else 1):
        if seam < (missing + 1.5) * step:
            return len(bearings) + missing
    return 0


def _increment(bearings: Floats) -> float:
    return float((bearings[-1] - bearings[0]) / (len(bearings) - 1)) if len(bearings) > 1 else 0.0


def _concatenate(arrays: list) -> NDArray:
    return np.concatenate(arrays) if arrays else np.empty(0, dtype=np.float32)
