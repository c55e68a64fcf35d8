"""The kernels compared with the slow oracle, and properties that hold for any scan."""

import naive
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import chipped, scans

from lineseg import Params, Scan, extract, trace

lively = settings(max_examples=3 * settings.default.max_examples // 2)


@st.composite
def thresholds(draw):
    return Params(
        epsilon=draw(st.sampled_from([0.01, 0.03, 0.08])),
        delta=draw(st.sampled_from([0.03, 0.1, 0.5])),
        seed_points=draw(st.integers(3, 9)),
        min_points=draw(st.integers(2, 20)),
        min_length=draw(st.sampled_from([0.0, 0.2, 0.6])),
        max_dropout=draw(st.sampled_from([0, 1, 3, 50])),
        max_gap=draw(st.sampled_from([0.2, 30.0])),
        merge_angle=draw(st.sampled_from([0.0, 0.1, 0.5])),
        merge_rms=draw(st.sampled_from([0.0, 1.0, 1.2, 3.0])),
        max_occluder=draw(st.sampled_from([0.0, 0.1, 0.3, 1.0])),
        max_void=draw(st.sampled_from([0.0, 0.05, 0.3, 1.0])),
        epsilon_growth=draw(st.sampled_from([0.0, 0.003, 0.02])),
    )


def spans(scan, params):
    return sorted((segment.first, segment.last) for segment in extract(scan, params).segments)


@lively
@given(scans(), thresholds())
def test_kernels_and_oracle_find_the_same_segments(scan, params):
    assert spans(scan, params) == naive.extract(scan, params)


@lively
@given(scans(), thresholds())
def test_the_trace_ends_where_the_extraction_ends(scan, params):
    traced, extracted = trace(scan, params), extract(scan, params)
    # It has tried every window; an extraction passes over some.
    assert traced.extraction.segments == extracted.segments
    assert traced.extraction.dropped == extracted.dropped
    final = sorted((line.first, line.last) for line in traced.lines_at(len(traced) - 1))
    assert final == spans(scan, params)


@lively
@given(scans(), thresholds())
def test_segments_share_no_beam_and_meet_their_thresholds(scan, params):
    result = extract(scan, params)
    counted = np.bincount(result.labels[result.labels >= 0], minlength=len(result.segments))
    assert list(counted) == [segment.points for segment in result.segments]
    for segment in result.segments:
        assert segment.points >= params.min_points
        assert segment.length >= params.min_length
        a, b, c = segment.line
        assert a * a + b * b == pytest.approx(1)
        assert c <= 0
        for x, y in (segment.start, segment.end):
            assert a * x + b * y + c == pytest.approx(0, abs=1e-9)


@lively
@given(scans(full_circle=True), thresholds(), st.integers(1, 259))
def test_moving_the_seam_of_a_full_circle_moves_the_beams_and_nothing_else(scan, params, turn):
    n = len(scan)
    turned = Scan(np.roll(scan.ranges, turn), np.roll(scan.bearings, turn))
    # The seam lies where the bearings jump; a scan announces its beams in order, so the jump is unwrapped.
    turned = Scan(turned.ranges, np.unwrap(turned.bearings))
    expected = sorted(((first + turn) % n, (last + turn) % n) for first, last in spans(scan, params))
    assert spans(turned, params) == expected


@lively
@given(scans(full_circle=True), thresholds(), st.integers(1, 3))
def test_beams_missing_at_the_seam_are_a_dropout_like_any_other(scan, params, missing):
    lost = Scan(np.where(np.arange(len(scan)) < len(scan) - missing, scan.ranges, np.nan), scan.bearings)
    chip = chipped(scan, missing)
    assert (chip.full_circle, chip.around) == (True, len(scan))
    assert spans(chip, params) == spans(lost, params) == naive.extract(chip, params)
    assert [line[1:] for line in lines(trace(chip, params))] == [line[1:] for line in lines(trace(lost, params))]


def lines(traced):
    return [(decision.points, decision.kind, decision.first, decision.last, decision.beam) for decision in traced]


@lively
@given(scans(), thresholds(), st.floats(-3, 3))
def test_turning_the_laser_turns_the_segments(scan, params, angle):
    turned = extract(Scan(scan.ranges, scan.bearings + angle), params)
    rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    for before, after in zip(extract(scan, params).segments, turned.segments, strict=True):
        assert (before.first, before.last) == (after.first, after.last)
        assert rotation @ before.start == pytest.approx(after.start, abs=1e-8)


@lively
@given(scans(), thresholds())
def test_a_laser_that_turns_the_other_way_sees_the_mirror_image(scan, params):
    mirrored = extract(Scan(scan.ranges, -scan.bearings), params)
    for before, after in zip(extract(scan, params).segments, mirrored.segments, strict=True):
        assert (before.first, before.last) == (after.first, after.last)
        assert (before.end[0], -before.end[1]) == pytest.approx(after.end, abs=1e-9)


@lively
@given(scans(), thresholds(), st.sampled_from([0.125, 8.0]))
def test_scaling_the_scene_and_the_distances_changes_nothing_else(scan, params, scale):
    scaled = params.but(
        epsilon=params.epsilon * scale,
        delta=params.delta * scale,
        min_length=params.min_length * scale,
        max_gap=params.max_gap * scale,
        max_occluder=params.max_occluder * scale,
        max_void=params.max_void * scale,
    )
    assert spans(Scan(scan.ranges * scale, scan.bearings), scaled) == spans(scan, params)


@lively
@given(scans(), thresholds(), st.data())
def test_beams_without_a_return_only_shift_the_numbers_when_dropouts_may_be_crossed(scan, params, data):
    params = params.but(max_dropout=1000, max_void=0.0)
    start = Scan(scan.ranges[scan.valid], scan.bearings[scan.valid])
    if start.full_circle or scan.full_circle:
        return
    here = np.flatnonzero(scan.valid)
    assert spans(scan, params) == [(here[first], here[last]) for first, last in spans(start, params)]


@lively
@given(scans(), thresholds())
def test_every_beam_has_an_explanation_that_agrees_with_its_label(scan, params):
    traced = trace(scan, params)
    for beam in range(0, len(scan), 7):
        why = traced.explain(beam)
        assert why.segment == traced.extraction.labels[beam]
        assert f"beam {beam}" in why.text
