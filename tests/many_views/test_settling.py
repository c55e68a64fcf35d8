"""Walls that compete for the same returns: the stronger one wins, and what only the noise made is gone."""

from dataclasses import replace

import numpy as np
import pytest

from lineseg.many_views import truth_by_many_views
from lineseg.many_views.cells import Cells
from lineseg.many_views.profiles import Profiles, is_straight
from lineseg.many_views.settling import settled, weighted_medians
from lineseg.many_views.steps import FINE, steps_in
from lineseg.many_views.twins import outdone, without_outdone
from lineseg.posed.walls import Walls
from lineseg.simulate import UTM_30LX, door, drive, opening, record, room


def walls_at(*rows) -> Walls:
    """Walls that face along y: height [m] at the middle and slope, first and last x."""
    table = []
    for height, slope, low, high in rows:
        normal = np.array((slope, -1.0)) / np.hypot(1, slope)
        along = np.array((-normal[1], normal[0]))
        ends = [np.array((x, height + slope * (x - (low + high) / 2))) @ along for x in (low, high)]
        table.append((*normal, normal @ ((low + high) / 2, height), *ends, 0.01))
    return Walls.of(np.array(table))


def cells_at(xy, strength) -> Cells:
    n = len(xy)
    facing = np.tile((0.0, -1.0), (n, 1))
    return Cells(xy, facing, np.full(n, 8.0), strength, facing, *np.zeros((2, n)), np.arange(n), np.zeros(2))


def squares(low, high, height, slope=0.0):
    x = np.arange(low, high, 0.04)
    return np.column_stack((x, height + slope * (x - (low + high) / 2)))


def test_a_wall_takes_its_outliers_and_what_grew_aslant_but_not_a_recess():
    strong, shadow, recess = squares(0, 4, 0.0), squares(1, 3, 0.05), squares(4, 5, 0.06)
    aslant = squares(2.6, 4.6, 0.0, 0.03)
    xy = np.concatenate((strong, shadow, recess, aslant))
    sizes = [len(strong), len(shadow), len(recess), len(aslant)]
    owner = np.repeat(np.arange(4), sizes).astype(np.int32)
    strength = np.repeat((20.0, 2.0, 10.0, 5.0), sizes)
    given = walls_at((0, 0, 0, 4), (0.05, 0, 1, 3), (0.06, 0, 4, 5), (0, 0.03, 2.6, 4.6))
    walls, found = settled(cells_at(xy, strength), given, owner)
    assert (found[: sizes[0] + sizes[1]] == 0).all()
    assert (found[sizes[0] + sizes[1] : -sizes[3]] == 1).all()
    assert (found[-sizes[3] :][aslant[:, 0] < 3.9] == 0).all()
    assert len(walls) == 2 or walls.low[2:].min() > 3.9
    assert walls.normal[0] @ (0, -1) == pytest.approx(1, abs=1e-3)


def test_a_weighted_median_is_that_of_repeated_values():
    rng = np.random.default_rng(3)
    group, values, weights = rng.integers(0, 5, 200), rng.normal(size=200), rng.integers(1, 9, 200)
    found = weighted_medians(group, values, weights.astype(float), 6)
    for one in range(5):
        repeated = np.sort(np.repeat(values[group == one], weights[group == one]))
        assert repeated[(len(repeated) - 1) // 2] <= found[one] <= repeated[len(repeated) // 2]
    assert np.isnan(found[5])


def profiles_with(walls: Walls, points) -> Profiles:
    counts = [len(each) for each in points]
    starts = np.concatenate(([0], np.cumsum(counts)))
    at = np.concatenate([low + 0.2 * (np.arange(k) + 0.5) for low, k in zip(walls.low, counts, strict=True)])
    points = np.concatenate(points)
    return Profiles(starts, at, 0.0 * at, 0.0 * at + 0.01, points, points)


def test_a_surface_with_far_fewer_returns_close_to_another_is_outdone_where_both_are():
    walls = walls_at((0.0, 0, 0, 2), (0.1, 0, 1, 3))
    profiles = profiles_with(walls, [np.full(10, 100), np.full(10, 10)])
    assert outdone(profiles, walls).tolist() == 10 * [False] + 5 * [True] + 5 * [False]
    kept, wall_of = without_outdone(walls, np.array([7, 8]), profiles)
    assert wall_of.tolist() == [7, 8]
    assert kept.low == pytest.approx([0, 2])
    assert kept.high == pytest.approx([2, 3])
    alike = profiles_with(walls, [np.full(10, 30), np.full(10, 10)])
    assert not outdone(alike, walls).any()


def waves(length: int) -> np.ndarray:
    return 0.02 * np.sin(np.arange(length) * FINE * 2 * np.pi / 1.6)


def test_a_recess_is_found_in_a_wall_that_bends_but_its_bends_are_no_steps():
    height, wall = waves(240), np.zeros(240, np.int64)
    assert not steps_in(height, wall).any()
    height[100:120] += 0.06
    found = np.flatnonzero(steps_in(height, wall))
    assert len(found) == 2
    assert abs(found - (100, 120)).max() <= 2


def test_a_wall_that_bends_as_others_do_is_straight_and_one_that_bends_more_is_not():
    walls = walls_at((0.0, 0, 0, 1.6))
    at = walls.low[0] + FINE * (np.arange(32) + 0.5)
    bulge = 0.05 * (1 - ((at - at.mean()) / 0.8) ** 2)
    many = np.full(32, 30)
    fine = Profiles(np.array([0, 32]), at, bulge, 0 * at, many, many)
    assert is_straight(fine, walls, 0.02).all()
    assert not is_straight(fine, walls, 0.005).any()


def test_walls_and_recessed_doors_that_a_noisy_laser_sees_are_known():
    stamps = 0.5 * np.arange(40)
    poses = drive((1.5, 1.2, 0.0), [(8, 0.45, 0.0), (4, 0.2, 0.8), (8, 0.3, 0.0)], stamps)
    laser = replace(
        UTM_30LX,
        beams=361,
        angle_increment=3 * UTM_30LX.angle_increment,
        sigma=0.03,
        far=4.0,
        sigma_far=0.07,
        mixed=0.8,
    )
    doors = {wall: [door(2.0, 0.95, 0.2), opening(3.6, 1.0)] for wall in range(4)}
    world = room([(0, 0), (9, 0), (9, 6), (0, 6)], doors)
    found = truth_by_many_views(record(lambda _: world, poses, stamps, laser, np.random.default_rng(5), "noisy"))
    assert found.explained > 0.75
    assert found.unknown < 0.1
