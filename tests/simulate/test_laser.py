"""Casting and scanning, compared with geometry computed by hand."""

from dataclasses import replace
from math import atan2, cos, hypot, inf, pi, radians, sin, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose

from lineseg.simulate import (
    DARK,
    IDEAL,
    LIDAR_16,
    ROUGH,
    UTM_30LX,
    Feature,
    Laser,
    Material,
    World,
    box,
    cast,
    circle,
    desk,
    door,
    drive,
    facade,
    opening,
    polyline,
    room,
    scan,
)

EXACT = Laser("exact", radians(-45), radians(1), 91, 0.1, 30.0, resolution=0)
WALL_AHEAD = polyline([(2.0, -5.0), (2.0, 5.0)], IDEAL)


def sweep(world, laser=EXACT, pose=(0.0, 0.0, 0.0), seed=0):
    return scan(world, pose, laser, np.random.default_rng(seed))


def test_a_ray_ends_at_the_nearest_wall_and_tells_its_incidence():
    world = polyline([(3.0, -5.0), (3.0, 5.0)]) + WALL_AHEAD
    hits = cast(world, (0, 0), np.radians([0.0, 60.0, 180.0]))
    assert_allclose(hits.ranges, [2.0, 4.0, inf])
    assert hits.targets.tolist() == [1, 1, -1]
    assert_allclose(hits.incidence[:2], np.radians([0.0, 60.0]), atol=1e-12)


def test_a_ray_ends_at_the_near_side_of_a_circle_and_from_inside_at_the_far_one():
    column = circle((4.0, 1.0), 1.0)
    assert_allclose(cast(column, (0, 0), np.array([atan2(1, 4)])).ranges, [sqrt(17) - 1])
    assert_allclose(cast(column, (4.0, 1.0), np.linspace(0, 6, 7)).ranges, 1.0)
    assert cast(column, (0, 0), np.array([pi])).targets.tolist() == [-1]


def test_targets_count_walls_before_circles():
    hits = cast(circle((1.0, 0.0), 0.1) + WALL_AHEAD, (0, 0), np.radians([0.0, 30.0]))
    assert hits.targets.tolist() == [1, 0]


def test_an_empty_world_returns_nothing():
    assert not sweep(World.of()).valid.any()


def test_walls_alone_and_circles_alone_can_be_cast():
    assert sweep(WALL_AHEAD).valid.all()
    assert sweep(circle((0.0, 0.0), 3.0, IDEAL)).valid.all()


def test_the_scan_turns_with_the_robot():
    turned = polyline([(-5.0, 2.0), (5.0, 2.0)], IDEAL)
    assert_allclose(sweep(turned, pose=(0, 0, pi / 2)).ranges, sweep(WALL_AHEAD).ranges, rtol=1e-6)


def test_points_without_noise_lie_on_their_wall():
    assert_allclose(sweep(WALL_AHEAD).xy[:, 0], 2.0, atol=1e-6)


@pytest.mark.parametrize(("distance", "sigma"), [(5.0, 0.010), (15.0, 0.050 / 3)])
def test_the_utm_30lx_has_a_third_of_its_stated_accuracy_as_standard_deviation(distance, sigma):
    hall = circle((0.0, 0.0), distance, IDEAL)
    errors = np.concatenate([sweep(hall, UTM_30LX, seed=seed).ranges for seed in range(20)]) - distance
    assert abs(errors.mean()) < 0.0005
    assert errors.std() == pytest.approx(sigma, rel=0.03)


@pytest.mark.parametrize("distance", [2.0, 8.0])
def test_noise_may_grow_with_the_range(distance):
    laser = replace(EXACT, sigma=0.004, sigma_far=0.004, growth=0.01)
    hall = circle((0.0, 0.0), distance, IDEAL)
    errors = np.concatenate([sweep(hall, laser, seed=seed).ranges for seed in range(40)]) - distance
    assert errors.std() == pytest.approx(hypot(0.004, 0.01 * distance), rel=0.05)


