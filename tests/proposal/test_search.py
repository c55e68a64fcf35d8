"""Thresholds that fit a laser are found without truth; judged here by the truth."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lineseg import EXTRACTORS, Cancelled, Params, extract, open_recording
from lineseg.proposal import propose
from lineseg.scan import Recording, Scan
from lineseg.simulate.laser import LMS_200, RPLIDAR_A2, UTM_30LX
from lineseg.simulate.world import Feature, Material, box, room
from lineseg.simulate.worlds import WORLDS
from lineseg.truth import Agreement, agreement, true_lines
from lineseg.tuning import Objective

FRAMES = 20
EPSILONS = np.geomspace(0.008, 0.5, 19)


def some(recording, frames=FRAMES):
    return recording.only(np.linspace(0, len(recording) - 1, frames).round().astype(int))


def score(recording, params):
    total = Agreement.of_all(
        agreement(extract(scan, params), true_lines(scan), np.full((99, 2, 2), np.nan)) for scan in recording
    )
    return Objective("truth").of_rates(total.true_rate, total.false_rate, total.completeness)


def best_score(recording):
    return max(score(recording, Params(epsilon=epsilon, delta=epsilon)) for epsilon in EPSILONS.tolist())


def world(name, sigma, laser):
    return replace(WORLDS[name], laser=replace(laser, sigma=sigma, sigma_far=sigma)).recording(name, FRAMES)


@pytest.fixture(scope="module")
def board_room():
    reference = os.environ.get("LINESEG_DATA")
    file = Path(reference or ".").parent / "truth" / "lroom_b.npz"
    if not reference or not file.exists():
        pytest.skip("set LINESEG_DATA to the folder of recordings; its sibling `truth` holds rooms with truth")
    return some(open_recording(file))


def test_in_a_room_of_boards_the_proposal_is_as_good_as_any_epsilon(board_room):
    found = propose(board_room)
    assert found.changed
    assert found.params.epsilon > 2 * Params().epsilon
    assert found.pieces > 1.3
    assert f"ε = {found.params.epsilon:g} fits; at 0.03 a wall breaks into {found.pieces:.1f} pieces" in found.text
    assert score(board_room, found.params) > 0.97 * best_score(board_room)
    assert score(board_room, Params()) < 0.6


@pytest.mark.parametrize(
    ("name", "sigma", "laser"),
    [
        ("flat", 0.02, RPLIDAR_A2),
        ("flat", 0.075, RPLIDAR_A2),
        ("office", 0.03, UTM_30LX),
        ("warehouse", 0.02, UTM_30LX),
        ("warehouse", 0.002, RPLIDAR_A2),
        ("boards", 0.005, LMS_200),
    ],
)
def test_for_a_coarse_or_fine_laser_the_proposal_is_as_good_as_any_epsilon(name, sigma, laser):
    recording = world(name, sigma, laser)
    assert score(recording, propose(recording).params) > 0.97 * best_score(recording)


@pytest.mark.parametrize("name", ["boards", "lobby", "workshop"])
def test_for_walls_that_bend_and_noise_that_grows_the_proposal_is_as_good_as_any_epsilon(name):
    recording = WORLDS[name].recording(name, FRAMES)
    assert score(recording, propose(recording).params) > 0.97 * best_score(recording)


@pytest.mark.parametrize(("name", "growth"), [("office", 0.015), ("lobby", 0.01), ("workshop", 0.01)])
def test_for_noise_in_proportion_to_the_range_the_proposal_is_better_than_any_constant_epsilon(name, growth):
    laser = replace(RPLIDAR_A2, sigma=0.015, sigma_far=0.015, growth=growth)
    recording = replace(WORLDS[name], laser=laser).recording(name, FRAMES)
    found = propose(recording)
    assert score(recording, found.params) > best_score(recording)
    assert (
        f"ε = {found.params.epsilon:g} and κ = {found.params.epsilon_growth:g} fit; 0.03 and 0.002 miss " in found.text
    )
    assert found.text.endswith("% of the walls.")


@pytest.mark.parametrize("laser", [LMS_200, UTM_30LX])
def test_one_straight_cabinet_does_not_hide_that_the_walls_bend(laser):
    bent = Material(returns=0.9985, warp=0.028, warp_length=0.4)
    hall = room([(0, 0), (9, 0), (9, 6), (0, 6)], material=bent) + box((5.0, 4.6), 1.5, 0.6)
    fine = replace(laser, sigma=0.003, sigma_far=0.003, resolution=0.001)
    recording = replace(WORLDS["boards"], world=lambda: hall, laser=fine).recording("hall", FRAMES)
    assert score(recording, propose(recording).params) > 0.97 * best_score(recording)


def test_lines_that_take_in_shallow_doors_are_not_taken_for_steady():
    depths = [(0.09, 0.12), (0.07, 0.06), (0.05, 0.05), (0.06, 0.07)]
    doors = {wall: [Feature(1.2, 0.95, one), Feature(3.4, 0.95, other)] for wall, (one, other) in enumerate(depths)}
    bent = Material(returns=0.9985, warp=0.013, warp_length=1.7)
    hall = room([(0, 0), (8, 0), (8, 8), (0, 8)], doors, bent)
    laser = replace(RPLIDAR_A2, sigma=0.014, sigma_far=0.014)
    recording = replace(WORLDS["boards"], world=lambda: hall, laser=laser).recording("hall", FRAMES)
    assert score(recording, propose(recording).params) > 0.7 * best_score(recording)


def test_nothing_is_proposed_if_the_current_values_are_as_good():
    recording = world("flat", 0.008, RPLIDAR_A2)
    found = propose(recording)
    assert not found.changed
    assert found.text == ""
    assert found.params == Params()
    assert 0.5 < found.fitting.epsilon / Params().epsilon < 2


@pytest.mark.parametrize("method", ["split-and-merge-textbook", "line-tracking", "hough", "ransac"])
def test_other_methods_get_their_own_thresholds(board_room, method):
    found = propose(board_room, method=method)
    kind = EXTRACTORS[method].params_type
    assert type(found.params) is kind
    assert found.changed
    for name, _, knob in kind.knobs():
        assert (getattr(found.params, name) != getattr(kind(), name)) <= (knob.scatter > 0 or name == "epsilon_growth")


def test_only_what_depends_on_the_noise_is_changed():
    present = Params(seed_points=8, min_length=0.4)
    found = propose(world("flat", 0.075, RPLIDAR_A2), present)
    kept = {name: getattr(present, name) for name in ("epsilon", "epsilon_growth", "delta")}
    assert replace(found.params, **kept) == present


def scans_of(*ranges):
    return Recording.from_scans([Scan.regular(np.asarray(each, float), -1.0, 0.01) for each in ranges])


@pytest.mark.parametrize(
    ("recording", "why"),
    [
        pytest.param(scans_of(), "scans with a return; 0 have one", id="no scan"),
        pytest.param(scans_of(np.full(400, 2.0)), "scans with a return; 1 has one", id="one frame"),
        pytest.param(scans_of(*[np.full(10, 2.0)] * 9), "Too few points lie on straight walls", id="ten beams"),
        pytest.param(scans_of(*[np.full(400, np.inf)] * 9), "scans with a return; 0 have one", id="nothing returns"),
        pytest.param(world("flat", 0.5, RPLIDAR_A2), "mm here. That is too much", id="noise above every slider"),
        pytest.param(scans_of(*3 + np.random.default_rng(1).normal(0, 0.01, (20, 600))), "straight enough", id="round"),
        pytest.param(
            scans_of(*np.random.default_rng(1).uniform(0.5, 20, (40, 400))),
            "Too few points lie on straight walls",
            id="no wall",
        ),
    ],
)
def test_a_sentence_says_why_nothing_can_be_proposed(recording, why):
    found = propose(recording)
    assert not found.changed
    assert found.params == Params()
    assert found.fitting is None
    assert why in found.text


def test_a_small_gain_is_told_with_the_values_that_fit(data_dir):
    found = propose(open_recording(data_dir / "carmen_belgioioso" / "carmen_belgioioso.log.gz"))
    assert found.changed
    values = (found.params.epsilon, found.params.delta, found.params.epsilon_growth)
    assert found.text.endswith("ε = {:g}, δ = {:g} and κ = {:g} fit slightly better.".format(*values))


def test_a_search_that_is_no_longer_wanted_ends():
    with pytest.raises(Cancelled):
        propose(world("flat", 0.02, RPLIDAR_A2), wanted=lambda: False)


@pytest.mark.parametrize(("name", "grows"), [("corridor", False), ("lobby", True)])
def test_epsilon_grows_with_the_range_only_if_the_noise_does(name, grows):
    found = propose(WORLDS[name].recording(name, FRAMES))
    assert found.changed
    assert (found.params.epsilon_growth > 0) is grows
    assert propose(WORLDS[name].recording(name, FRAMES), Params(epsilon_growth=0)).params.epsilon_growth == 0
