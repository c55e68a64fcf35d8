"""The part of the plan that shows a decision, and what is named in it."""

from __future__ import annotations

import numpy as np
import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.frame.framing import Framing, framing_of
from lineseg_app.places import data_folder

from lineseg import EXTRACTORS, Params, open_recording


def found(name: str, params: Params | None = None, method: str = "region-growing"):
    recording = open_recording(data_folder("sample_scans") / f"{name}.npz")
    return findings(recording, 0, method, params or EXTRACTORS[method].params_type())


def framing(finding, step: int) -> Framing:
    framed = framing_of(finding, step)
    assert framed is not None
    return framed


def drawn(framed: Framing, xy) -> np.ndarray:
    """Where points of the scan are drawn."""
    normal = np.array(framed.normal)
    aside = (np.asarray(xy) - framed.at) @ normal
    return xy + (framed.factor - 1) * aside[..., None] * normal


LESSONS = ["lessons/2_grazing_wall", "lessons/8_noise_burst", "lessons/9_wide_corner", "laboratory"]


@pytest.mark.parametrize("name", LESSONS)
def test_what_a_decision_compares_is_framed_and_named(name):
    finding = found(name, Params(max_occluder=0.0))
    for decision in finding.trace:
        framed = framing(finding, decision.index)
        x1, y1, x2, y2 = framed.box
        if decision.beam >= 0:
            x, y = drawn(framed, finding.scan.xy[decision.beam])
            assert x1 - 1e-9 <= x <= x2 + 1e-9 and y1 - 1e-9 <= y <= y2 + 1e-9
            assert any(str(decision.beam) in each.text and each.text.startswith("P,") for each in framed.names)
        lengths = [np.hypot(*np.subtract(each.end, each.start)) for each in framed.measures]
        if decision.beam >= 0 and decision.check == "epsilon":
            assert lengths == [pytest.approx(decision.value, abs=1e-9)]
        if decision.check == "delta" and lengths:
            assert lengths == [pytest.approx(decision.value, abs=1e-9), pytest.approx(decision.limit, abs=1e-9)]
        if decision.kind == "overlap cut":
            assert lengths == pytest.approx([decision.value, decision.limit])


def test_distances_across_the_line_are_exaggerated_and_the_line_stays():
    finding = found("lessons/2_grazing_wall", Params(max_occluder=0.0))
    (placed, *_) = finding.trace.indices("endpoints")[-1:]
    framed = framing(finding, placed)
    ends = np.reshape(finding.trace[placed].ends, (2, 2))
    assert framed.factor > 10
    assert drawn(framed, ends) == pytest.approx(ends, abs=1e-9)
    outermost = finding.scan.xy[[finding.trace[placed].first, finding.trace[placed].last]]
    aside = np.hypot(*(outermost - ends).T)
    assert np.hypot(*(drawn(framed, outermost) - ends).T) == pytest.approx(framed.factor * aside)


def test_the_points_stand_still_while_a_short_line_grows():
    finding = found("lessons/8_noise_burst", Params(max_occluder=0.0, seed_points=6))
    trace = finding.trace
    first = [k for k in range(len(trace)) if trace[k].candidate == 0 and trace[k].kind == "point added"]
    blocks = {framing(finding, k).at for k in first}
    assert len(first) > 30 and len(blocks) <= 4


@pytest.mark.parametrize("method", EXTRACTORS)
def test_decisions_of_every_method_are_framed(method):
    finding = found("laboratory", method=method)
    for step in range(0, len(finding.trace), 7):
        framed = framing_of(finding, step)
        assert framed is None or np.isfinite(framed.box).all()


@pytest.mark.parametrize("kind", ["growth stopped", "line kept"])
def test_where_a_line_has_points_of_the_one_before_it_the_end_of_that_one_is_named(kind):
    finding = found("lessons/9_wide_corner", Params(max_occluder=0.0))
    step = max(each.index for each in finding.trace if each.kind == kind and each.candidate == 1)
    before = finding.trace.lines_at(step)[0].last
    (name,) = [each for each in framing(finding, step).names if each.text.startswith("line before")]
    assert name.text == f"line before ends: {before}"
    assert name.at == pytest.approx(tuple(finding.scan.xy[before]))


def test_where_lines_share_no_points_the_end_of_the_one_before_is_not_named():
    finding = found("lessons/8_noise_burst", Params(max_occluder=0.0, merge_rms=0.0))
    for decision in finding.trace:
        assert not any(each.text.startswith("line before") for each in framing(finding, decision.index).names)
