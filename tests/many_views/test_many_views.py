"""The truth by many views: against the exact truth of simulated worlds, and refused where none can be made."""

import re
from dataclasses import replace

import numpy as np
import pytest

from lineseg import Recording, Scan, simulate
from lineseg.many_views import truth_by_many_views
from lineseg.many_views.checks import trust
from lineseg.many_views.profiles import profiles_of
from lineseg.many_views.twins import doubled
from lineseg.posed.returns import Returns
from lineseg.posed.walls import Walls
from lineseg.poses import PoseSource, Track, in_world
from lineseg.simulate import PAINT, PLASTER, ROUGH, UTM_30LX, box, circle, door, polyline, room
from lineseg.truth import UNKNOWN, true_lines

WORLD = room([(0, 0), (7, 0), (7, 5), (0, 5)]) + box((3.4, 4.7), 1.2, 0.5) + circle((5.4, 3.4), 0.2)
LASER = replace(UTM_30LX, beams=361, angle_increment=3 * UTM_30LX.angle_increment)
STAMPS = 0.5 * np.arange(40)


def driven(poses, world=WORLD, laser=LASER) -> Recording:
    return simulate.record(lambda stamp: world, poses, STAMPS[: len(poses)], laser, np.random.default_rng(5), "drive")


def drive() -> Recording:
    return driven(simulate.drive((1.5, 1.2, 0.0), [(8, 0.45, 0.0), (4, 0.2, 0.8), (8, 0.3, 0.0)], STAMPS))


def with_poses(recording: Recording, poses) -> Recording:
    return replace(recording, track=Track.of(np.asarray(poses, float), PoseSource("odometry")), walls=None)


def walls_in(scan: Scan) -> np.ndarray:
    assert scan.wall is not None
    return scan.wall


def differing(recording: Recording, truth: Recording) -> float:
    """Share of the beams on true lines of the exact truth for which many views say something else."""
    wrong = total = 0
    for exact, found in zip(recording, truth, strict=True):
        lines, others = true_lines(exact), true_lines(found)
        known = exact.valid & (others != UNKNOWN) & (lines >= 0)
        for line in range(lines.max() + 1):
            here = known & (lines == line)
            same = np.bincount(others[here & (others >= 0)], minlength=1).max()
            wrong, total = wrong + int(here.sum() - same), total + int(here.sum())
    return wrong / total


def test_walls_and_beams_agree_with_the_exact_truth():
    recording = drive()
    found = truth_by_many_views(recording)
    assert differing(recording, found.recording) < 0.02
    assert found.trusted
    assert found.thickness < 0.02
    assert found.explained > 0.9
    assert found.shift.max() < 0.05


@pytest.mark.parametrize(("material", "depth"), [(PAINT, 0.03), (PLASTER, 0.05)])
def test_a_door_in_a_shallow_recess_is_a_wall_of_its_own(material, depth):
    doors = {2: [door(2.2, 1.2, depth)]}
    recording = driven(drive().poses, room([(0, 0), (7, 0), (7, 5), (0, 5)], doors, material))
    found = truth_by_many_views(recording).recording
    wall, exact = (np.concatenate([walls_in(scan)[scan.valid] for scan in each]) for each in (found, recording))
    ends = recording.walls
    assert ends is not None
    leaf = int(np.flatnonzero(np.isclose(ends[:, [1, 3]], 5.0 + depth).all(axis=1))[0])
    numbers = np.bincount(wall[(exact == leaf) & (wall >= 0)])
    share = (exact[wall == numbers.argmax()] == leaf).mean()
    assert numbers.max() > 0.9 * (exact == leaf).sum()
    assert share > 0.95


def test_walls_that_the_laser_sees_from_far_are_walls_though_it_scatters_more_there():
    far = room([(0, 0), (11, 0), (11, 10), (0, 10)])
    found = truth_by_many_views(driven(drive().poses, far, replace(LASER, sigma=0.006, far=4.0, sigma_far=0.04)))
    assert found.explained > 0.9


def test_a_hedge_is_no_wall():
    rough = polyline([(1.5, 4.4), (5.5, 4.4)], ROUGH)
    hedge = truth_by_many_views(driven(drive().poses, room([(0, 0), (7, 0), (7, 5), (0, 5)]) + rough)).recording
    assert hedge.poses is not None
    poses = np.asarray(hedge.poses)
    spots = [in_world(scan.xy, pose) for scan, pose in zip(hedge, poses, strict=True)]
    there = np.concatenate(
        [
            walls_in(scan)[scan.valid & (abs(at - (3.5, 4.4)) < (1.5, 0.1)).all(axis=1)]
            for scan, at in zip(hedge, spots, strict=True)
        ]
    )
    assert (there == -1).mean() > 0.8


def test_walls_end_where_their_returns_do():
    found = truth_by_many_views(drive()).recording
    assert found.walls is not None
    assert found.poses is not None
    for k, (x1, y1, x2, y2) in enumerate(found.walls.tolist()):
        of = [in_world(scan.xy[walls_in(scan) == k], pose) for scan, pose in zip(found, found.poses, strict=True)]
        spots = np.concatenate(of)
        normal = np.array((y1 - y2, x2 - x1)) / np.hypot(x2 - x1, y2 - y1)
        assert np.abs((spots - (x1, y1)) @ normal).max() < 0.13
        assert spots.min(axis=0) == pytest.approx((min(x1, x2), min(y1, y2)), abs=0.15)
        assert spots.max(axis=0) == pytest.approx((max(x1, x2), max(y1, y2)), abs=0.15)


