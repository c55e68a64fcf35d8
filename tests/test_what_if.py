"""A proposed change does change the answer for a beam, and no nearer value does."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import corner, scan_of, scans, wall_ahead

from lineseg import EXTRACTORS, Params, Scan, extract, what_if
from lineseg.what_if import first_change, nearest

KNOBS = {name: (kind, knob) for name, kind, knob in Params.knobs()}


def by_name(scan, beam, params=None):
    return {each.name: each for each in what_if(scan, beam, params)}


def line_of(scan, beam, params):
    labels = extract(scan, params).labels
    return set(np.flatnonzero(labels == labels[beam]).tolist()) if labels[beam] >= 0 else set()


def is_another(one, other):
    return bool(one | other) and 2 * len(one & other) <= len(one | other)


@settings(max_examples=25)
@given(
    scans(), st.floats(0, 1), st.sampled_from([Params(), Params(epsilon=0.012), Params(seed_points=3, max_dropout=0)])
)
def test_a_run_with_the_value_gives_the_other_answer_and_the_step_before_does_not(scan, share, params):
    beam = int(share * (len(scan) - 1))
    now = line_of(scan, beam, params)
    for each in what_if(scan, beam, params):
        if each.value is None:
            continue
        kind, knob = KNOBS[each.name]
        present = getattr(params, each.name)
        assert isinstance(each.value, kind)
        assert knob.low <= each.value <= knob.high
        then = line_of(scan, beam, params.but(**{each.name: each.value}))
        assert is_another(now, then)
        assert each.segment == extract(scan, params.but(**{each.name: each.value})).labels[beam]
        before = kind(round(each.value + (knob.step if each.value < present else -knob.step), 9))
        if abs(before - present) < abs(each.value - present) - 1e-9 and (before - present) * (each.value - present) > 0:
            assert not is_another(now, line_of(scan, beam, params.but(**{each.name: before})))


def test_a_line_that_was_too_short_appears_once_shorter_lines_are_allowed():
    scan = wall_ahead(half_width=0.25, noise=0.001)
    (short,) = extract(scan).dropped
    found = by_name(scan, 90)["min_length"]
    assert found.value == pytest.approx(np.floor(short.length * 100) / 100)
    assert (found.segment, found.first, found.last) == (0, short.first, short.last)
    assert (
        found.text == f"with L_min = {found.value:g} m beam 90 would be in a line of beams {short.first}–{short.last}"
    )


def test_a_line_disappears_once_a_threshold_demands_more():
    scan = wall_ahead(half_width=0.5, noise=0.001)
    (line,) = extract(scan).segments
    found = by_name(scan, 90)
    assert found["min_points"].value == line.points + 1
    assert found["min_length"].value == pytest.approx(np.floor(line.length * 100 + 1) / 100)
    assert found["min_length"].text.endswith("beam 90 would be in no line")


def test_a_line_of_other_beams_is_named_with_the_one_that_it_replaces():
    step = scan_of([(2, -1.5, 2, -0.3), (2.05, -0.3, 2.05, 1.5)], field_of_view=1.2, beams=241)
    before = extract(step).segments[0]
    found = by_name(step, 60)["epsilon"]
    then = f"beam 60 would be in a line of beams 0–240 instead of beams 0–{before.last}"
    assert found.text == f"with ε = {found.value:g} m {then}"


def test_a_threshold_that_decides_nothing_says_so():
    found = by_name(corner(), 40)["max_dropout"]
    assert found.value is None
    assert found.text == "no D_max from 0 to 40 beams changes the answer for beam 40"


def test_no_threshold_brings_a_beam_back_that_did_not_return():
    assert all(each.value is None for each in what_if(wall_ahead(lost=(7,)), 7))
    assert len(what_if(Scan(np.full(3, np.nan), np.zeros(3)), 1)) == len(KNOBS)


def test_a_threshold_may_lie_outside_its_slider():
    found = by_name(wall_ahead(half_width=0.5, noise=0.001), 90, Params(min_length=20.0))["min_length"]
    assert found.value < 1.0
    assert by_name(wall_ahead(), 90, Params(epsilon=5.0, delta=0.001)).keys() == KNOBS.keys()


def test_every_method_can_be_asked():
    for method in EXTRACTORS:
        assert len(what_if(corner(), 40, method=method)) == len(EXTRACTORS[method].params_type.knobs())


@given(st.integers(1, 299), st.data())
def test_the_nearest_of_two_changes_is_found_whichever_side_it_is_on(at, data):
    kind, knob = KNOBS["min_length"]
    below, above = data.draw(st.integers(-1, at - 1)), data.draw(st.integers(at + 1, 301))
    differs = lambda value: round(value * 100) <= below or round(value * 100) >= above  # noqa: E731
    found = nearest(at * knob.step, kind, knob, differs)
    expected = min((k for k in (below, above) if 0 <= k <= 300), key=lambda k: abs(k - at), default=None)
    if expected is None:
        assert found is None
    else:
        assert differs(found)
        assert abs(round(found * 100) - at) == abs(expected - at)


def test_near_means_near_on_the_slider():
    kind, knob = KNOBS["epsilon"]
    assert nearest(0.05, kind, knob, lambda value: value <= 0.02 or value >= 0.1) == pytest.approx(0.1)


@given(st.integers(0, 80), st.integers(1, 80))
def test_a_single_change_is_found_exactly(change, count):
    found = first_change(np.arange(1.0, count + 1), 5.0, lambda k: k >= change)
    assert found == (change if change < count else None)


def test_an_unknown_beam_is_refused():
    with pytest.raises(ValueError, match="beam 180: the scan has the beams 0 to 179"):
        what_if(wall_ahead(), 180)
