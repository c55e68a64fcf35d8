"""Worlds, a laser with its noise, and exact truth; `python -m lineseg.simulate` writes the samples.

world = room([(0, 0), (6, 0), (6, 4), (0, 4)]) + desk((2, 3)) + chair((2, 2))
scan = simulate.scan(world, (3, 1, 0.5), UTM_30LX, np.random.default_rng(1))
"""

from .laser import LIDAR_16, LMS_200, RPLIDAR_A1, RPLIDAR_A2, TIM_561, UTM_30LX, Hits, Laser, cast, drive, record, scan
from .world import (
    BOARD,
    CLOTH,
    DARK,
    GLASS,
    IDEAL,
    METAL,
    PAINT,
    PLASTER,
    ROUGH,
    Feature,
    Material,
    World,
    box,
    chair,
    circle,
    desk,
    door,
    facade,
    fire_cabinet,
    opening,
    person,
    polyline,
    room,
    swivel_chair,
    window,
)

__all__ = [
    "BOARD", "CLOTH", "DARK", "GLASS", "IDEAL", "LIDAR_16", "LMS_200", "METAL", "PAINT", "PLASTER", "ROUGH",
    "RPLIDAR_A1", "RPLIDAR_A2", "TIM_561", "UTM_30LX",
    "Feature", "Hits", "Laser", "Material", "World",
    "box", "cast", "chair", "circle", "desk", "door", "drive", "facade", "fire_cabinet", "opening", "person",
    "polyline", "record", "room", "scan", "swivel_chair", "window",
]  # fmt: skip
