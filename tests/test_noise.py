"""The noise of a laser is estimated from its scans, in any room."""

from dataclasses import replace

import numpy as np
import pytest

from lineseg.noise import noise
from lineseg.proposal import propose
from lineseg.scan import Recording, Scan
from lineseg.simulate.laser import UTM_30LX, drive, record
from lineseg.simulate.world import World, box, chair, circle, room
from lineseg.simulate.worlds import WORLDS

FRAMES = 24


def furnished_room() -> World:
    world = room([(0, 0), (8, 0), (8, 6), (0, 6)])
    world += box((1.0, 5.2), 1.2, 0.6) + box((6.8, 1.0), 0.8, 1.4, 0.3) + circle((4.5, 5.0), 0.2)
    return world + chair((5.0, 4.2), 0.4) + chair((2.2, 1.2), 1.9)


def drive_with(world=None, frames=FRAMES, **laser):
    stamps = np.linspace(0, 12, frames)
    poses = drive((2.0, 2.5, 0.1), [(12.0, 0.3, 0.1)], stamps)
    device = replace(UTM_30LX, **{"sigma_far": laser.get("sigma", 0.01), "resolution": 0.0, **laser})
    world = world or furnished_room()
    return record(lambda _: world, poses, stamps, device, np.random.default_rng(14), "room")


def all_round(step_deg, **laser):
    beams = round(360 / step_deg)
    return drive_with(angle_min=-np.pi, angle_increment=np.deg2rad(step_deg), beams=beams, **laser)


@pytest.mark.parametrize("sigma", [0.003, 0.01, 0.03, 0.08])
@pytest.mark.parametrize("step_deg", [0.25, 0.5, 1.0])
def test_the_noise_of_a_furnished_room_is_found(sigma, step_deg):
    assert noise(all_round(step_deg, sigma=sigma)).at(2.5) == pytest.approx(sigma, rel=0.15)


def test_centimetre_steps_add_their_own_scatter():
    sigma = np.hypot(0.005, 0.01 / np.sqrt(12))
    assert noise(all_round(0.5, sigma=0.005, resolution=0.01)).at(2.5) == pytest.approx(sigma, rel=0.15)


def test_noise_that_grows_with_the_range_is_told_apart_from_noise_that_does_not():
    hall = room([(0, 0), (24, 0), (24, 16), (0, 16)])
    found = noise(drive_with(hall, sigma=0.01, sigma_far=0.03, far=8.0))
    assert found.sigma[[0, -1]] == pytest.approx([0.01, 0.03], rel=0.15)
    assert found.at(20.0) > 2 * found.at(2.0)
    assert noise(drive_with(hall, sigma=0.01)).growth < 0.001


def test_mixed_pixels_do_not_change_it():
    mixed = all_round(0.25, sigma=0.01, beam_width=np.deg2rad(0.3), mixed=0.9)
    assert noise(mixed).at(2.5) == pytest.approx(0.01, rel=0.15)


def bent_walls(recording, depth, over):
    """The same scans with walls that wave by `depth` over the length `over` [m]."""
    along = recording.ranges * np.tile(np.abs(np.sin(recording[0].bearings)), len(recording))
    swing = depth * np.sin(2 * np.pi * np.where(np.isfinite(along), along, 0.0) / over)
    return replace(recording, ranges=(recording.ranges + swing).astype(np.float32))


def test_walls_that_are_not_straight_are_told_from_the_noise_of_the_laser():
    straight = drive_with(room([(0, 0), (8, 0), (8, 6), (0, 6)]), sigma=0.005)
    bent = bent_walls(straight, depth=0.02, over=2.0)
    assert propose(straight).bend < 0.004
    assert noise(bent).at(2.5) == pytest.approx(0.005, rel=0.2)
    assert 0.006 < propose(bent).bend < 0.02


@pytest.mark.parametrize("name", ["office", "corridor"])
def test_doors_in_their_frames_do_not_make_walls_bend(name):
    assert propose(WORLDS[name].recording(name, FRAMES)).bend < 0.006


def scans_of(*ranges):
    return Recording.from_scans([Scan.regular(np.asarray(each, float), -1.0, 0.01) for each in ranges])


@pytest.mark.parametrize(
    "recording",
    [
        pytest.param(scans_of(), id="no scan"),
        pytest.param(scans_of(np.full(10, 2.0)), id="ten beams"),
        pytest.param(scans_of(*[np.full(400, np.inf)] * 5), id="nothing returns"),
        pytest.param(scans_of(*np.random.default_rng(1).uniform(0.5, 20, (40, 400))), id="no wall"),
    ],
)
def test_without_a_straight_wall_the_noise_is_unknown(recording):
    found = noise(recording)
    assert not found.known
    assert np.isnan(found.at(2.0))
