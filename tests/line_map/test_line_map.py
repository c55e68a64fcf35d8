"""The line map: against the walls of simulated worlds, against slow versions of its steps, and where it is doubted."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lineseg import Params, Recording, open_recording, simulate, survey
from lineseg.line_map import LineMap, line_map
from lineseg.line_map.fusing import fused, over
from lineseg.line_map.joining import ALIKE, FARTHEST, GAP, GATE, joined_lines
from lineseg.line_map.posed import PosedLines
from lineseg.poses import PoseSource, Track
from lineseg.simulate import UTM_30LX, box, polyline, room

# A room with a thin wall in it, seen from both sides.
THIN = polyline([(3.5, 0), (3.5, 3.0), (3.6, 3.0), (3.6, 0)])
WORLD = room([(0, 0), (7, 0), (7, 5), (0, 5)]) + THIN
LASER = replace(UTM_30LX, beams=361, angle_increment=3 * UTM_30LX.angle_increment)
STAMPS = 0.5 * np.arange(60)
# Past the end of the thin wall, and down on its other side.
CORNERS = np.array([(1.2, 1.0), (1.5, 4.0), (5.5, 4.0), (5.8, 1.0)])


def driven(corners=CORNERS, world=WORLD) -> Recording:
    at = np.linspace(0, len(corners) - 1, len(STAMPS))
    x, y = (np.interp(at, np.arange(len(corners)), column) for column in corners.T)
    poses = np.column_stack((x, y, np.linspace(math.pi / 2, -math.pi / 2, len(STAMPS))))
    return simulate.record(lambda stamp: world, poses, STAMPS, LASER, np.random.default_rng(5), "drive")


def with_poses(recording: Recording, poses) -> Recording:
    return replace(recording, track=Track.of(np.asarray(poses, float), PoseSource("odometry")))


def shaken(recording: Recording, shift: float, turn: float) -> Recording:
    assert recording.poses is not None
    noise = np.random.default_rng(3).normal(0, (shift, shift, turn), (len(recording), 3))
    return with_poses(recording, recording.poses + noise)


def heights_over(found: LineMap, walls) -> np.ndarray:
    """(lines,) the signed distance of the middle of each line from the nearest wall."""
    middle = (found.ends[:, :2] + found.ends[:, 2:]) / 2
    start, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    length = np.hypot(*along.T)
    along = along / length[:, None]
    away = middle[:, None] - start
    at = (away * along).sum(axis=2)
    height = away[..., 0] * -along[:, 1] + away[..., 1] * along[:, 0]
    height = np.where((at > -0.05) & (at < length + 0.05), height, np.inf)
    return height[np.arange(len(middle)), np.abs(height).argmin(axis=1)]


def test_every_wall_of_a_room_is_one_line_where_it_is():
    recording = driven()
    found = line_map(recording)
    long = found.ends[found.lengths > 0.5]
    assert len(long) == 4 + 2  # the thin wall has two sides
    assert np.abs(heights_over(found, recording.walls)).max() < 0.01
    assert found.coverage > 0.95
    assert found.doubt == ""
    assert found.pose_noise.shift == 0.005


def test_the_two_sides_of_a_thin_wall_face_away_from_each_other():
    found = line_map(driven())
    upright = (np.abs(found.normals[:, 0]) > 0.99) & (np.abs(found.ends[:, [0, 2]].mean(axis=1) - 3.55) < 0.1)
    sides = found.ends[upright & (found.lengths > 1)]
    assert sorted(np.round(sides[:, 0], 1)) == [3.5, 3.6]
    assert sorted(np.round(found.normals[upright & (found.lengths > 1), 0])) == [-1, 1]


def test_the_scatter_of_poses_is_found_and_walls_stay_whole():
    recording = shaken(driven(), 0.03, math.radians(0.4))
    found = line_map(recording)
    assert 0.02 < found.pose_noise.shift < 0.04
    assert (found.lengths > 0.5).sum() == 6


def test_lines_lie_from_the_walls_as_far_as_their_covariance_says():
    recording, ratios = driven(), []
    lines = survey(recording)
    for seed in range(8):
        noise = np.random.default_rng(seed).normal(0, (0.03, 0.03, 0.005), (len(recording), 3))
        moved = line_map(with_poses(recording, np.asarray(recording.poses) + noise), found=lines)
        long = moved.lengths > 1.0
        ratios.append((heights_over(moved, recording.walls) / moved.sigma)[long])
    rms = float(np.sqrt(np.mean(np.concatenate(ratios) ** 2)))
    assert 0.5 < rms < 1.6


def test_a_laser_that_hangs_upside_down_gives_the_same_map():
    recording = driven()
    assert recording.poses is not None
    hanging = PoseSource("odometry", upside_down=True)
    turned = replace(
        recording,
        angle_min=-recording.angle_min,
        angle_increment=-recording.angle_increment,
        track=Track.of(recording.poses, hanging),
    )
    one, other = line_map(recording), line_map(turned)
    assert np.allclose(one.coverage, other.coverage, atol=0.01)
    assert abs(one.lengths.sum() - other.lengths.sum()) < 0.2
    assert np.allclose(np.sort(one.sigma[one.lengths > 1]), np.sort(other.sigma[other.lengths > 1]), rtol=0.1)


def posed(rng, n) -> PosedLines:
    """Lines of frames near a few walls."""
    walls = rng.integers(0, 3, n)
    angle = walls * 0.9 + rng.normal(0, 0.02, n)
    normal = np.column_stack((np.cos(angle), np.sin(angle)))
    along = np.column_stack((-normal[:, 1], normal[:, 0]))
    middle = normal * (2 + walls + rng.normal(0, 0.06, n))[:, None] + along * rng.uniform(-3, 3, n)[:, None]
    root = rng.normal(0, 0.03, (n, 2, 2))
    covariance = root @ root.transpose(0, 2, 1) + np.diag((1e-4, 1e-5))
    weight = rng.choice((0.25, 0.5, 1.0), n)
    return PosedLines(middle, normal, rng.uniform(0.2, 1.5, n), covariance, np.zeros(n), weight)


def naive_join(lines: PosedLines, covariance) -> np.ndarray:
    """`joined_lines`, by comparing each line with every map line, in matrices."""
    owner, made = np.full(len(lines), -1), []
    for i in np.argsort(-lines.half, kind="stable"):
        best, found = GATE, -1
        for number, (first, information, vector, ends) in enumerate(made):
            design, measured, along, cos = seen_over(lines, i, first)
            if cos < ALIKE or along - lines.half[i] > ends[1] + GAP or along + lines.half[i] < ends[0] - GAP:
                continue
            apart = measured - design @ np.linalg.solve(information, vector)
            # The height counts at the middle of the line.
            if abs(apart[0]) > FARTHEST:
                continue
            spread = design @ np.linalg.inv(information) @ design.T + covariance[i]
            distance = apart @ np.linalg.solve(spread, apart)
            if distance < best:
                best, found = distance, number
        if found < 0:
            found = len(made)
            made.append((i, np.zeros((2, 2)), np.zeros(2), (np.inf, -np.inf)))
        first, information, vector, ends = made[found]
        design, measured, along, _ = seen_over(lines, i, first)
        part = design.T @ np.linalg.inv(covariance[i])
        ends = min(ends[0], along - lines.half[i]), max(ends[1], along + lines.half[i])
        made[found] = first, information + part @ design, vector + part @ measured, ends
        owner[i] = found
    return owner


def seen_over(lines: PosedLines, i: int, first: int):
    away = lines.middle[i] - lines.middle[first]
    normal = lines.normal[first]
    along = np.array((-normal[1], normal[0]))
    cos = float(normal @ lines.normal[i])
    slope = float(-along @ lines.normal[i]) / cos
    at = float(along @ away)
    return np.array(((1.0, at), (0.0, 1.0))), np.array((normal @ away, slope)), at, cos


@given(seed=st.integers(0, 10_000), n=st.integers(1, 40))
def test_lines_join_as_in_the_slow_version(seed, n):
    lines = posed(np.random.default_rng(seed), n)
    owner = joined_lines(lines.middle, lines.normal, lines.half, lines.covariance, lambda share: None)
    assert np.array_equal(owner, naive_join(lines, lines.covariance))


@given(seed=st.integers(0, 10_000), n=st.integers(1, 30))
def test_fused_lines_are_those_of_weighted_least_squares(seed, n):
    lines = posed(np.random.default_rng(seed), n)
    owner = np.zeros(n, np.int64)
    near = replace(lines, normal=np.tile(lines.normal[:1], (n, 1)))
    made = fused(near, owner, lines.covariance)
    along, height, slope = over(near, owner, made.origin, made.normal)
    # Whitened rows of the height and the slope of each line.
    root = np.linalg.cholesky(np.linalg.inv(lines.covariance) * lines.weight[:, None, None]).transpose(0, 2, 1)
    rows = np.array([each @ ((1, u), (0, 1)) for each, u in zip(root, along, strict=True)]).reshape(-1, 2)
    goal = (root @ np.stack((height, slope), axis=1)[:, :, None]).reshape(-1)
    assert np.allclose(made.line[0], np.linalg.lstsq(rows, goal, rcond=None)[0], atol=1e-8)
    unscaled = made.covariance[0] / max(made.spread[0], 1.0) ** 2
    assert np.allclose(unscaled, np.linalg.inv(rows.T @ rows), rtol=1e-6)


def test_what_too_few_scans_saw_is_no_line():
    recording = driven()
    once = simulate.record(
        lambda stamp: WORLD + box((1.5, 3.5), 0.8, 0.8) if stamp < 0.6 else WORLD,
        np.asarray(recording.poses), STAMPS, LASER, np.random.default_rng(5), "drive",
    )  # fmt: skip
    assert (line_map(once, least=1).lengths > 0.5).sum() > (line_map(once, least=3).lengths > 0.5).sum() == 6


def test_work_can_be_stopped():
    def stop(done: int, total: int) -> None:
        if done > 50:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        line_map(driven(), progress=stop)


def standing():
    return driven(np.tile((2.0, 2.0), (2, 1)))


def jumping():
    recording = driven()
    assert recording.poses is not None
    return with_poses(recording, recording.poses + np.where(np.arange(60) < 17, 0, 4.0)[:, None] * (1, 0, 0))


def outdoors():
    trees = simulate.World.of(circles=np.random.default_rng(2).uniform((-9, -9, 0.1), (9, 9, 0.3), (60, 3)))
    return driven(np.array([(-2, 0), (4, 0)]), trees)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (standing, "The robot stands still"),
        (jumping, "jump by 4.* m between frames 16 and 17: lines of before"),
        (outdoors, "Only .* of the returns lie on lines"),
    ],
)
def test_a_map_that_should_not_be_trusted_says_why(make, sentence):
    assert re.search(sentence, line_map(make()).text)


def test_without_poses_there_is_no_map():
    with pytest.raises(ValueError, match=r"drive has no poses .*--poses FILE"):
        line_map(replace(driven(), track=None))


def test_a_recording_without_lines_gives_an_empty_map():
    found = line_map(driven(), Params(min_points=360, min_length=50))
    assert (len(found), found.coverage, found.lengths.sum()) == (0, 0.0, 0.0)
    assert "Only 0%" in found.text


@pytest.mark.parametrize(
    ("name", "coverage", "longest"),
    [("carmen_belgioioso/carmen_belgioioso.log.gz", 0.65, 12), ("carmen_seattle/carmen_seattle.log", 0.8, 20)],
)
def test_maps_of_real_buildings_hold_most_of_what_was_seen(data_dir, name, coverage, longest):
    found = line_map(open_recording(data_dir / name))
    assert found.coverage > coverage
    assert found.lengths[0] > longest
    assert found.doubt == ""
