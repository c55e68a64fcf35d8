"""Worlds of straight walls and circles, put together from small pieces: `room(…) + desk(…) + chair(…)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, pi, radians, sin

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]


@dataclass(frozen=True)
class Material:
    """How a surface answers a beam.

    returns: share of the beams that come back; widest: largest angle of incidence with a return [rad].
    roughness: standard deviation of the surface about its wall [m]. Rough surfaces do not count as walls in the truth.
    warp: standard deviation of a wall from straight [m], along which it bends in waves of about `warp_length` [m].
    """

    returns: float = 1.0
    widest: float = pi / 2
    roughness: float = 0.0
    warp: float = 0.0
    warp_length: float = 1.0


IDEAL = Material()
PAINT = Material(returns=0.9985, widest=radians(89))
DARK = Material(returns=0.80, widest=radians(72))
GLASS = Material(returns=0.85, widest=radians(14))
METAL = Material(returns=0.99, widest=radians(83))
CLOTH = Material(returns=0.97)
PLASTER = Material(returns=0.9985, widest=radians(89), warp=0.008, warp_length=1.2)
BOARD = Material(returns=0.9985, widest=radians(89), warp=0.02, warp_length=0.8)
ROUGH = Material(returns=0.98, roughness=0.06)


@dataclass(frozen=True, eq=False)
class World:
    """Walls (W, 4) of x1, y1, x2, y2 and circles (C, 3) of x, y, radius [m], and the material of each."""

    walls: NDArray[np.float64]
    circles: NDArray[np.float64]
    wall_materials: tuple[Material, ...]
    circle_materials: tuple[Material, ...]

    def __post_init__(self) -> None:
        if self.walls.shape != (len(self.wall_materials), 4) or self.circles.shape != (len(self.circle_materials), 3):
            raise ValueError(
                f"a world needs walls (W, 4) and circles (C, 3) with a material each; walls have the shape "
                f"{self.walls.shape} and {len(self.wall_materials)} materials, circles {self.circles.shape} "
                f"and {len(self.circle_materials)}"
            )

    @classmethod
    def of(
        cls, walls: Iterable[Sequence[float]] = (), circles: Iterable[Sequence[float]] = (), material: Material = PAINT
    ) -> World:
        """Walls and circles of one material."""
        wall_rows = np.array(list(walls), dtype=np.float64).reshape(-1, 4)
        circle_rows = np.array(list(circles), dtype=np.float64).reshape(-1, 3)
        return cls(wall_rows, circle_rows, (material,) * len(wall_rows), (material,) * len(circle_rows))

    def __add__(self, other: World) -> World:
        """The two worlds together; the walls of `self` keep their indices."""
        return World(
            np.vstack((self.walls, other.walls)),
            np.vstack((self.circles, other.circles)),
            self.wall_materials + other.wall_materials,
            self.circle_materials + other.circle_materials,
        )

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials of the walls, then of the circles: the order in which `cast` numbers its targets."""
        return self.wall_materials + self.circle_materials


NOTHING = World.of()


@dataclass(frozen=True)
class Feature:
    """Something in a wall, centred `at` [m] from its start and set back by `depth` [m]; negative: it stands out.

    An open feature has jambs of that depth and nothing between them.
    """

    at: float
    width: float
    depth: float
    material: Material = PAINT
    open: bool = False


def door(at: float, width: float = 0.95, depth: float = 0.12) -> Feature:
    """A closed door in its frame."""
    return Feature(at, width, depth)


def opening(at: float, width: float = 0.95, depth: float = 0.2) -> Feature:
    """An open doorway in a wall of the given thickness."""
    return Feature(at, width, depth, open=True)


def window(at: float, width: float = 1.6) -> Feature:
    """A pane down to the floor: it returns only beams that hit it almost at a right angle."""
    return Feature(at, width, 0.06, GLASS)


def fire_cabinet(at: float) -> Feature:
    """A hydrant's cabinet, standing out of the wall."""
    return Feature(at, 0.72, -0.2, METAL)


