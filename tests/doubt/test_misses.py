"""Probable misses are the ones that the score counts, and each says why it was refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import scan_of, scans, wall_ahead

from lineseg import Params, Recording, Scan, misses, open_recording, survey

SAMPLES = Path(__file__).parents[2] / "sample_scans"


@settings(max_examples=80)
@given(scans(), st.sampled_from([Params(), Params(epsilon=0.01, delta=0.04), Params(min_points=4, min_length=0.1)]))
def test_probable_misses_are_as_many_as_the_score_says(scan, params):
    expected = survey(Recording.from_scans([scan]), params).score("misses")[0]
    assert len(misses(scan, params)) == expected


@pytest.mark.parametrize("name", ["hallway.npz", "laboratory.npz", "hallway.mcap"])
def test_probable_misses_are_as_many_as_the_score_says_in_the_samples(name):
    recording = open_recording(SAMPLES / name)
    assert [len(misses(scan)) for scan in recording] == survey(recording).score("misses").tolist()


def rough(scan, by) -> Scan:
    """Make the ranges too long and too short in turn, by this much [m]."""
    return Scan(scan.ranges + by * (-1.0) ** np.arange(len(scan)), scan.bearings)


def test_a_rough_wall_was_refused_by_epsilon():
    (miss,) = misses(rough(wall_ahead(), by=0.015), Params(epsilon=0.01, epsilon_growth=0.0))
    assert miss.check == "epsilon"
    assert miss.value > miss.limit == 0.01
    assert miss.first <= miss.beam <= miss.last
    assert miss.text.startswith(f"a line was probably missed: beams {miss.first}–{miss.last}, {miss.points} points,")
    assert f" – seed refused by ε: beam {miss.beam} lies {miss.value:.4f} m from the line, ε = 0.0100 m" in miss.text


def test_a_grazing_wall_was_refused_by_delta():
    grazing = scan_of([(1.5, 0.5, 3, 0.5)], beams=300, field_of_view=0.9)
    (miss,) = misses(rough(grazing, by=0.03), Params(delta=0.02))
    assert (miss.check, miss.limit) == ("delta", 0.02)
    assert f"seed refused by δ: beam {miss.beam} lies {miss.value:.3f} m from its predicted point" in miss.text


def test_a_line_cut_short_says_where_it_stopped():
    scan = wall_ahead(half_width=0.4)
    bent = Scan(scan.ranges + 0.05 * (np.abs(scan.bearings) < 0.04), scan.bearings)
    (miss,) = misses(bent)
    assert (miss.check, miss.limit) == ("min_length", 0.6)
    assert " – its line of beams 61–83 was dropped: 0.300 m < L_min = 0.600 m" in miss.text
    assert "it stopped growing where beam 84 lies 0.050 m from the line, ε = 0.030 m" in miss.text


def test_nothing_is_missed_without_points():
    assert misses(Scan(np.full(50, np.nan), np.linspace(-1, 1, 50))) == ()
    assert misses(Scan(np.empty(0), np.empty(0))) == ()
    assert misses(wall_ahead()) == ()
