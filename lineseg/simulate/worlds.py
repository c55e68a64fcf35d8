"""More worlds with truth, listed in `WORLDS`. They are simulated on request, not stored in files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import pi, radians

import numpy as np

from ..scan import Recording
from .laser import LIDAR_16, LMS_200, RPLIDAR_A1, RPLIDAR_A2, TIM_561, UTM_30LX, Laser, drive, record
from .world import (
    BOARD,
    CLOTH,
    DARK,
    METAL,
    PAINT,
    PLASTER,
    ROUGH,
    World,
    box,
    chair,
    circle,
    desk,
    door,
    facade,
    opening,
    polyline,
    room,
    swivel_chair,
    window,
)

FRAMES = 120
SECONDS = 30.0


@dataclass(frozen=True)
class Drive:
    """A laser driven through a static world. legs: (seconds, speed [m/s], yaw rate [rad/s]) in order."""

    about: str
    world: Callable[[], World]
    laser: Laser
    start: Sequence[float]
    legs: Sequence[Sequence[float]]
    seed: int

    def recording(self, name: str, frames: int = FRAMES) -> Recording:
        """Scans from SECONDS of the drive, with their truth: the same every time."""
        stamps = SECONDS / frames * np.arange(frames)
        world, poses = self.world(), drive(self.start, self.legs, stamps)
        return record(lambda _: world, poses, stamps, self.laser, np.random.default_rng(self.seed), name)


def office() -> World:
    """14 m by 9 m: desks in rows with chairs, partitions, cabinets, bins; windows to the south."""
    features = {
        0: [window(2.0), window(5.0), window(8.0), window(11.0)],
        2: [door(3.0), opening(9.0, 1.0, 0.1)],
        3: [door(4.5)],
    }
    world = room([(0, 0), (14, 0), (14, 9), (0, 9)], features)
    for x in (2.2, 5.4, 8.6, 11.8):
        for y, turn in ((2.0, pi), (7.0, 0.0)):
            world += desk((x, y), heading=turn) + swivel_chair((x + 0.2, 4.5 + (y - 4.5) * 0.6), 0.4 * x)
        world += chair((x - 0.9, 2.9), 0.3 * x) + circle((x + 1.1, 1.6), 0.14, METAL)
    for x in (3.8, 7.0, 10.2):
        world += polyline([(x, 0.4), (x, 3.0)], CLOTH) + polyline([(x, 6.2), (x, 8.6)], CLOTH)
    world += box((0.3, 7.6), 0.45, 1.2) + box((13.7, 2.0), 0.45, 1.6, material=METAL)
    return world + box((6.9, 8.7), 1.0, 0.4) + box((13.6, 7.9), 0.6, 0.6, radians(8), DARK)


def warehouse() -> World:
    """24 m by 16 m: racks on posts with pallets in them, round and square pillars."""
    world = room([(0, 0), (24, 0), (24, 16), (0, 16)], {0: [door(5.0, 3.0, 0.2), door(14.0, 3.0, 0.2)]})
    for y in (3.4, 8.0, 12.6):
        for x in np.arange(4.0, 20.1, 2.7):
            world += box((x, y - 0.5), 0.1, 0.08, material=METAL) + box((x, y + 0.5), 0.1, 0.08, material=METAL)
        for k, x in enumerate(np.arange(5.35, 19.0, 2.7)):
            if (k + int(y)) % 3:
                world += box((x, y), 1.2, 0.8, radians(2.0 * k - 4), PAINT if k % 2 else CLOTH)
    for x in (2.0, 12.0, 22.0):
        world += circle((x, 5.7), 0.25, PAINT) + box((x, 10.3), 0.4, 0.4)
    return world + box((21.8, 14.6), 1.2, 0.8, radians(25))


def corridor() -> World:
    """60 m by 2 m with a door every four metres on both sides, some open, and a bench."""
    doors = [door(at, depth=0.12) for at in np.arange(3.0, 58.0, 4.0)]
    others = [
        opening(at, 0.95, 0.12) if k % 5 == 2 else door(at, depth=0.12)
        for k, at in enumerate(np.arange(4.0, 58.0, 4.0))
    ]
    world = facade((0, 0), (60, 0), doors) + facade((60, 0), (60, 2.0), [door(1.0, 1.4, 0.1)])
    world += facade((60, 2.0), (0, 2.0), others) + facade((0, 2.0), (0, 0))
    return world + box((21.0, 0.22), 1.4, 0.36, material=METAL) + circle((35.2, 1.85), 0.12, METAL)


def flat() -> World:
    """Three small rooms with a bed, a sofa, a table and chairs."""
    world = room([(0, 0), (7.2, 0), (7.2, 5.4), (0, 5.4)], {0: [window(2.0, 1.4)], 2: [window(1.6, 1.2)]})
    world += polyline([(3.6, 0), (3.6, 1.4)]) + polyline([(3.6, 2.3), (3.6, 5.4)])
    world += polyline([(3.6, 3.0), (5.0, 3.0)]) + polyline([(5.9, 3.0), (7.2, 3.0)])
    world += box((0.95, 4.3), 1.9, 2.0, material=CLOTH) + box((2.9, 0.45), 1.2, 0.8, material=CLOTH)
    world += desk((5.6, 1.5), 1.4, 0.8) + chair((5.1, 0.9), 0.2) + chair((6.1, 0.95), -0.3) + chair((5.6, 2.2), 3.0)
    return world + box((6.9, 4.4), 0.5, 1.1) + circle((3.2, 4.9), 0.2, CLOTH)


def yard() -> World:
    """Between houses: facades at odd angles, a hedge, trees, parked cars; much of the view is open."""
    world = facade((-4, -8), (14, -6), [door(4.0), window(8.0), door(12.0)])
    world += facade((18, -2), (16, 12), [door(3.0), window(7.0)])
    world += polyline([(8, 14), (2, 13), (1, 17)]) + polyline([(-8, 10), (-9, 1), (-13, 0)])
    world += polyline([(-7, -5), (-3, -7.5)], ROUGH) + polyline([(10, 13.5), (14, 13)], ROUGH)
    for x, y, heading in ((2.0, -3.9, 7.0), (7.4, -3.3, 6.0), (13.4, 4.0, 97.0)):
        world += box((x, y), 4.3, 1.75, radians(heading), METAL)
    for x, y in ((-5.0, 3.0), (-2.0, 8.5), (5.0, 9.0), (9.5, 7.5)):
        world += circle((x, y), 0.22, CLOTH)
    return world + box((-4.6, 7.6), 1.6, 0.5, radians(40)) + circle((5.6, 3.6), 0.06, METAL)


def boards() -> World:
    """An L-shaped room of six boards, which bend by centimetres, with a cabinet and a chair."""
    world = room([(0, 0), (9, 0), (9, 4.2), (4.6, 4.2), (4.6, 8), (0, 8)], material=BOARD)
    return world + box((0.4, 7.0), 0.7, 1.0, material=METAL) + chair((7.8, 3.2), 0.4)


def lobby() -> World:
    """12 m by 9 m, plastered: doors and one whole side stand open, with nothing behind them but rows of chairs."""
    features = {
        0: [opening(2.5), door(6.0), opening(9.5, 1.8)],
        1: [opening(4.5, 5.0)],
        2: [opening(3.0, 0.9), door(7.5)],
        3: [opening(5.5, 1.2)],
    }
    world = room([(0, 0), (12, 0), (12, 9), (0, 9)], features, PLASTER)
    for k in range(7):
        world += chair((11.3, 2.4 + 0.7 * k), 0.1 * k) + chair((3.2 + 0.65 * k, 7.6), 0.2 * k)
    return world + desk((4.0, 1.4), heading=pi) + circle((8.6, 6.4), 0.25) + box((0.35, 8.3), 0.6, 0.9)


def workshop() -> World:
    """16 m by 7 m: long plastered walls met at grazing angles, partitions of boards, an open gate, benches on legs."""
    features = {0: [door(3.0), opening(11.0, 3.0)], 1: [opening(5.0, 1.0)], 2: [opening(4.0), door(12.0, 2.0, 0.15)]}
    world = room([(0, 0), (16, 0), (16, 7), (0, 7)], features, PLASTER)
    world += polyline([(5.5, 7), (5.5, 5.2), (7.5, 5.2)], BOARD) + polyline([(9.0, 0), (9.0, 1.8)], BOARD)
    for x in (2.0, 12.5, 14.5):
        world += desk((x, 5.9), heading=pi) + swivel_chair((x + 0.1, 5.0), x)
    return world + box((10.6, 6.6), 1.2, 0.6, material=METAL) + circle((7.4, 1.2), 0.15) + chair((13.4, 1.2), 0.7)


# Straight ahead, then a gentle turn back, all within free space.
_UP_AND_DOWN = [(11.0, 0.5, 0.01), (5.0, 0.15, 0.628), (14.0, 0.35, 0.005)]

WORLDS = {
    "office": Drive("An office: desks, chairs, partitions", office, UTM_30LX, (1.2, 4.5, 0.0), _UP_AND_DOWN, 1),
    "warehouse": Drive(
        "A warehouse: racks on posts, pallets, pillars", warehouse, UTM_30LX, (3.2, 5.6, 0.0),
        _UP_AND_DOWN, 2,
    ),
    "corridor": Drive(
        "A long corridor with doors, seen by a coarse laser", corridor, LMS_200, (8.0, 1.0, 0.0),
        [(10.0, 0.8, 0.006), (20.0, 0.8, -0.003)], 3,
    ),
    "flat": Drive(
        "A flat, seen by a cheap and noisy laser all round", flat, RPLIDAR_A2, (2.2, 1.6, 0.3),
        [(6.0, 0.12, 0.05), (10.0, 0.1, 0.2), (14.0, 0.1, -0.15)], 4,
    ),
    "yard": Drive(
        "Outdoors: facades at odd angles, cars, trees, a hedge", yard, UTM_30LX, (-2.0, 1.0, 0.1),
        [(12.0, 0.5, 0.02), (6.0, 0.3, 0.3), (12.0, 0.4, 0.0)], 5,
    ),
    "boards": Drive(
        "A room of boards that bend, seen by one plane of a 16-layer lidar", boards, LIDAR_16, (1.6, 1.6, 0.0),
        [(12.0, 0.45, 0.01), (5.0, 0.15, 0.628), (13.0, 0.35, -0.03)], 6,
    ),
    "lobby": Drive(
        "A lobby with open doors, seen by a laser that errs by 1 % of the range", lobby, RPLIDAR_A1, (1.5, 4.2, 0.0),
        _UP_AND_DOWN, 7,
    ),
    "workshop": Drive(
        "A workshop, seen by a laser that scatters at grazing angles", workshop, TIM_561, (2.0, 3.2, 0.0),
        [(14.0, 0.55, 0.004), (5.0, 0.15, 0.628), (11.0, 0.4, 0.0)], 8,
    ),
}  # fmt: skip