def test_noise_may_grow_with_the_angle_at_which_a_beam_meets_the_wall():
    laser = replace(EXACT, grazing=0.2, beam_width=radians(0.5))
    slanted = polyline([(3.0, -5.0), (0.0, 5.0 * sqrt(3) - 5.0)], IDEAL)
    exact = sweep(slanted).ranges.astype(float)
    errors = np.array([sweep(slanted, laser, seed=seed).ranges - exact for seed in range(300)]).std(axis=0)
    incidence = cast(slanted, (0, 0), EXACT.bearings).incidence
    assert_allclose(errors, 0.2 * exact * radians(0.5) * np.tan(incidence), rtol=0.15, atol=1e-5)


def test_a_warped_wall_deviates_from_straight_the_same_way_in_every_scan_and_is_a_wall_all_the_same():
    laser = replace(EXACT, angle_min=radians(-70), angle_increment=radians(0.1), beams=1401)
    board = polyline([(2.0, -20.0), (2.0, 20.0)], Material(warp=0.02, warp_length=0.8))
    here, there = sweep(board, laser), sweep(board, laser, pose=(0.5, 1.0, 0.3), seed=5)
    across = here.xy[here.valid, 0] - 2.0
    assert across.std() == pytest.approx(0.02, rel=0.3)
    # Neighbouring points bend together: the step between them is far smaller than the deviation.
    assert np.abs(np.diff(across[500:900])).max() < 0.005
    assert (here.wall[here.valid] == 0).all()
    turn = np.array([[cos(0.3), sin(0.3)], [-sin(0.3), cos(0.3)]])
    seen = there.xy[there.valid] @ turn + (0.5, 1.0)
    near = np.abs(seen[:, 1] - 0.5) < 0.5
    assert_allclose(seen[near, 0], np.interp(seen[near, 1], *here.xy[here.valid].T[::-1]), atol=0.003)


def test_one_plane_of_a_16_layer_lidar_is_a_circle_with_a_chip():
    scan = sweep(circle((0.0, 0.0), 3.0, IDEAL), LIDAR_16)
    assert scan.full_circle
    assert (len(scan), scan.around) == (897, 898)


def test_ranges_are_rounded_to_a_millimetre():
    ranges = sweep(WALL_AHEAD, UTM_30LX).ranges.astype(float)
    seen = ranges[np.isfinite(ranges)]
    assert_allclose(seen, np.round(seen, 3), atol=1e-6)


def test_walls_out_of_range_return_nothing():
    far = polyline([(40.0, -90.0), (40.0, 90.0)], IDEAL)
    near = polyline([(0.05, -0.04), (0.05, 0.04)], IDEAL)
    assert not sweep(far).valid.any()
    assert not sweep(near).valid[40:51].any()


def test_glass_answers_only_beams_that_meet_it_almost_at_a_right_angle():
    pane = polyline([(2.0, -5.0), (2.0, 5.0)], Material(returns=1.0, widest=radians(14.5)))
    assert np.array_equal(sweep(pane).valid, np.abs(EXACT.bearings) <= radians(14.5))


def test_a_dark_surface_swallows_some_beams():
    dark = polyline([(2.0, -2.0), (2.0, 2.0)], DARK)
    share = np.mean([sweep(dark, seed=seed).valid for seed in range(50)])
    assert share == pytest.approx(DARK.returns, abs=0.02)


def test_at_an_edge_beams_measure_something_between_the_two_surfaces():
    laser = Laser("wide", radians(-10), radians(0.25), 81, 0.1, 30.0, beam_width=radians(0.25), mixed=1.0)
    edge = polyline([(1.0, 0.0), (1.0, 1.0)], IDEAL) + polyline([(3.0, -1.0), (3.0, 1.0)], IDEAL)
    found = sweep(edge, laser)
    mixed = (found.ranges > 1.1) & (found.ranges < 2.95)
    assert mixed.any()
    assert (found.wall[mixed] == -1).all()
    assert np.abs(laser.bearings[mixed]).max() < radians(0.3)
    assert (found.wall[~mixed] >= -1).all()


