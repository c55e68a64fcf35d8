"""A frame in the world: where it lies, what is around it, and where clicks go."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.scene.palette import LIGHT
from lineseg_app.scene.picture import picture, picture_in_world
from lineseg_app.scene.viser_scene import ViserScene
from lineseg_app.scene.world import World
from lineseg_app.view import View
from scenes import wall_ahead

from lineseg import Recording, open_recording, survey
from lineseg.poses import PoseSource, Track, in_world

SAMPLE = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"


@pytest.fixture(scope="module")
def hallway() -> Recording:
    recording = open_recording(SAMPLE)
    assert recording.poses is not None
    poses = recording.poses.copy()
    poses[3] = np.nan
    return replace(recording, track=Track.of(poses, PoseSource("a test")))


@pytest.fixture(scope="module")
def world(hallway) -> World:
    world = World.of(hallway)
    assert world is not None
    return world


def draw(world: World, view: View, lines=None):
    found = findings(world.recording, view.frame, view.method, view.params)
    return picture_in_world(view, picture(view, world.recording, found, bounds_of(world.recording)), world, lines)


def from_walls(recording: Recording, xy: np.ndarray) -> np.ndarray:
    """The distance of each point (n, 2) from the nearest true wall."""
    starts, ends = recording.walls[:, :2], recording.walls[:, 2:]
    along = ends - starts
    share = np.clip(np.einsum("nwk,wk->nw", xy[:, None] - starts, along) / np.sum(along**2, axis=1), 0, 1)
    return np.linalg.norm(xy[:, None] - starts - share[..., None] * along, axis=2).min(axis=1)


def test_scans_and_lines_of_all_frames_lie_on_the_walls(hallway, world):
    found = survey(hallway, View().params, scores=False)
    drawn = draw(world, View(frame=2).patched({"layers": {"all_lines": True}}), found)
    seen, ends = drawn.points["past"].xyz[:, :2], drawn.lines["all lines"].xyz.reshape(-1, 3)[:, :2]
    assert len(seen) > 500 and len(ends) > 200
    # Round pillars and what stands about are no walls.
    assert np.median(from_walls(hallway, seen)) < 0.02
    assert np.median(from_walls(hallway, ends)) < 0.02


def test_what_stays_the_same_from_frame_to_frame_is_the_same_object(world):
    one, other = (draw(world, View(frame=frame)) for frame in (1, 2))
    assert one.points["past"] is other.points["past"]
    assert one.lines["trajectory"] is other.lines["trajectory"]
    assert one.place != other.place


def test_the_last_scans_are_drawn_the_newest_on_top(world):
    last = world.last_seen(9, 4, LIGHT)
    expected = [len(world.recording[frame].xy[world.recording[frame].valid]) for frame in (5, 6, 7, 8)]
    assert len(last.xyz) == sum(expected)
    assert (np.diff(last.xyz[:, 2]) >= 0).all()
    newest = in_world(world.recording[8].xy[world.recording[8].valid], world.poses[8])
    assert np.allclose(last.xyz[-expected[-1] :, :2], newest, atol=1e-5)
    assert "past" not in draw(world, View(frame=9, past="none")).points


def test_a_frame_without_a_pose_is_left_out(world):
    drawn = draw(world, View(frame=3))
    assert drawn.place is not None and drawn.place.pose is None
    assert set(drawn.nodes) == {"past", "trajectory"}


@pytest.mark.parametrize("upside_down", [False, True])
def test_a_click_in_the_world_is_a_place_before_the_laser(upside_down):
    poses = np.array([[3.0, -1.0, 2.0], [np.nan] * 3])
    track = Track.of(poses, PoseSource("a test", upside_down=upside_down))
    recording = replace(Recording.from_scans([wall_ahead(), wall_ahead()]), track=track)
    world, picked = World.of(recording), []
    assert world is not None
    scene = ViserScene(lambda change: None, lambda *asked: picked.append(asked))
    try:
        for frame in (0, 1):
            view = View(frame=frame)
            scene.draw(draw(world, view), view.params, view.dark)
            point = recording[0].xy[7]
            scene._picked(
                tuple(in_world(point[None], poses[0], upside_down)[0]), False, lambda *asked: picked.append(asked)
            )
    finally:
        scene.stop()
    ((at, _, _),) = picked
    assert at == pytest.approx(tuple(point))
