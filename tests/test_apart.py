"""Why two beams are in one line or in two; what is said to change that does change it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lineseg_app.places import data_folder
from scenes import corner, scans, wall_ahead

from lineseg import EXTRACTORS, Params, Scan, difference, extract, open_recording, why_apart

SAMPLES = data_folder("sample_scans")


def in_one(scan: Scan, params: Params, *groups: np.ndarray) -> bool:
    """Whether a segment has more than half of the beams of each group."""
    labels = extract(scan, params).labels
    return any(
        all(2 * np.count_nonzero(labels[group] == k) > len(group) for group in groups) for k in range(labels.max() + 1)
    )


@settings(max_examples=25)
@given(scans(), st.floats(0, 1), st.floats(0, 1), st.sampled_from([Params(), Params(epsilon=0.012, max_dropout=0)]))
def test_what_is_said_to_join_two_lines_joins_them_and_to_part_one_parts_it(scan, one, other, params):
    beams = [int(share * (len(scan) - 1)) for share in (one, other)]
    now = extract(scan, params)
    relation = why_apart(scan, *beams, params)
    assert (relation.one, relation.other) == tuple(now.labels[beams])
    assert relation.together == (relation.one == relation.other >= 0)
    groups = [
        np.flatnonzero(now.labels == now.labels[beam]) if now.labels[beam] >= 0 else np.array([beam]) for beam in beams
    ]
    for change in relation.changes:
        then = params.but(**change.values)
        if relation.together:
            assert difference(now, extract(scan, then)).counts["split"] > 0
        else:
            assert in_one(scan, then, *groups)


@pytest.mark.parametrize("name", ["hallway.npz", "room_of_boards.npz", "laboratory.npz"])
def test_neighbours_of_the_samples_are_told_apart(name):
    scan = open_recording(SAMPLES / name)[0]
    found = extract(scan).segments
    for k in range(len(found) - 1):
        relation = why_apart(scan, found[k].first, found[k + 1].first)
        assert relation.text.startswith(f"segments {k} and {k + 1} are two lines: ")
        for change in relation.changes:
            assert in_one(
                scan, Params().but(**change.values), *(np.flatnonzero(extract(scan).labels == j) for j in (k, k + 1))
            )


def test_a_dropout_is_named_with_the_value_that_would_cross_it():
    scan = wall_ahead(noise=0.001, lost=range(85, 93))
    relation = why_apart(scan, 40, 140)
    assert "8 beams without a return lie before beam 93, D_max = 3 (over by 5)" in relation.text
    assert {"max_dropout": 8} in [change.values for change in relation.changes]


def test_thresholds_that_refuse_one_after_the_other_are_raised_together():
    scan = wall_ahead(distance=4.0, half_width=3.0, noise=0.001, lost=range(80, 100))
    (change,) = why_apart(scan, 40, 140).changes
    assert change.values.keys() == {"max_dropout", "max_void"}
    assert change.text.startswith("with D_max = 20 beams and V_max = ")


def test_walls_at_a_right_angle_are_two_and_nothing_joins_them():
    scan = corner(noise=0.003)
    found = extract(scan).segments
    relation = why_apart(scan, found[0].first, found[1].last)
    assert "the lines are 9" in relation.text or "the lines are 89." in relation.text
    assert relation.changes == ()


def test_one_line_says_how_it_came_about_and_where_it_is_weakest():
    scan = wall_ahead(noise=0.003)
    (line,) = extract(scan).segments
    relation = why_apart(scan, line.first, line.last)
    assert relation.together
    far = int(np.argmax(np.where(extract(scan).labels == 0, line.distance(scan.xy), 0)))
    assert f"beam {far} is farthest from it" in relation.text


def test_other_methods_say_what_lies_between():
    scan = wall_ahead(distance=4.0, half_width=3.0, noise=0.001, lost=range(80, 100))
    params = EXTRACTORS["split-and-merge"].params_type().but(merge_distance=0.1)
    relation = why_apart(scan, 40, 140, params, "split-and-merge")
    assert "lie between them, 20 of them without a return" in relation.text


def test_a_beam_outside_the_scan_is_refused():
    with pytest.raises(ValueError, match="beam 400: the scan has the beams 0 to"):
        why_apart(wall_ahead(), 3, 400)
