"""A laser in a world: where its beams end (`cast`), what it measures (`scan`), and a drive (`drive`, `record`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf, pi, radians
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scan import Floats, Recording, Scan
from .warp import warped
from .world import Material, World

_NOTHING = Material(returns=0.0)


@dataclass(frozen=True)
class Laser:
    """A range finder; angles and standard deviations in radians and metres.

    sigma: for ranges up to `far`; sigma_far: for longer ones. growth: share of the range that is added to it, and
    grazing: share of the depth of the beam's footprint on a slanted wall; both as independent errors.
    resolution: step of the ranges, 0 for none.
    beam_width: if the two edges of a beam hit different surfaces more than 0.1 m apart, it is a mixed pixel with
    probability `mixed`: it measures a range between the two.
    rate: sweeps per second.
    """

    name: str
    angle_min: float
    angle_increment: float
    beams: int
    range_min: float
    range_max: float
    sigma: float = 0.0
    sigma_far: float = 0.0
    far: float = inf
    resolution: float = 0.001
    beam_width: float = 0.0
    mixed: float = 0.0
    rate: float = 40.0
    growth: float = 0.0
    grazing: float = 0.0

    @property
    def bearings(self) -> Floats:
        return self.angle_min + self.angle_increment * np.arange(self.beams)


# ±30 mm up to 10 m and ±50 mm beyond are taken as three standard deviations (Table 1 of the paper).
UTM_30LX = Laser(
    "UTM-30LX", radians(-135), radians(0.25), 1081, 0.1, 30.0,
    sigma=0.010, sigma_far=0.050 / 3, far=10.0, beam_width=radians(0.18), mixed=0.7,
)  # fmt: skip
LMS_200 = Laser(
    "LMS 200", radians(-90), radians(0.5), 361, 0.1, 81.9,
    sigma=0.005, sigma_far=0.010, far=8.0, resolution=0.01, beam_width=radians(0.25), mixed=0.5, rate=37.5,
)  # fmt: skip
RPLIDAR_A2 = Laser(
    "RPLIDAR A2", -pi, radians(1.0), 360, 0.15, 12.0,
    sigma=0.008, sigma_far=0.030, far=5.0, beam_width=radians(0.3), mixed=0.5, rate=10.0,
)  # fmt: skip
# 1 % of the range is taken as two standard deviations; steps of a quarter of a millimetre.
RPLIDAR_A1 = Laser(
    "RPLIDAR A1", -pi, radians(1.0), 360, 0.15, 12.0,
    sigma=0.003, sigma_far=0.003, resolution=0.00025, beam_width=radians(0.3), mixed=0.5, rate=5.5, growth=0.005,
)  # fmt: skip
TIM_561 = Laser(
    "TiM561", radians(-135), radians(1 / 3), 811, 0.05, 10.0,
    sigma=0.02, sigma_far=0.02, beam_width=radians(0.49), mixed=0.7, rate=15.0, grazing=0.1,
)  # fmt: skip
# One plane of a lidar with 16 layers, as a ROS node makes it: the beams do not quite fill the circle.
LIDAR_16 = Laser(
    "16-layer lidar", -pi, 2 * pi / 898.4, 897, 0.3, 100.0,
    sigma=0.012, sigma_far=0.012, resolution=0.002, beam_width=radians(0.17), mixed=0.5, rate=10.0,
)  # fmt: skip
# Beyond this angle of incidence the footprint of a beam no longer grows.
MOST_SLANTED = radians(85)


class Hits(NamedTuple):
    """Where beams end: ranges (n,) [m], inf for nowhere; targets (n,): a wall, then a circle, −1 none; incidence (n,)
    [rad] between beam and surface normal."""

    ranges: Floats
    targets: NDArray[np.int64]
    incidence: Floats


def cast(world: World, origin: ArrayLike, angles: Floats) -> Hits:
    """The nearest surface along each of the rays from `origin` (2,) in the world's directions `angles` (n,)."""
    origin = np.asarray(origin, dtype=np.float64)
    directions = np.column_stack((np.cos(angles), np.sin(angles)))
    ranges = np.hstack((_to_walls(world.walls, origin, directions), _to_circles(world.circles, origin, directions)))
    if not ranges.shape[1]:
        return Hits(np.full(len(angles), inf), np.full(len(angles), -1), np.zeros(len(angles)))
    targets = ranges.argmin(axis=1)
    nearest = ranges[np.arange(len(angles)), targets]
    hit = np.isfinite(nearest)
    normals = _normals(world, origin, directions, nearest, targets)
    incidence = np.arccos(np.clip(np.abs((directions * normals).sum(axis=1)), 0, 1))
    return Hits(nearest, np.where(hit, targets, -1), np.where(hit, incidence, 0.0))