def facade(start: Point, end: Point, features: Iterable[Feature] = (), material: Material = PAINT) -> World:
    """A wall whose free side lies to the left of start → end, with its features, each piece a wall of its own."""
    origin = np.array(start, dtype=float)
    along = np.array(end, dtype=float) - origin
    length = float(np.hypot(*along))
    along /= length
    into = np.array((along[1], -along[0]))
    world, done = NOTHING, 0.0
    for feature in sorted(features, key=lambda each: each.at):
        left, right = feature.at - feature.width / 2, feature.at + feature.width / 2
        if left < done or right > length:
            raise ValueError(
                f"a feature from {left:g} to {right:g} m does not fit into the wall from {start} to {end}; "
                f"{done:g} to {length:g} m is free"
            )
        corners = [origin + along * left, origin + along * right]
        backs = [corner + into * feature.depth for corner in corners]
        world += polyline([origin + along * done, corners[0]], material)
        if feature.depth:
            world += polyline([corners[0], backs[0]], material) + polyline([backs[1], corners[1]], material)
        if not feature.open:
            world += polyline(backs, feature.material)
        done = right
    return world + polyline([origin + along * done, np.array(end, dtype=float)], material)


def room(
    corners: Sequence[Point], features: Mapping[int, Iterable[Feature]] | None = None, material: Material = PAINT
) -> World:
    """A closed outline, counter-clockwise and seen from inside; `features` by the index of a wall's first corner."""
    features = features or {}
    world = NOTHING
    for index, corner in enumerate(corners):
        world += facade(corner, corners[(index + 1) % len(corners)], features.get(index, ()), material)
    return world


def polyline(points: Sequence, material: Material = PAINT) -> World:
    """Walls from point to point; none between two equal points."""
    pairs = pairwise(points)
    return World.of(((*a, *b) for a, b in pairs if not np.allclose(a, b, rtol=0, atol=1e-9)), material=material)


def box(centre: Point, width: float, depth: float, heading: float = 0.0, material: Material = PAINT) -> World:
    """The four sides of a cabinet, a pillar, a parcel."""
    corners = _placed(
        centre, heading, [(sx * width / 2, sy * depth / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )
    return polyline([*corners, corners[0]], material)


def circle(centre: Point, radius: float, material: Material = CLOTH) -> World:
    """A column, a leg, a bin; or a round hall if the laser stands inside."""
    return World.of(circles=[(*centre, radius)], material=material)


def desk(centre: Point, width: float = 1.6, depth: float = 0.7, heading: float = 0.0) -> World:
    """Four round legs, and a panel along the back (the side at +y when the heading is 0)."""
    x, y = width / 2 - 0.06, depth / 2 - 0.06
    legs = _placed(centre, heading, [(-x, -y), (x, -y), (x, y), (-x, y)])
    panel = _placed(centre, heading, [(-x + 0.05, depth / 2 - 0.03), (x - 0.05, depth / 2 - 0.03)])
    return World.of(circles=[(*leg, 0.025) for leg in legs], material=METAL) + polyline(panel)


def chair(centre: Point, heading: float = 0.0) -> World:
    """Four thin legs."""
    legs = _placed(centre, heading, [(-0.2, -0.2), (0.2, -0.2), (0.22, 0.22), (-0.22, 0.22)])
    return World.of(circles=[(*leg, 0.014) for leg in legs], material=METAL)


def swivel_chair(centre: Point, heading: float = 0.0) -> World:
    """A column and five castors, all black."""
    angles = [heading + 2 * pi * k / 5 for k in range(5)]
    feet = [(centre[0] + 0.28 * cos(angle), centre[1] + 0.28 * sin(angle), 0.03) for angle in angles]
    return World.of(circles=[(*centre, 0.03), *feet], material=DARK)


def person(position: Point, heading: float, stride: float) -> World:
    """Two legs; `stride` [m] is how far the left leg is in front of the body, and the right one behind it."""
    left, right = _placed(position, heading, [(stride, 0.1), (-stride, -0.1)])
    return circle(left, 0.065) + circle(right, 0.065)


def _placed(centre: Point, heading: float, points: Sequence[Point]) -> list[Point]:
    c, s = cos(heading), sin(heading)
    return [(centre[0] + c * x - s * y, centre[1] + s * x + c * y) for x, y in points]
