"""The worlds without a file: their truth, space to drive in, reproducible."""

import numpy as np
import pytest

from lineseg.simulate.worlds import WORLDS
from lineseg.truth import true_lines

EVERY = pytest.mark.parametrize("name", list(WORLDS))


@EVERY
def test_a_world_made_again_is_the_same_and_has_true_lines(name: str):
    recording, again = (WORLDS[name].recording(name, frames=3) for _ in range(2))
    assert np.array_equal(recording.ranges, again.ranges)
    assert np.array_equal(recording.wall, again.wall)
    assert all(true_lines(scan).max() >= 1 for scan in recording)


@EVERY
def test_the_laser_never_runs_into_anything(name: str):
    poses, walls = WORLDS[name].recording(name, frames=12).poses, WORLDS[name].world()
    for x, y, _ in poses:
        start, along = walls.walls[:, :2], walls.walls[:, 2:] - walls.walls[:, :2]
        share = ((np.array((x, y)) - start) * along).sum(axis=1) / (along**2).sum(axis=1)
        nearest = start + np.clip(share, 0, 1)[:, None] * along
        assert np.hypot(*(nearest - (x, y)).T).min() > 0.2
        assert (np.hypot(*(walls.circles[:, :2] - (x, y)).T) - walls.circles[:, 2] > 0.1).all()
