"""What a Picture of a View contains."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lineseg_app.frame.findings import BINS, findings, histogram
from lineseg_app.frame.geometry import bounds_of, square_of
from lineseg_app.frame.judge import Reference, judged
from lineseg_app.frame.state import state_of
from lineseg_app.scene.palette import LIGHT, linear
from lineseg_app.scene.picture import picture
from lineseg_app.scene.shapes import Lines, Points, dashed, points_at
from lineseg_app.view import Layers, View
from scenes import corner, scan_of, wall_ahead

from lineseg import EXTRACTORS, Params, Recording, difference, open_recording
from lineseg.colours import segment_colours
from lineseg.survey.difference import KEPT, LOST

SAMPLE = Path(__file__).parents[3] / "sample_scans" / "hallway.npz"


def draw(view: View, recording: Recording):
    found = findings(recording, view.frame, view.method, view.params)
    return picture(view, recording, found, bounds_of(recording))


def arrays(drawing) -> dict[str, bytes]:
    parts: dict[str, Points | Lines] = {**drawing.points, **drawing.lines}
    return {name: part.xyz.tobytes() + part.colours.tobytes() for name, part in parts.items()}


@pytest.fixture(scope="module")
def corners() -> Recording:
    """A corner with a pillar before it, so that lines are kept, dropped and cut."""
    return Recording.from_scans([corner(noise=0.006, seed=seed) for seed in range(2)])


def test_the_same_view_is_drawn_alike(corners):
    view = View(frame=1, step=20, selected=4)
    assert arrays(draw(view, corners)) == arrays(draw(view, corners))


def test_a_void_in_a_line_is_dashed():
    scan = scan_of([(2, -1, 2, 0.1), (2, 0.5, 2, 1)], beams=60, field_of_view=1.0)
    recording = Recording.from_scans([scan])
    crossing = View(params=Params(max_void=0.0, max_dropout=20))
    (whole,) = findings(recording, 0, crossing.method, crossing.params).extraction.segments
    lengths = np.linalg.norm(np.diff(draw(crossing, recording).lines["segments"].xyz, axis=1)[:, 0], axis=1)
    void = np.diff(np.array([whole.start, whole.end])[:, 1])[0] - lengths[:2].sum()
    assert void > 0.3
    assert len(lengths) > 3 and lengths[2:].max() <= 0.1 + 1e-6
    assert lengths[2:].sum() == pytest.approx(void / 2, abs=0.1)
    assert draw(View(), recording).lines["segments"].xyz[..., 1].max() < 0.2


def test_replay_forward_and_back_returns_to_the_same_pictures(corners):
    view = View()
    found = findings(corners, 0, view.method, view.params)
    bounds = bounds_of(corners)

    def at(step: int):
        return arrays(picture(replace(view, step=step), corners, found, bounds))

    forward = [at(step) for step in range(len(found.trace))]
    back = [at(step) for step in reversed(range(len(found.trace)))]
    assert forward == back[::-1]
    assert len({tuple(sorted(each.items())) for each in forward}) > len(forward) / 2


def test_the_last_step_of_the_replay_shows_the_lines_of_the_result(corners):
    found = findings(corners, 0, "region-growing", Params())
    last = draw(View(step=len(found.trace) - 1), corners)
    result = draw(View(), corners)
    np.testing.assert_allclose(last.lines["segments"].xyz, result.lines["segments"].xyz, atol=1e-6)
    np.testing.assert_array_equal(last.points["points"].colours, result.points["points"].colours)


def test_points_have_the_colour_of_their_segment_and_grey_without_one(corners):
    scan = corners[0]
    found = findings(corners, 0, "region-growing", Params())
    drawn = draw(View(), corners).points["points"]
    assert len(drawn.xyz) == scan.valid.sum()
    colours = segment_colours(found.extraction.segments)
    for label, colour in zip(found.extraction.labels[scan.valid], drawn.colours, strict=True):
        assert tuple(colour) == (tuple(colours[label]) if label >= 0 else LIGHT.point)


def test_neighbouring_segments_differ_in_colour():
    zigzag = [(k, 3 + k % 2, k + 1, 4 - k % 2) for k in range(-6, 6)]
    scan = scan_of(zigzag, beams=1500)
    segments = findings(Recording.from_scans([scan]), 0, "region-growing", Params()).extraction.segments
    colours = segment_colours(segments)
    assert len(segments) > 4
    assert all(tuple(one) != tuple(other) for one, other in itertools.pairwise(colours))


def test_a_wall_keeps_its_colour_from_frame_to_frame():
    frames = Recording.from_scans([wall_ahead(2.9 - 0.01 * k, noise=0.004, seed=k) for k in range(10)])
    colours = {
        tuple(segment_colours(findings(frames, k, "region-growing", Params()).extraction.segments)[0])
        for k in range(10)
    }
    assert len(colours) == 1


@pytest.mark.parametrize("layer", ["points", "seeds", "segments", "endpoints", "dropped", "laser", "grid"])
def test_a_layer_that_is_off_is_absent_and_the_others_stay(corners, layer):
    view = View(camera="free")
    without = arrays(draw(replace(view, layers=replace(view.layers, **{layer: False})), corners))
    everything = arrays(draw(view, corners))
    assert without == {name: part for name, part in everything.items() if name != layer}


def test_missed_lines_are_dashed_ghosts_in_their_own_place(corners):
    found, ghost = findings(corners, 0, "region-growing", Params()), (1.0, 2.0, 1.0, 5.0)
    dashes = picture(View(), corners, found, bounds_of(corners), ghosts=[ghost]).lines["ghosts"].xyz
    assert len(dashes) > 5
    assert (dashes[..., 0] == 1.0).all()
    assert (dashes[..., 1].min(), dashes[..., 1].max() <= 5.0) == (2.0, True)
    assert "ghosts" not in draw(View(), corners).lines


def test_a_scan_without_points_has_a_picture():
    empty = wall_ahead(lost=range(180))
    drawing = draw(View(), Recording.from_scans([empty]))
    assert len(drawing.points["points"].xyz) == 0
    assert np.isfinite(drawing.bounds).all()


def test_nothing_that_is_drawn_is_nan():
    lossy = wall_ahead(noise=0.02, lost=range(30, 60))
    recording = Recording.from_scans([lossy])
    found = findings(recording, 0, "region-growing", Params())
    for step in [None, *range(len(found.trace))]:
        drawing = picture(View(step=step, selected=40), recording, found, bounds_of(recording))
        for name, part in {**drawing.points, **drawing.lines}.items():
            assert np.isfinite(part.xyz).all(), (step, name)
            assert len(part.xyz) == len(part.colours), (step, name)


def test_a_refused_seed_shows_its_window_its_line_and_where_the_beam_meets_it():
    recording = Recording.from_scans([wall_ahead(bump={3: 0.2})])
    found = findings(recording, 0, "region-growing", Params())
    step = int(found.trace.indices("seed rejected")[0])
    decision = found.trace[step]
    drawing = draw(View(step=step), recording)
    assert len(drawing.points["window"].xyz) == 6
    assert len(drawing.lines["growing"].xyz) == 1
    assert len(drawing.lines["band"].xyz) == 2
    x, y, _ = drawing.points["predicted"].xyz[0]
    a, b, c = decision.line
    assert a * x + b * y + c == pytest.approx(0, abs=1e-6)
    assert np.arctan2(y, x) == pytest.approx(recording[0].bearings[decision.beam], abs=1e-6)
    assert np.hypot(*(drawing.points["candidate"].xyz[0, :2] - (x, y))) == pytest.approx(decision.value, abs=1e-5)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("3_collinear_overlap", "lines merged"), ("9_wide_corner", "lines kept apart"), ("9_wide_corner", "overlap cut")],
)
def test_two_lines_that_are_compared_are_drawn_as_they_were_and_their_merge_beside_them(name, kind):
    recording = open_recording(SAMPLE.parent / "lessons" / f"{name}.npz")
    found = findings(recording, 0, "region-growing", Params())
    (step,) = found.trace.indices(kind)
    drawn = draw(View(step=int(step)), recording).lines
    one, two = found.trace.lines_at(int(step) - 1)
    for line, (a, b, c) in (("first", one.line), ("other", two.line)):
        ends = drawn[line].xyz[0, :, :2]
        assert ends @ (a, b) + c == pytest.approx([0, 0], abs=1e-5), line
    assert ("growing" in drawn) == (kind == "lines merged")
    if kind == "lines merged":
        a, b, c = found.trace[int(step)].line
        assert drawn["growing"].xyz[0, :, :2] @ (a, b) + c == pytest.approx([0, 0], abs=1e-5)


def test_the_band_is_epsilon_wide_on_both_sides():
    recording = Recording.from_scans([wall_ahead(noise=0.004)])
    params = Params(epsilon=0.05, epsilon_growth=0.02)
    found = findings(recording, 0, "region-growing", params)
    step = int(found.trace.indices("point added")[5])
    xy = draw(View(step=step, params=params), recording).lines["band"].xyz[:, :, :2]
    a, b, c = found.trace[step].line
    ranges = np.linalg.norm(xy.mean(axis=0), axis=1)
    for distances in np.sort(xy @ (a, b) + c, axis=0):
        assert np.abs(distances) == pytest.approx(params.epsilon_at(ranges), abs=1e-6)


def test_true_walls_are_seen_from_the_laser():
    walls = np.array([[3.0, 0.0, 3.0, 2.0]])
    poses = np.array([[1.0, 1.0, np.pi / 2]])
    recording = Recording.from_scans([wall_ahead()], walls=walls, poses=poses)
    view = View()
    drawn = draw(replace(view, layers=replace(view.layers, truth=True)), recording).lines["truth"].xyz[0, :, :2]
    np.testing.assert_allclose(drawn, [[-1, -2], [1, -2]], atol=1e-6)


def test_bounds_hold_the_laser_and_are_not_widened_by_a_stray_point():
    near = [wall_ahead(2.0, noise=0.01, seed=k) for k in range(20)]
    stray = wall_ahead(2.0, bump={90: 500.0})
    x1, y1, x2, y2 = bounds_of(Recording.from_scans([*near, stray]))
    assert x1 < 0 < 2 < x2 < 3
    assert y1 < -1 < 1 < y2


@pytest.mark.parametrize(("wide", "spacing"), [(10, 1), (30, 5), (4, 0.5), (200, 20), (0.9, 0.1)])
def test_the_squares_of_the_grid_have_round_sides(wide, spacing):
    assert square_of((-1.0, 2.0, wide - 1.0, 2.5)) == pytest.approx(spacing)


def test_dashes_cover_half_of_a_line_and_stay_on_it():
    lines = dashed(np.array([[0.0, 0.0]]), np.array([[4.0, 0.0]]), 0.1, (0, 0, 0))
    lengths = lines.xyz[:, 1, 0] - lines.xyz[:, 0, 0]
    assert lengths.sum() == pytest.approx(2.0, abs=0.1)
    assert lines.xyz[..., 0].min() >= 0
    assert lines.xyz[..., 0].max() <= 4


def test_points_that_are_not_finite_are_left_out():
    kept = points_at([[0, 1], [np.nan, 0], [2, 3]], np.array([(1, 1, 1), (2, 2, 2), (3, 3, 3)], dtype=np.uint8))
    assert kept.colours[:, 0].tolist() == [1, 3]


def test_histograms_count_what_passed_and_what_failed():
    recording = Recording.from_scans([wall_ahead(noise=0.01, bump={90: 0.2})])
    found = findings(recording, 0, "region-growing", Params())
    epsilon = found.histograms["epsilon"]
    cut = int(np.log(0.03 / epsilon.low) / np.log(epsilon.high / epsilon.low) * BINS)
    assert sum(epsilon.passed[:cut]) > 50
    assert sum(epsilon.passed[cut + 1 :]) == 0
    assert sum(epsilon.failed[:cut]) == 0
    assert sum(epsilon.failed) > 0


def test_values_beyond_a_histogram_fall_into_its_ends():
    counted = histogram(np.array([0.0, 1e-9, 5.0, np.inf, np.nan]), np.array([]), 0.1, 1.0, log=True)
    assert (counted.passed[0], counted.passed[-1], sum(counted.passed)) == (2, 2, 4)


def test_line_colours_become_linear():
    greys = np.array([(0, 0, 0), (188, 188, 188), (255, 255, 255)], dtype=np.uint8)
    assert linear(greys)[:, 0].tolist() == [0, 128, 255]


def test_a_pinned_result_lies_under_the_present_one_and_what_changed_stands_out(corners):
    found = findings(corners, 0, "region-growing", Params())
    shortest = min(segment.length for segment in found.extraction.segments)
    other = findings(corners, 0, "region-growing", Params(min_length=shortest + 0.01))
    bands = picture(View(), corners, other, bounds_of(corners), pinned=found).lines["pinned"]
    fates = difference(found.extraction, other.extraction).fates_a
    assert len(bands.xyz) == len(fates)
    assert {KEPT, LOST} == set(fates.tolist())
    for colours, fate in zip(bands.colours, fates, strict=True):
        assert tuple(colours.reshape(-1, 3)[0].tolist()) == (LIGHT.pinned if fate == KEPT else LIGHT.changed)


def test_verdicts_replace_the_segments_only_on_request(corners):
    scan = corners[0]
    wall = np.where(np.arange(len(scan)) < len(scan) // 2, 0, 1)
    known = Recording.from_scans([replace(scan, wall=wall)])
    found = findings(known, 0, "region-growing", Params())
    verdict = judged(found)
    assert verdict is not None
    drawn = picture(View(layers=Layers(verdicts=True)), known, found, bounds_of(known), judged=verdict).lines
    assert "segments" not in drawn
    matched = verdict.matching.line_of >= 0
    assert len(drawn["matched"].xyz) == matched.sum() > 0
    # Taken for just short, a segment without a true line is no false one.
    for short in (False, True):
        none = replace(verdict.matching, shared=0 * verdict.matching.shared, neutral=np.full(len(matched), short))
        unmatched = verdict._replace(matching=none)
        lines = picture(View(layers=Layers(verdicts=True)), known, found, bounds_of(known), judged=unmatched).lines
        assert (len(lines["neither"].xyz) > 0, len(lines["false"].xyz) > 0) == (short, not short)
    assert "segments" in picture(View(), known, found, bounds_of(known), judged=verdict).lines
    assert judged(findings(corners, 0, "region-growing", Params())) is None


@pytest.mark.parametrize("method", list(EXTRACTORS))
def test_every_method_is_drawn_and_told_in_plain_numbers_at_every_step(method):
    recording, params = open_recording(SAMPLE), EXTRACTORS[method].params_type()
    found, bounds = findings(recording, 20, method, params), bounds_of(recording)
    for step in (None, *range(0, len(found.trace), 7)):
        view = View(recording="x", frame=20, method=method, params=params, step=step)
        drawn = picture(view, recording, found, bounds)
        assert all(np.isfinite(lines.xyz).all() for lines in drawn.lines.values())
        json.dumps(
            state_of(view, recording, "hallway", found, bounds, Reference.of("labels", recording, None), None),
            allow_nan=False,
        )


def test_the_line_that_a_refused_point_would_have_bent_to_itself_is_drawn_if_it_is_short():
    for beam, bent in ((6, True), (20, False)):
        walls = Recording.from_scans([wall_ahead(bump={beam: -0.06})])
        trace = findings(walls, 0, "region-growing", Params()).trace
        stop = next(each for each in trace if each.kind == "growth stopped" and each.beam == beam)
        assert ("bent" in draw(View(step=stop.index), walls).nodes) == bent
