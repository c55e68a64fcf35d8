"""The committed samples: they can be reproduced, their truth is right, and every format opens."""

from pathlib import Path

import numpy as np
import pytest

from lineseg import extract
from lineseg.readers import open_recording
from lineseg.simulate import UTM_30LX
from lineseg.simulate.laboratory import WALK, walker
from lineseg.simulate.samples import write_samples

SAMPLES = Path(__file__).parents[2] / "sample_scans"
LONG = ("hallway", "laboratory")
# The texts of the lessons, and about them, are written by hand.
FILES = [path for path in SAMPLES.rglob("*") if path.is_file() and path.suffix not in (".json", ".md")]
NAMES = sorted(str(path.relative_to(SAMPLES)) for path in FILES)


@pytest.fixture(scope="module")
def again(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("samples")
    write_samples(folder)
    return folder


@pytest.fixture(scope="module", params=LONG)
def recording(request):
    return open_recording(SAMPLES / f"{request.param}.npz")


def test_the_samples_are_these_files_and_under_5_megabytes(again):
    assert sorted(str(path.relative_to(again)) for path in again.rglob("*") if path.is_file()) == NAMES
    assert sum((SAMPLES / name).stat().st_size for name in NAMES) < 5_000_000


@pytest.mark.parametrize("name", [name for name in NAMES if name.endswith(".npz")])
def test_samples_made_again_have_the_same_arrays(again, name):
    with np.load(SAMPLES / name) as committed, np.load(again / name) as made:
        assert sorted(committed) == sorted(made)
        for key in committed:
            assert committed[key].dtype == made[key].dtype
            assert np.array_equal(committed[key], made[key]), key


@pytest.mark.parametrize("name", [name for name in NAMES if not name.endswith(".npz")])
def test_other_formats_made_again_read_the_same(again, name):
    committed, made = open_recording(SAMPLES / name), open_recording(again / name)
    assert np.array_equal(committed.ranges, made.ranges)
    assert np.array_equal(committed.stamps, made.stamps)


@pytest.mark.parametrize(
    ("name", "format", "scans", "beams"),
    [("hallway.log", "CARMEN log", 30, 361), ("hallway.mcap", "MCAP", 40, 360), ("hallway.csv", "text", 10, 1081)],
)
def test_every_format_opens_with_its_scans_and_beams(name, format, scans, beams):
    recording = open_recording(SAMPLES / name)
    assert (recording.format, len(recording), recording.beams) == (format, scans, (beams, beams))
    assert all(0.85 < scan.valid.mean() <= 1 for scan in recording)
    assert all(len(extract(scan).segments) >= 3 for scan in recording)


def test_the_rplidar_sees_all_round():
    assert open_recording(SAMPLES / "hallway.mcap")[0].full_circle


def test_the_csv_says_its_angles_itself():
    scan = open_recording(SAMPLES / "hallway.csv")[0]
    assert (scan.bearings[0], scan.bearings[-1]) == pytest.approx(tuple(np.radians([-135, 135])))


def test_the_long_recordings_have_the_laser_of_the_paper(recording):
    assert (len(recording), recording.beams) == (300, (1081, 1081))
    assert recording[0].bearings == pytest.approx(UTM_30LX.bearings)
    assert (recording.range_min[0], recording.range_max[0]) == (0.1, 30.0)
    assert np.diff(recording.stamps) == pytest.approx(5 / 40)


def test_the_robot_moves_as_a_robot_does(recording):
    steps = np.diff(recording.poses, axis=0) / np.diff(recording.stamps)[:, None]
    assert np.hypot(steps[:, 0], steps[:, 1]).max() < 0.6
    assert np.abs(steps[:, 2]).max() < 0.6
    assert np.hypot(*np.ptp(recording.poses[:, :2], axis=0)) > 5


def test_the_robot_keeps_clear_of_everything(recording):
    assert recording.ranges.min() > 0.3


def test_a_beam_labelled_with_a_wall_lies_on_it_within_the_noise(recording):
    for pose, scan in zip(recording.poses, recording, strict=True):
        beams = np.flatnonzero(scan.wall >= 0)
        angles = pose[2] + scan.bearings[beams]
        ranges = scan.ranges[beams].astype(float)
        xy = pose[:2] + ranges[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
        sigma = np.where(ranges < UTM_30LX.far + 0.1, UTM_30LX.sigma, UTM_30LX.sigma_far)
        sigma[np.abs(ranges - UTM_30LX.far) < 0.1] = UTM_30LX.sigma_far
        assert (_distance_to_walls(xy, recording.walls[scan.wall[beams]]) < 5.5 * sigma + 0.001).all()


def _distance_to_walls(xy, walls):
    """Distance from each point to its own wall, a line segment."""
    start, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    share = ((xy - start) * along).sum(axis=1) / (along**2).sum(axis=1)
    return np.hypot(*(xy - start - np.clip(share, 0, 1)[:, None] * along).T)


def test_beams_without_a_return_have_no_wall(recording):
    assert (recording.wall[~np.isfinite(recording.ranges)] == -1).all()


def test_some_beams_return_nothing_and_some_hit_no_wall(recording):
    lost = [1 - scan.valid.mean() for scan in recording]
    assert 0.005 < np.mean(lost) < 0.2
    assert 0.01 < np.mean(recording.wall[np.isfinite(recording.ranges)] == -1) < 0.25


def test_walls_are_found_and_not_all_of_them(recording):
    covered = []
    for frame in range(0, len(recording), 20):
        scan = recording[frame]
        covered.append(np.mean(extract(scan).labels[scan.wall >= 0] >= 0))
    assert 0.4 < np.mean(covered) < 0.95


def test_someone_walks_through_the_laboratory():
    speeds = [np.hypot(*(walker(t + 0.5).circles - walker(t).circles).mean(axis=0)[:2]) / 0.5 for t in range(5)]
    assert np.median(speeds) == pytest.approx(0.8, abs=0.05)
    xs, ys = zip(*WALK, strict=True)
    for t in range(60):
        for x, y, _ in walker(float(t)).circles:
            assert min(xs) - 0.3 < x < max(xs) + 0.3
            assert min(ys) - 0.3 < y < max(ys) + 0.3


def test_the_samples_have_titles_and_no_pickles():
    for name in NAMES:
        if name.endswith(".npz"):
            with np.load(SAMPLES / name, allow_pickle=False) as arrays:
                assert 20 < len(str(arrays["title"])) < 120
