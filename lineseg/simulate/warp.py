"""Walls that are not quite straight, such as boards and plaster: they bend in waves, the same in every scan."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from ..scan import Floats
from .world import World

# Lengths of the waves, as multiples of `warp_length`.
WAVES = np.array([0.6, 1.0, 1.7, 2.6])


def warped(world: World, points: Floats, targets: NDArray[np.int64]) -> Floats:
    """(n,) [m]: how far the surface lies from its straight wall, along the normal, at points (n, 2) on the targets."""
    found = np.zeros(len(targets))
    for wall in np.unique(targets[(targets >= 0) & (targets < len(world.walls))]).tolist():
        material = world.wall_materials[wall]
        if material.warp:
            here, start = targets == wall, world.walls[wall, :2]
            along = world.walls[wall, 2:] - start
            places = (points[here] - start) @ along / np.hypot(*along)
            phases = np.random.default_rng(wall).uniform(0, 2 * pi, len(WAVES))
            waves = np.sin(2 * pi * places[:, None] / (material.warp_length * WAVES) + phases)
            found[here] = material.warp * np.sqrt(2 / len(WAVES)) * waves.sum(axis=1)
    return found
