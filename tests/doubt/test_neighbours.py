"""Lines that only one frame has or lacks, compared with its neighbours while the sensor moves."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import scan_of

from lineseg import Params, Recording, Scan, open_recording, survey
from lineseg.doubt.neighbours import VOTES, mark_frame, motion_between, reversed_motion
from lineseg.survey import SEGMENT

SAMPLES = Path(__file__).parents[2] / "sample_scans"
WALLS = [(4, -3, 4, 3), (4, 3, -4, 3), (-4, 3, -4, -3), (-4, -3, 4, -3), (1, 1, 2, 1.6)]


def seen_from(x, y, heading, walls=WALLS, **options) -> Scan:
    """The scan of a laser at (x, y) that looks along `heading` [rad]."""
    c, s = np.cos(heading), np.sin(heading)
    placed = [((a - x) * c + (b - y) * s, (b - y) * c - (a - x) * s) for wall in walls for a, b in (wall[:2], wall[2:])]
    options = {"beams": 720, "field_of_view": 2 * np.pi, "noise": 0.003} | options
    return scan_of([(*placed[k], *placed[k + 1]) for k in range(0, len(placed), 2)], **options)


def rows_of(*sweeps):
    found = survey(Recording.from_scans(sweeps), Params())
    return [found[frame] for frame in range(len(sweeps))]


def scores_of(*sweeps):
    """The scores of the second of three frames."""
    found = survey(Recording.from_scans(sweeps))
    return {name: float(found.score(name)[1]) for name in ("brief", "gone", "jump", "jolt", "turn")}


@given(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(-0.7, 0.7))
def test_the_motion_between_two_frames_is_that_of_the_sensor(x, y, turn):
    here, there = rows_of(seen_from(0, 0, 0, seed=1), seen_from(x, y, turn, seed=2))
    cos, sin, tx, ty = motion_between(here, there, np.empty(VOTES))
    assert np.arctan2(sin, cos) == pytest.approx(-turn, abs=0.01)
    assert (tx, ty) == pytest.approx(
        (-x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) - y * np.cos(turn)), abs=0.02
    )


def test_a_motion_reversed_leads_back():
    cos, sin, x, y = reversed_motion((np.cos(0.2), np.sin(0.2), 0.3, -0.1))
    px, py = np.cos(0.2) * 2 - np.sin(0.2) * 1 + 0.3, np.sin(0.2) * 2 + np.cos(0.2) * 1 - 0.1
    assert (cos * px - sin * py + x, sin * px + cos * py + y) == pytest.approx((2, 1))


@pytest.mark.parametrize("other", [1.0, np.nextafter(1.0, 0), np.nextafter(1.0, 2)])
def test_of_two_equal_turns_the_smaller_is_taken_whatever_the_rounding(other):
    def walls(*normals_and_lengths):
        rows = np.zeros(len(normals_and_lengths), SEGMENT)
        for row, (normal, length) in zip(rows, normals_and_lengths, strict=True):
            row["a"], row["b"], row["c"], row["length"] = np.cos(normal), np.sin(normal), -2.0, length
        return rows

    there = walls((-0.2, 1.0), (0.1, other))
    cos, sin, _, _ = motion_between(walls((0.0, 2.0)), there, np.empty(VOTES))
    assert np.arctan2(sin, cos) == pytest.approx(0.1, abs=0.02)


@pytest.mark.parametrize("name", ["hallway", "laboratory"])
def test_the_motions_of_the_samples_are_their_poses(name):
    recording = open_recording(SAMPLES / f"{name}.npz")
    found, votes = survey(recording), np.empty(VOTES)
    turns = [motion_between(found[k], found[k + 1], votes)[:2] for k in range(len(recording) - 1)]
    assert recording.poses is not None
    off = np.arctan2([sin for _, sin in turns], [cos for cos, _ in turns]) + np.diff(np.unwrap(recording.poses[:, 2]))
    assert np.quantile(np.abs(off), 0.98) < np.deg2rad(1)


def test_nothing_stands_out_while_the_sensor_only_moves():
    assert scores_of(seen_from(-0.1, 0, -0.1), seen_from(0, 0, 0), seen_from(0.1, 0, 0.1)) == pytest.approx(
        {"brief": 0, "gone": 0, "jump": 0, "jolt": 0, "turn": 0.1}, abs=0.01
    )


def test_a_line_that_comes_and_goes_is_short_lived():
    board = [*WALLS, (-2, 1, -1, 1)]
    around = seen_from(-0.1, 0, -0.1), seen_from(0.1, 0, 0.1)
    scores = scores_of(around[0], seen_from(0, 0, 0, board), around[1])
    assert scores["brief"] == pytest.approx(1.0, abs=0.1)
    assert scores["gone"] == 0
    before, here, behind = rows_of(around[0], seen_from(0, 0, 0, board), around[1])
    brief, gone = np.zeros(len(here), bool), np.zeros(len(before), bool)
    mark_frame(before, here, behind, np.array((-np.pi, np.pi)), np.empty(VOTES), brief, gone)
    assert here["length"][brief].tolist() == [pytest.approx(scores["brief"])]
    assert not gone.any()


def test_a_line_that_both_neighbours_have_is_interrupted():
    without = WALLS[:4]
    scores = scores_of(seen_from(-0.1, 0, -0.1), seen_from(0, 0, 0, without), seen_from(0.1, 0, 0.1))
    assert scores["gone"] == pytest.approx(np.hypot(1, 0.6), abs=0.25)
    assert scores["brief"] == 0


def test_a_line_that_is_out_of_view_is_not_interrupted():
    ahead = {"field_of_view": np.pi, "beams": 360}
    wall = [(4, -3, 4, 3), (-1, 3, 3, 3), (-1, -3, 3, -3)]
    around = seen_from(0, 0, 0, wall, seed=1, **ahead), seen_from(0, 0, 0, wall, seed=2, **ahead)
    turned = scores_of(around[0], seen_from(0, 0, 0.6, wall, **ahead), around[1])
    assert turned["gone"] == 0
    assert turned["jolt"] == pytest.approx(0.6, abs=0.02)


def test_a_new_line_that_stays_is_neither():
    without = WALLS[:4]
    scores = scores_of(seen_from(-0.1, 0, -0.1, without), seen_from(0, 0, 0), seen_from(0.1, 0, 0.1))
    assert (scores["brief"], scores["gone"], scores["jump"]) == (0, 0, 0)


def test_a_wall_cut_in_two_is_still_there_and_its_count_jumps():
    cut = seen_from(0, 0, 0, [(4, -3, 4, -0.3), (4, 0.3, 4, 3), *WALLS[1:]])
    scores = scores_of(seen_from(0, 0, 0), cut, seen_from(0, 0, 0))
    assert (scores["brief"], scores["gone"], scores["jump"]) == (0, 0, 1)


def test_a_knock_is_a_jolt_and_a_steady_turn_is_none():
    assert scores_of(seen_from(0, 0, 0), seen_from(0, 0, 0.15), seen_from(0, 0, 0))["jolt"] == pytest.approx(
        0.15, abs=0.02
    )
    steady = scores_of(seen_from(0, 0, -0.15), seen_from(0, 0, 0), seen_from(0, 0, 0.15))
    assert (steady["jolt"], steady["turn"]) == pytest.approx((0.0, 0.15), abs=0.02)
    assert scores_of(seen_from(0, 0, 0), seen_from(0, 0, 0), seen_from(0, 0, 0.3))["jolt"] < 0.02


def test_the_first_and_the_last_frame_do_not_stand_out():
    found = survey(Recording.from_scans([seen_from(0, 0, 0), seen_from(0, 0, 0.3, WALLS[:2])]))
    assert all(not found.score(name).any() for name in ("brief", "gone", "jump", "jolt", "turn"))
