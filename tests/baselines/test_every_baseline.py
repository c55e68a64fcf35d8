"""Properties of every baseline for any scan."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import corner, room, scans, wall_ahead

from lineseg import EXTRACTORS, Scan, agreement, open_recording, true_lines

NAMES = [
    "split-and-merge-textbook",
    "iterative-end-point-fit",
    "line-tracking",
    "line-regression",
    "hough",
    "ransac",
    "expectation-maximisation",
]
# The cells of a Hough transform do not turn with the scene.
TURNING = [name for name in NAMES if name != "hough"]
methods = pytest.mark.parametrize("method", [EXTRACTORS[name] for name in NAMES], ids=NAMES)
turning = pytest.mark.parametrize("method", [EXTRACTORS[name] for name in TURNING], ids=TURNING)
lively = settings(max_examples=30)


def spans(method, scan):
    segments = method.extract(scan, method.params_type(min_length=0.3)).segments
    return sorted((segment.first, segment.last, segment.points) for segment in segments)


@methods
def test_a_wall_is_one_segment_and_a_corner_two(method):
    params = method.params_type()
    (segment,) = method.extract(wall_ahead(noise=0.005), params).segments
    assert segment.points > 170
    assert segment.rho == pytest.approx(2, abs=0.005)
    first, second = method.extract(corner(noise=0.005, beams=400), params).segments
    assert first.last < second.first
    assert np.hypot(*np.subtract(first.end, (3, 2))) < 0.3


@methods
def test_a_wall_across_the_seam_is_one_segment(method):
    segments = method.extract(room(noise=0.005), method.params_type()).segments
    assert len(segments) == 4
    assert sum(segment.last < segment.first for segment in segments) == 1


@methods
@lively
@given(scan=scans())
def test_segments_share_no_beam_and_meet_their_thresholds(method, scan):
    params = method.params_type()
    result = method.extract(scan, params)
    assert (result.method, result.params) == (method.name, params)
    counted = np.bincount(result.labels[result.labels >= 0], minlength=len(result.segments))
    assert list(counted) == [segment.points for segment in result.segments]
    assert all(scan.valid[result.labels >= 0])
    assert [segment.first for segment in result.segments] == sorted(segment.first for segment in result.segments)
    for label, segment in enumerate(result.segments):
        assert segment.points >= params.min_points
        assert segment.length >= params.min_length
        assert segment.line[2] <= 0
        distances = segment.distance(scan.xy[result.labels == label])
        assert np.sqrt(np.mean(distances**2)) == pytest.approx(segment.rms, abs=1e-9)
        for x, y in (segment.start, segment.end):
            assert np.dot(segment.line, (x, y, 1)) == pytest.approx(0, abs=1e-9)


@methods
@lively
@given(scan=scans())
def test_the_trace_ends_where_the_extraction_ends(method, scan):
    params = method.params_type()
    traced = method.trace(scan, params)
    result = method.extract(scan, params)
    assert traced.extraction.segments == result.segments
    assert traced.extraction.dropped == result.dropped
    final = sorted((line.first, line.last) for line in traced.lines_at(len(traced) - 1))
    assert final == sorted((segment.first, segment.last) for segment in result.segments)
    assert len(traced.jump("line")) == len(result.segments)
    for decision in traced:
        assert decision.text
        assert "{" not in decision.text


@methods
@lively
@given(scan=scans(full_circle=True), turn=st.integers(1, 259))
def test_moving_the_seam_of_a_full_circle_moves_the_beams_and_nothing_else(method, scan, turn):
    n = len(scan)
    turned = Scan(np.roll(scan.ranges, turn), np.unwrap(np.roll(scan.bearings, turn)))
    expected = sorted(((first + turn) % n, (last + turn) % n, points) for first, last, points in spans(method, scan))
    assert spans(method, turned) == expected


@turning
@lively
@given(scan=scans(), angle=st.floats(-3, 3))
def test_turning_the_laser_turns_the_segments(method, scan, angle):
    assert spans(method, Scan(scan.ranges, scan.bearings + angle)) == spans(method, scan)


@turning
@lively
@given(scan=scans())
def test_a_laser_that_turns_the_other_way_sees_the_mirror_image(method, scan):
    assert spans(method, Scan(scan.ranges, -scan.bearings)) == spans(method, scan)


@methods
@lively
@given(scan=scans())
def test_every_beam_has_an_explanation_that_agrees_with_its_label(method, scan):
    traced = method.trace(scan, method.params_type())
    for beam in range(0, len(scan), 11):
        why = traced.explain(beam)
        assert why.segment == traced.extraction.labels[beam]
        assert f"beam {beam}" in why.text


@methods
@pytest.mark.parametrize("beams", [0, 1, 2, 3, 5])
def test_scans_of_few_beams_have_no_segments(method, beams):
    for scan in (Scan.regular(np.ones(beams), 0.0, 0.01), Scan.regular(np.full(beams, np.nan), 0.0, 0.01)):
        assert method.extract(scan, method.params_type()).segments == ()
        assert method.trace(scan, method.params_type()).lines_at(-1) == ()


@methods
def test_equal_points_and_points_on_one_beam_break_nothing(method):
    for scan in (Scan(np.full(30, 2.0), np.full(30, 0.3)), Scan(np.linspace(1, 3, 30), np.full(30, 0.3))):
        assert len(method.extract(scan, method.params_type(min_length=0.0)).segments) <= 1


@methods
def test_most_of_the_true_lines_of_the_samples_are_found(method):
    for sample, least in (("hallway", 0.8), ("laboratory", 0.65)):
        recording = open_recording(f"sample_scans/{sample}.npz")
        frames = [recording[frame] for frame in range(0, len(recording), len(recording) // 8)]
        found = [agreement(method.extract(scan, method.params_type()), true_lines(scan)) for scan in frames]
        total = sum(found[1:], found[0])
        # Where nothing is merged, a stray point cuts a wall for good.
        assert total.true_rate > (0.6 if method.name == "iterative-end-point-fit" else least)
        assert total.false_rate < 0.25


@methods
def test_real_recordings_raise_no_error(method, data_dir):
    seen = 0
    for path in sorted(data_dir.glob("*/*")):
        try:
            recording = open_recording(path)
        except ValueError:
            continue
        for frame in range(0, len(recording), max(1, len(recording) // 3)):
            result = method.extract(recording[frame], method.params_type())
            assert all(np.isfinite((*segment.line, *segment.start, *segment.end)).all() for segment in result.segments)
            seen += 1
    assert seen > 20
