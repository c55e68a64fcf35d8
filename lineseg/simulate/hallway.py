"""The hallway: a corridor with doors, fire cabinets and a side corridor, and a drive through it."""

from __future__ import annotations

from math import radians

import numpy as np

from ..scan import Recording
from .laser import UTM_30LX, Laser, drive, record
from .world import (
    DARK,
    GLASS,
    METAL,
    Feature,
    World,
    box,
    circle,
    desk,
    door,
    facade,
    fire_cabinet,
    opening,
    polyline,
    room,
    swivel_chair,
    window,
)

LENGTH, WIDTH = 40.0, 2.4
SIDE_WEST, SIDE_EAST, SIDE_END = 24.0, 26.0, 15.0


def hallway() -> World:
    """40 m by 2.4 m along x. In the east, one half of a glass double door is open, with nothing behind it. To the north
    are a room with an open door and a side corridor. To the south a door stands ajar."""
    south = [
        door(3.2), fire_cabinet(6.6), door(9.0), opening(14.2, 0.95, 0.12), door(16.4, depth=0.25), fire_cabinet(19.0),
        door(22.0), Feature(25.0, 1.2, 0.35), door(28.4), door(31.0), fire_cabinet(33.5), door(36.0),
    ]  # fmt: skip
    north_west = [door(4.6), opening(11.0), fire_cabinet(13.4), door(16.6, depth=0.03), door(20.4, 1.6), _pillar(22.4)]
    north_east = [_pillar(28.0), door(30.4), window(33.6, 2.2), door(37.4)]
    world = facade((0, 0), (LENGTH, 0), south)
    world += facade((LENGTH, 0), (LENGTH, WIDTH), [opening(0.7, 0.95, 0.1), Feature(1.75, 0.95, 0.05, GLASS)])
    world += facade((LENGTH, WIDTH), (SIDE_EAST, WIDTH), _mirrored(north_east, LENGTH))
    world += _side_corridor()
    world += facade((SIDE_WEST, WIDTH), (0, WIDTH), _mirrored(north_west, SIDE_WEST))
    world += facade((0, WIDTH), (0, 0), [door(1.2, 1.8, 0.1)])
    world += _open_room() + _leaf((13.725, -0.12), 0.93, radians(-38))
    return world + circle((17.6, 2.12), 0.17, METAL) + box((27.3, 0.24), 0.5, 0.36, radians(6), DARK)


def _side_corridor() -> World:
    """2 m wide, to the north, with a door on either side and a window at its end."""
    world = facade((SIDE_EAST, WIDTH), (SIDE_EAST, SIDE_END), [door(3.0), fire_cabinet(5.2), door(8.5)])
    world += facade((SIDE_EAST, SIDE_END), (SIDE_WEST, SIDE_END), [window(1.0, 1.2)])
    return world + facade((SIDE_WEST, SIDE_END), (SIDE_WEST, WIDTH), [door(4.0), door(8.2)])


def _open_room() -> World:
    """The office behind the open door at x = 11; the door is folded back against the wall."""
    y = WIDTH + 0.2
    world = room([(8.6, y), (13.4, y), (13.4, y + 4.2), (8.6, y + 4.2)], {0: [opening(2.4, 0.95, 0.0)]})
    world += box((13.15, y + 2.2), 0.42, 1.6, material=METAL) + desk((10.2, y + 3.2), heading=radians(4))
    return world + swivel_chair((10.3, y + 2.5)) + _leaf((10.525, y), 0.93, radians(105))


def _leaf(hinge: tuple[float, float], width: float, heading: float) -> World:
    return polyline([hinge, (hinge[0] + width * np.cos(heading), hinge[1] + width * np.sin(heading))])


def _pillar(at: float) -> Feature:
    return Feature(at, 0.5, -0.15)


def _mirrored(features: list[Feature], start: float) -> list[Feature]:
    """Features placed by their x, for a wall that runs west from x = `start`."""
    return [Feature(start - each.at, each.width, each.depth, each.material, each.open) for each in features]


def hallway_drive(stamps: np.ndarray) -> np.ndarray:
    """East along the corridor at about half a metre a second, swaying a little, then left into the side corridor."""
    legs = [(4.5, 0.56, 0.016), (6.0, 0.56, -0.020), (7.0, 0.56, 0.022), (6.0, 0.56, -0.018), (4.63, 0.56, -0.0035)]
    turn = [(3.37, 0.50, 0.466), (6.5, 0.55, 0.0)]
    return drive((8.1, 1.0, 0.0), legs + turn, stamps)


def hallway_recording(frames: int = 300, laser: Laser = UTM_30LX, every: int = 5, seed: int = 2018) -> Recording:
    """The drive. Only every `every`-th sweep is kept, so that 300 frames cover 37 s and 20 m."""
    stamps = every / laser.rate * np.arange(frames)
    world = hallway()
    return record(lambda _: world, hallway_drive(stamps), stamps, laser, np.random.default_rng(seed), "hallway")
