"""Small corrections of the poses that make the walls thinner: each scan is moved onto the walls."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel
from ..posed.nearest import nearest, rows_of, table_of
from ..posed.returns import Returns
from ..posed.walls import Walls

# Standard deviations of the given poses [m, rad], and bounds of their correction.
SHIFT, TURN = 0.05, np.radians(0.7)
MOST_SHIFT, MOST_TURN = 0.25, np.radians(3.0)
ITERATIONS = 6
# Of a longer recording, so many returns move the scans onto the walls, and of each scan as many or more.
MOST_RETURNS, LEAST_BEAMS = 3_000_000, 180
# So many beams of a scan count as independent: those on one wall err alike where it bends.
INDEPENDENT = 40.0

Floats = NDArray[np.float64]


def refined(returns: Returns, given: Floats, poses: Floats, walls: Walls, reach: float, sigma: float) -> Floats:
    """(m, 3) the poses after moving each scan onto the walls, within the bounds around the given ones.

    reach: how far from a wall its points lie at most [m]; sigma: how far they scatter [m].
    """
    moved = poses.copy()
    if len(walls):
        most = len(returns) / max(len(poses), 1) / LEAST_BEAMS
        step = int(np.clip(len(returns) / MOST_RETURNS, 1, max(most, 1)))
        move_scans(
            returns.xy, returns.offsets, step, given, moved, rows_of(walls), *table_of(walls), reach, sigma,
            np.zeros((3, 4)),
        )  # fmt: skip
    return moved


@entry_kernel
def move_scans(xy, offsets, step, given, poses, rows, keys, starts, walls, origin, reach, sigma, system):
    """Gauss-Newton for each scan on the distances of every step-th return to the walls, with Tukey's weights."""
    for k in range(len(poses)):
        pose = poses[k]
        for _ in range(ITERATIONS):
            cos, sin = np.cos(pose[2]), np.sin(pose[2])
            system[:] = 0.0
            total = 0.0
            for i in range(offsets[k], offsets[k + 1], step):
                dx, dy = cos * xy[i, 0] - sin * xy[i, 1], sin * xy[i, 0] + cos * xy[i, 1]
                wall, height = nearest(
                    pose[0] + dx, pose[1] + dy, pose[0], pose[1], rows, keys, starts, walls, origin, reach
                )
                if wall < 0:
                    continue
                share = height / reach
                weight = (1.0 - share * share) * (1.0 - share * share)
                nx, ny = rows[wall, 0], rows[wall, 1]
                turn = ny * dx - nx * dy
                total += weight
                system[0, 0] += weight * nx * nx
                system[0, 1] += weight * nx * ny
                system[0, 2] += weight * nx * turn
                system[1, 1] += weight * ny * ny
                system[1, 2] += weight * ny * turn
                system[2, 2] += weight * turn * turn
                system[0, 3] -= weight * nx * height
                system[1, 3] -= weight * ny * height
                system[2, 3] -= weight * turn * height
            if total < 10.0:
                break
            scale = min(1.0, INDEPENDENT / total) / (sigma * sigma)
            for a in range(3):
                spread = TURN if a == 2 else SHIFT
                for b in range(a, 4):
                    system[a, b] *= scale
                system[a, a] += 1.0 / (spread * spread)
                system[a, 3] += (given[k, a] - pose[a]) / (spread * spread)
            # Cholesky by hand: three unknowns.
            l11 = np.sqrt(system[0, 0])
            l21, l31 = system[0, 1] / l11, system[0, 2] / l11
            l22 = np.sqrt(system[1, 1] - l21 * l21)
            l32 = (system[1, 2] - l21 * l31) / l22
            l33 = np.sqrt(system[2, 2] - l31 * l31 - l32 * l32)
            z1 = system[0, 3] / l11
            z2 = (system[1, 3] - l21 * z1) / l22
            z3 = (system[2, 3] - l31 * z1 - l32 * z2) / l33
            turn = z3 / l33
            y = (z2 - l32 * turn) / l22
            x = (z1 - l21 * y - l31 * turn) / l11
            pose[0] = min(max(pose[0] + x, given[k, 0] - MOST_SHIFT), given[k, 0] + MOST_SHIFT)
            pose[1] = min(max(pose[1] + y, given[k, 1] - MOST_SHIFT), given[k, 1] + MOST_SHIFT)
            pose[2] = min(max(pose[2] + turn, given[k, 2] - MOST_TURN), given[k, 2] + MOST_TURN)
            if abs(x) + abs(y) < 1e-4 and abs(turn) < 1e-5:
                break