def _to_walls(walls: Floats, origin: Floats, directions: Floats) -> Floats:
    """(n, W) ranges: origin + r·d = start + s·(end − start) with r > 0 and 0 ≤ s ≤ 1, by Cramer's rule."""
    start = walls[:, :2] - origin
    along = walls[:, 2:] - walls[:, :2]
    across = np.outer(directions[:, 0], along[:, 1]) - np.outer(directions[:, 1], along[:, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0]) / across
        share = (np.outer(directions[:, 1], start[:, 0]) - np.outer(directions[:, 0], start[:, 1])) / across
    return np.where((ranges > 0) & (share >= 0) & (share <= 1), ranges, inf)


def _to_circles(circles: Floats, origin: Floats, directions: Floats) -> Floats:
    """(n, C) ranges: the smallest positive root r of |origin + r·d − centre| = radius."""
    centre = circles[:, :2] - origin
    middle = directions @ centre.T
    under = middle**2 - (centre**2).sum(axis=1) + circles[:, 2] ** 2
    half = np.sqrt(np.maximum(under, 0))
    ranges = np.where(middle - half > 0, middle - half, middle + half)
    return np.where((under >= 0) & (ranges > 0), ranges, inf)


def _normals(world: World, origin: Floats, directions: Floats, ranges: Floats, targets: NDArray) -> Floats:
    """(n, 2) unit normals of the surfaces where the beams end; arbitrary for a beam that hits nothing."""
    along = world.walls[:, 2:] - world.walls[:, :2]
    of_walls = np.column_stack((-along[:, 1], along[:, 0])) / np.hypot(along[:, 0], along[:, 1])[:, None]
    if not len(world.circles):
        return of_walls[targets]
    which = np.maximum(targets - len(world.walls), 0)
    points = origin + np.where(np.isfinite(ranges), ranges, 0.0)[:, None] * directions
    of_circles = (points - world.circles[which, :2]) / world.circles[which, 2:]
    if not len(world.walls):
        return of_circles
    on_wall = targets < len(world.walls)
    return np.where(on_wall[:, None], of_walls[np.where(on_wall, targets, 0)], of_circles)


def scan(
    world: World, pose: ArrayLike, laser: Laser, rng: np.random.Generator, stamp: float = 0.0, frame_id: str = "laser"
) -> Scan:
    """One sweep from `pose` (x, y, heading), taken at one instant, with the exact truth.

    Ranges are float32, inf for no return: nothing in reach, or a dropout on dark, glossy or transparent material.
    `wall` is the index into `world.walls`, or −1 for no return, mixed pixels, circles and rough surfaces.
    The number of random values drawn does not depend on what the beams hit.
    """
    x, y, heading = np.asarray(pose, dtype=np.float64)
    angles = heading + laser.bearings
    ranges, targets, incidence = cast(world, (x, y), angles)
    normal, draw, share, answer = rng.standard_normal(laser.beams), *rng.random((3, laser.beams))

    materials = (*world.materials, _NOTHING)
    rough = np.array([material.roughness for material in materials])[targets]
    comes_back = answer < np.array([material.returns for material in materials])[targets]
    comes_back &= incidence <= np.array([material.widest for material in materials])[targets]

    ranges = _on_warped_walls(world, (x, y), angles, Hits(ranges, targets, incidence))
    near, far = _footprint(world, (x, y), angles, laser)
    mixed = (far > near) & (draw < laser.mixed)
    ranges = np.where(mixed, near + share * (far - near), ranges)
    comes_back |= mixed

    sigma = np.hypot(_sigma(laser, ranges, incidence), rough)
    with np.errstate(invalid="ignore"):
        measured = ranges + sigma * normal
    if laser.resolution:
        measured = np.round(measured / laser.resolution) * laser.resolution
    comes_back &= (measured >= laser.range_min) & (measured < laser.range_max)
    is_wall = comes_back & ~mixed & (rough == 0) & (targets < len(world.walls))
    return Scan.regular(
        np.where(comes_back, measured, inf).astype(np.float32),
        laser.angle_min,
        laser.angle_increment,
        range_min=laser.range_min,
        range_max=laser.range_max,
        stamp=stamp,
        frame_id=frame_id,
        wall=np.where(is_wall, targets, -1).astype(np.int16),
    )


