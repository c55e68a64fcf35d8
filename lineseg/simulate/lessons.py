"""Nine one-frame recordings. Each shows one thing about region growing with the thresholds of the paper."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np

from ..scan import Recording
from .laser import Laser, record
from .world import IDEAL, ROUGH, World, circle, polyline

POSE = (0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Lesson:
    """One scan of `world` from the origin, looking along x; `seed` selects noise that makes the point visible."""

    name: str
    title: str
    world: World
    laser: Laser
    seed: int = 0

    def recording(self) -> Recording:
        poses, rng = np.array([POSE]), np.random.default_rng(self.seed)
        return record(lambda _: self.world, poses, np.zeros(1), self.laser, rng, self.name)


def _fan(first_deg: float, last_deg: float, step_deg: float = 1.0, sigma: float = 0.0) -> Laser:
    """Few beams, so that every decision can be followed; `sigma` at every range."""
    beams = round((last_deg - first_deg) / step_deg) + 1
    return Laser("lesson", radians(first_deg), radians(step_deg), beams, 0.1, 30.0, sigma=sigma, sigma_far=sigma)


def _walls(*lines: list[tuple[float, float]]) -> World:
    world = World.of()
    for line in lines:
        world += polyline(line, IDEAL)
    return world


def _shallow_corner(angle: float) -> World:
    return _walls([(2.6, 2.0), (0.0, 2.0), (-2.6 * cos(angle), 2.0 - 2.6 * sin(angle))])


LESSONS = (
    Lesson(
        "1_perfect_corner",
        "A corner without noise: two lines overlap and are cut where they meet",
        _walls([(2.4, -3.0), (2.4, 1.2), (0.3, 1.2)]),
        _fan(-60, 60),
    ),
    Lesson(
        "2_grazing_wall",
        "A door leaf 45 mm back, seen at a grazing angle: ε alone joins it to the wall before it, δ does not",
        _walls([(20.0, -1.0), (20.0, 1.0), (12.0, 1.0)], [(12.0, 1.045), (8.6, 1.045)], [(8.6, 1.0), (1.5, 1.0)]),
        _fan(0, 30, 0.25, sigma=0.002),
    ),
    Lesson(
        "3_collinear_overlap",
        "One wall, two seeds: their lines overlap and become one (Fig. 5)",
        _walls([(2.2, 1.8), (-2.2, 1.8)]),
        _fan(30, 150, sigma=0.010),
        seed=2204,
    ),
    Lesson(
        "4_lost_end",
        "A niche whose back Split-and-Merge breaks at its farthest point, losing the end (Fig. 2)",
        _walls([(3.6, 2.0), (1.5, 2.0), (1.5, 2.5), (-1.5, 2.5), (-1.5, 2.0), (-3.6, 2.0)]),
        _fan(20, 160, sigma=0.010),
        seed=266,
    ),
    Lesson(
        "5_shallow_corner",
        "Two walls that differ by 4 degrees: taken for one, until the merge angle is below that",
        _shallow_corner(radians(4)),
        _fan(35, 145, sigma=0.004),
    ),
    Lesson(
        "6_curved_wall",
        "A straight wall and a round one: the curve is cut into chords that nobody built",
        _walls([(2.4, -1.8), (2.4, 1.8)]) + circle((0.0, 0.0), 3.0, IDEAL),
        _fan(-36, 100, sigma=0.004),
    ),
    Lesson(
        "7_doorway",
        "A doorway with nothing behind it: the wall on either side is a line of its own",
        _walls([(3.0, 2.0), (0.5, 2.0)], [(-0.45, 2.0), (-3.0, 2.0)]),
        _fan(30, 150, sigma=0.006),
    ),
    Lesson(
        "8_noise_burst",
        "A wall with a rough patch: growth stops at it, and starts anew behind it",
        _walls([(3.0, 2.0), (0.4, 2.0)], [(-0.2, 2.0), (-3.0, 2.0)]) + polyline([(0.4, 2.0), (-0.2, 2.0)], ROUGH),
        _fan(30, 150, sigma=0.006),
    ),
    Lesson(
        "9_wide_corner",
        "Two walls that differ by 15 degrees: their lines share points and are cut between them",
        _shallow_corner(radians(15)),
        _fan(35, 145, sigma=0.004),
    ),
)