def test_poses_that_drift_are_corrected():
    recording = drive()
    assert recording.poses is not None
    drift = np.outer(np.arange(len(recording)) / len(recording), (0.06, -0.05, np.radians(1.0)))
    found = truth_by_many_views(with_poses(recording, recording.poses + drift))
    assert found.thickness < 0.8 * found.thickness_before
    assert differing(recording, found.recording) < 0.03


@pytest.mark.parametrize(("apart", "facing", "expected"), [(0.15, 1, True), (0.4, 1, False), (0.15, -1, False)])
def test_a_wall_that_poses_show_twice_is_doubled_where_both_are(apart, facing, expected):
    walls = Walls(
        np.array([(0.0, 1.0), (0.0, float(facing))]), np.array([0.0, facing * apart]), np.array([-4.0, -2.0]),
        np.array([4.0, 2.0]), np.full(2, 0.01),
    )  # fmt: skip
    nothing = np.empty(0)
    profiles = profiles_of(np.empty((0, 2)), nothing.astype(np.int32), nothing, nothing.astype(int), walls)
    both = (np.abs(profiles.at) < 1.85) & expected
    inner = (np.abs(profiles.at) < 1.85) | (np.abs(profiles.at) > 2.05)
    assert np.array_equal(doubled(profiles, walls, np.ones(2, bool))[inner], both[inner])
    assert not doubled(profiles, walls, np.array([True, False])).any()


def test_what_one_place_alone_saw_is_unknown():
    recording = drive()
    assert recording.poses is not None
    poses = np.array(recording.poses)
    poses[:-1:2] = np.nan
    found = truth_by_many_views(with_poses(recording, poses)).recording
    first, second = found[0].wall, found[1].wall
    assert first is not None
    assert second is not None
    assert (first[found[0].valid] == UNKNOWN).all()
    assert (second >= 0).any()


@pytest.mark.parametrize(
    ("thickness", "unknown", "shift", "trusted", "sentence"),
    [
        (0.010, 0.01, 0.01, True, "hold together. .* by 1 point .*, in one of ten by more than 4"),
        (0.025, 0.01, 0.01, False, "It is uncertain: walls are 18 mm thick or thicker. .* by 4 points .* more than 13"),
        (0.010, 0.08, 0.01, False, "4% or more of the returns are unknown. "),
        (0.010, 0.01, 0.03, False, "a pose was corrected by 20 mm or more. "),
        (0.070, 0.01, 0.01, False, "Do not trust this truth: walls are 70 mm thick"),
    ],
)
def test_it_says_how_far_rates_were_off_in_worlds_alike(thickness, unknown, shift, trusted, sentence):
    found = trust("drive", thickness, 0.9, unknown, np.full(20, shift), np.zeros(20))
    assert found[0] is trusted
    assert found[1] is (thickness < 0.05)
    assert re.search(sentence, found[2])


def test_of_a_long_recording_places_seen_briefly_keep_their_returns():
    returns = Returns.of(drive(), np.asarray(drive().poses))
    views = np.where(np.arange(40) < 36, 0, 1 + np.arange(40))
    some = returns.thinned(views, len(returns) // 4)
    kept, given = np.diff(some.offsets), np.diff(returns.offsets)
    assert len(some) <= len(returns) // 4
    assert (kept[36:] == given[36:]).all()
    assert (kept[:36] > 0).all()
    assert np.array_equal(some.xy, returns.xy[np.searchsorted(returns.beam, some.beam)])


def test_parts_together_are_all_returns(monkeypatch):
    monkeypatch.setattr("lineseg.posed.returns.PART", 1000)
    recording = drive()
    poses = np.asarray(recording.poses)
    returns = Returns.of(recording, poses)
    parts = list(returns.parts())
    assert len(parts) > 10
    placed = [part.in_world(poses[scans]) for part, _, scans in parts]
    assert np.array_equal(np.concatenate(placed), returns.in_world(poses))
    assert np.array_equal(np.concatenate([part.scan + scans.start for part, _, scans in parts]), returns.scan)


def test_work_can_be_stopped():
    def stop(done: int, total: int) -> None:
        if done == 2:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        truth_by_many_views(drive(), stop)


def standing():
    return driven(np.tile((2.0, 2.0, 0.3), (12, 1)))


def jumping():
    recording = drive()
    return with_poses(
        recording, np.asarray(recording.poses) + np.where(np.arange(40) < 17, 0, 4.0)[:, None] * (1, 0, 0)
    )


def outdoors():
    trees = simulate.World.of(circles=np.random.default_rng(2).uniform((-9, -9, 0.1), (9, 9, 0.3), (60, 3)))
    return driven(simulate.drive((-2, 0, 0.0), [(20, 0.3, 0.0)], STAMPS), trees)


def without_poses():
    return replace(drive(), track=None)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (without_poses, "drive has no poses .*--poses FILE"),
        (standing, "stands still, .* 12 poses lie within 0.00 m"),
        (jumping, "jump: by 4.* m between frames 16 and 17"),
        (outdoors, "returns lie on straight walls"),
    ],
)
def test_where_no_truth_can_be_made_it_says_why(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        truth_by_many_views(make())