def test_a_corner_and_a_grazed_wall_give_no_mixed_pixels():
    laser = Laser("wide", radians(0), radians(0.25), 180, 0.1, 30.0, beam_width=radians(0.25), mixed=1.0)
    corner = polyline([(25.0, -1.0), (25.0, 0.5), (0.5, 0.5)], IDEAL)
    assert (sweep(corner, laser).wall >= 0).all()


def test_circles_and_rough_surfaces_are_not_walls():
    world = WALL_AHEAD + circle((1.0, 0.0), 0.2) + polyline([(1.0, 0.5), (1.0, 0.9)], ROUGH)
    found = sweep(world)
    assert set(found.wall.tolist()) == {0, -1}
    assert (found.wall[found.ranges < 1.5] == -1).all()


def test_the_same_seed_gives_the_same_scan_and_another_one_does_not():
    first, again, other = (sweep(WALL_AHEAD, UTM_30LX, seed=seed).ranges for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_generator_is_used_equally_whatever_the_beams_meet():
    left = [np.random.default_rng(3), np.random.default_rng(3)]
    scan(World.of(), (0, 0, 0), UTM_30LX, left[0])
    scan(WALL_AHEAD, (0, 0, 0), UTM_30LX, left[1])
    assert left[0].random() == left[1].random()


def test_a_facade_sets_doors_back_and_leaves_openings_open():
    world = facade((0, 0), (6, 0), [door(1.5, 1.0, 0.2), opening(4.0, 1.0, 0.3)])
    down = cast(world, (1.5, 1.0), np.array([-pi / 2]))
    assert_allclose(down.ranges, [1.2])
    assert_allclose(cast(world, (3.0, 1.0), np.array([-pi / 2])).ranges, [1.0])
    assert cast(world, (4.0, 1.0), np.array([-pi / 2])).targets.tolist() == [-1]


def test_a_feature_without_room_in_its_wall_is_refused():
    with pytest.raises(ValueError, match=r"1\.5 to 2\.5 m does not fit .* 0 to 2 m is free"):
        facade((0, 0), (2, 0), [Feature(2.0, 1.0, 0.1)])


def test_a_room_is_closed_and_a_box_in_it_stands_before_its_wall():
    world = room([(0, 0), (4, 0), (4, 3), (0, 3)]) + box((3.5, 1.5), 0.4, 1.0) + desk((1.0, 2.5))
    hits = cast(world, (2.0, 1.5), np.linspace(0, 2 * pi, 400))
    assert (hits.targets >= 0).all()
    assert_allclose(hits.ranges[0], 1.3)


def test_a_world_whose_materials_do_not_match_is_refused():
    with pytest.raises(ValueError, match="a material each"):
        World(np.zeros((2, 4)), np.zeros((0, 3)), (IDEAL,), ())


def test_a_drive_goes_straight_then_round_and_stands_at_the_end():
    stamps = np.linspace(0, 20, 201)
    poses = drive((1.0, 2.0, 0.0), [(4.0, 0.5, 0.0), (pi, 0.5, 0.5)], stamps)
    assert poses[-1, 2] == pytest.approx(pi / 2, abs=0.01)
    assert_allclose(poses[-1], poses[-20])
    assert_allclose(poses[20], [1 + 0.5 * 2, 2, 0], atol=1e-9)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0).T) / 0.1
    assert steps.max() < 0.501


def test_a_desk_can_be_turned():
    ahead, turned = desk((0.0, 0.0)), desk((0.0, 0.0), heading=0.3)
    rotation = np.array([[cos(0.3), -sin(0.3)], [sin(0.3), cos(0.3)]])
    assert_allclose(turned.circles[:, :2], ahead.circles[:, :2] @ rotation.T)