def _on_warped_walls(world: World, origin: tuple[float, float], angles: Floats, hits: Hits) -> Floats:
    """(n,) ranges to walls that are not quite straight, by fixed-point iteration."""
    ranges = hits.ranges
    if any(material.warp for material in world.wall_materials):
        directions = np.column_stack((np.cos(angles), np.sin(angles)))
        slope = np.cos(np.minimum(hits.incidence, MOST_SLANTED))
        for _ in range(3):
            points = origin + np.where(np.isfinite(ranges), ranges, 0.0)[:, None] * directions
            ranges = hits.ranges - warped(world, points, hits.targets) / slope
    return ranges


def _sigma(laser: Laser, ranges: Floats, incidence: Floats) -> Floats:
    """(n,) standard deviations of ranges."""
    reach = np.where(np.isfinite(ranges), ranges, 0.0)
    depth = reach * laser.beam_width * np.tan(np.minimum(incidence, MOST_SLANTED))
    constant = np.where(ranges <= laser.far, laser.sigma, laser.sigma_far)
    return np.hypot(np.hypot(constant, laser.growth * reach), laser.grazing * depth)


def _footprint(world: World, origin: tuple[float, float], angles: Floats, laser: Laser) -> tuple[Floats, Floats]:
    """Ranges of the nearer and the farther surface that each beam hits; equal if it hits only one."""
    if not laser.beam_width:
        return np.zeros(len(angles)), np.zeros(len(angles))
    right = cast(world, origin, angles - laser.beam_width / 2)
    left = cast(world, origin, angles + laser.beam_width / 2)
    with np.errstate(invalid="ignore"):
        apart = np.abs(right.ranges - left.ranges) > 0.1
    edge = apart & (right.targets != left.targets) & (right.targets >= 0) & (left.targets >= 0)
    edge[edge] = ~_joined(world, right.targets[edge], left.targets[edge])
    near, far = np.minimum(right.ranges, left.ranges), np.maximum(right.ranges, left.ranges)
    return np.where(edge, near, 0.0), np.where(edge, far, 0.0)


def _joined(world: World, one: NDArray, other: NDArray) -> NDArray[np.bool_]:
    """Whether two targets are walls that meet. Across a corner the surface is continuous, however steep it looks."""
    walls = np.vstack((world.walls, np.full((len(world.circles), 4), np.nan)))
    ends, others = walls[one].reshape(-1, 2, 1, 2), walls[other].reshape(-1, 1, 2, 2)
    return (np.abs(ends - others).max(axis=3) < 1e-6).any(axis=(1, 2))


def drive(start: Sequence[float], legs: Iterable[Sequence[float]], stamps: Floats) -> Floats:
    """Poses (frames, 3) of a robot that starts at (x, y, heading) and drives (seconds, speed, yaw rate) leg by leg.

    Speed and yaw rate change over 0.8 s, as a robot's do. After the last leg it stands still.
    """
    step = 0.005
    rates = np.vstack([np.tile(leg[1:], (round(leg[0] / step), 1)) for leg in legs] + [np.zeros((1, 2))])
    missing = int(np.ceil(stamps[-1] / step)) + 2 - len(rates)
    rates = np.vstack((rates, np.zeros((max(missing, 0), 2))))
    window = round(0.8 / step)
    padded = np.pad(rates, ((window // 2, window - window // 2 - 1), (0, 0)), mode="edge")
    sums = np.cumsum(np.vstack((np.zeros(2), padded)), axis=0)
    speed, yaw_rate = ((sums[window:] - sums[:-window]) / window).T
    heading = start[2] + np.concatenate(([0.0], np.cumsum(yaw_rate[:-1]) * step))
    x = start[0] + np.concatenate(([0.0], np.cumsum(speed * np.cos(heading))[:-1] * step))
    y = start[1] + np.concatenate(([0.0], np.cumsum(speed * np.sin(heading))[:-1] * step))
    times = step * np.arange(len(heading))
    return np.column_stack([np.interp(stamps, times, values) for values in (x, y, heading)])


def record(
    world_at: Callable[[float], World],
    poses: Floats,
    stamps: Floats,
    laser: Laser,
    rng: np.random.Generator,
    name: str = "",
) -> Recording:
    """A recording with truth: a scan from each pose at its stamp. Walls must not change; circles may."""
    scans = [scan(world_at(stamp), pose, laser, rng, stamp) for pose, stamp in zip(poses, stamps.tolist(), strict=True)]
    return Recording.from_scans(scans, name, poses=poses, walls=world_at(0.0).walls)
