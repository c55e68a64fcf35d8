"""The laboratory: desks, chairs, cabinets, glass, someone walking, and a drive around the desks."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, hypot, pi, radians, sin

import numpy as np

from ..scan import Recording
from .laser import UTM_30LX, Laser, drive, record
from .world import (
    CLOTH,
    DARK,
    METAL,
    ROUGH,
    World,
    box,
    chair,
    circle,
    desk,
    door,
    opening,
    person,
    polyline,
    room,
    swivel_chair,
    window,
)

CORNERS = [(0.0, 0.0), (10.4, 0.0), (10.4, 5.6), (7.8, 5.6), (7.8, 8.2), (0.0, 8.2)]
WALK = [(1.0, 5.9), (6.6, 6.9), (6.8, 5.7), (2.2, 5.7)]


def laboratory() -> World:
    """An L-shaped room, 10.4 m by 8.2 m, without people. Its west door is open, with nothing behind it."""
    features = {
        0: [window(2.0), window(4.2), window(6.4), window(8.6)],
        1: [door(4.6)],
        3: [door(1.4, 1.3)],
        5: [opening(1.9, 1.0, 0.15), door(7.3)],
    }
    return room(CORNERS, features) + _desks() + _along_the_walls() + _clutter()


def _desks() -> World:
    """Two islands of two desks, back to back, and a desk in the north-west."""
    world = World.of()
    for x, y, heading in ((2.5, 2.75, radians(1)), (6.6, 2.8, radians(-2))):
        world += desk((x, y - 0.36), heading=heading) + desk((x, y + 0.36), heading=heading + pi)
        world += box((x - 0.5, y - 0.4), 0.42, 0.56, heading, DARK)
    world += swivel_chair((2.3, 1.7), 0.3) + swivel_chair((6.9, 3.75), 0.9) + chair((2.8, 3.72), 0.4)
    return world + chair((6.2, 1.85), -0.2) + desk((1.2, 7.7), heading=0.0) + swivel_chair((1.5, 6.95), 0.1)


def _along_the_walls() -> World:
    """Cabinets in the north and east, one of them black; a radiator that a laser does not see as a straight line."""
    world = box((3.2, 7.95), 0.9, 0.45) + box((4.15, 7.95), 0.9, 0.45, radians(1.5))
    world += box((5.6, 7.93), 1.2, 0.45, material=DARK) + box((10.15, 1.6), 0.45, 1.8, material=METAL)
    return world + box((9.6, 5.35), 0.9, 0.45) + polyline([(0.09, 2.2), (0.09, 3.6)], ROUGH)


def _clutter() -> World:
    """A pillar, a slanted partition, a bin, parcels, a coat stand."""
    world = box((4.75, 5.2), 0.4, 0.4) + polyline([(3.3, 6.85), (4.7, 7.2)], CLOTH)
    world += circle((0.45, 0.5), 0.16, METAL) + circle((7.5, 7.8), 0.05, DARK) + circle((7.4, 5.35), 0.14)
    return world + box((9.9, 3.9), 0.5, 0.35, radians(25)) + box((9.7, 4.35), 0.3, 0.3, radians(-12))


def walker(time: float, speed: float = 0.8) -> World:
    """A person who walks around WALK in steps of 0.6 m."""
    corners = [*WALK, WALK[0]]
    lengths = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(corners)]
    gone = (speed * time) % sum(lengths)
    for a, b, length in zip(corners[:-1], corners[1:], lengths, strict=True):
        if gone <= length:
            place = (a[0] + gone / length * (b[0] - a[0]), a[1] + gone / length * (b[1] - a[1]))
            return person(place, atan2(b[1] - a[1], b[0] - a[0]), 0.2 * sin(pi * speed * time / 0.6))
        gone -= length
    return person(WALK[0], 0.0, 0.0)


def laboratory_drive(stamps: np.ndarray) -> np.ndarray:
    """East between desks and partition, then round the eastern desks and back up between the two islands."""
    right = (3.1416, 0.45, -0.5)
    legs = [(4.0, 0.45, 0.01), (4.0, 0.45, -0.01), (5.3, 0.45, 0.0), right, (3.4, 0.45, 0.0), right, (4.6, 0.45, 0.0)]
    return drive((1.3, 4.4, 0.0), [*legs, right, (4.0, 0.45, 0.0)], stamps)


def laboratory_recording(frames: int = 300, laser: Laser = UTM_30LX, every: int = 5, seed: int = 1881) -> Recording:
    """The drive. Only every `every`-th sweep is kept, so that 300 frames cover 37 s and 16 m."""
    stamps = every / laser.rate * np.arange(frames)
    world = laboratory()
    poses, rng = laboratory_drive(stamps), np.random.default_rng(seed)
    return record(lambda time: world + walker(time), poses, stamps, laser, rng, "laboratory")
