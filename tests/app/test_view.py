"""The state of a tab, and how it changes."""

from __future__ import annotations

import pytest
from lineseg_app.view import View

from lineseg import Params


def test_a_patch_changes_what_it_names():
    view = View(recording="sample:hallway", frame=7).patched({"params": {"epsilon": 0.05}, "layers": {"grid": False}})
    assert (view.frame, view.params, view.layers.grid, view.layers.points) == (7, Params(epsilon=0.05), False, True)


def test_a_view_that_is_patched_with_another_becomes_that():
    other = View(recording="b", topic="/scan", frame=3, step=5, selected=9, params=Params(delta=0.2), dark=True)
    assert View(recording="a", frame=1).patched(other.as_json()) == other


def test_another_recording_starts_afresh_unless_the_patch_says_otherwise():
    view = View(recording="a", topic="/scan", frame=7, step=3, selected=1)
    assert view.patched({"recording": "b"}) == View(recording="b")
    assert view.patched({"recording": "b", "frame": 2}).frame == 2
    assert view.patched({"recording": "a"}) == view


def test_another_topic_starts_afresh():
    assert View(recording="a", frame=7, step=3).patched({"topic": "/rear"}) == View(recording="a", topic="/rear")


@pytest.mark.parametrize(
    ("patch", "named"),
    [
        ({"zoom": 1}, "zoom"),
        ({"method": "guessing"}, "guessing"),
        ({"params": {"gamma": 1}}, "gamma"),
        ({"params": {"epsilon": -1}}, "epsilon"),
        ({"layers": {"clouds": True}}, "clouds"),
    ],
)
def test_what_a_view_has_not_is_named(patch, named):
    with pytest.raises(ValueError, match=named):
        View().patched(patch)


def test_a_link_with_a_bad_value_keeps_the_rest_and_says_so():
    patch = {
        "params": {"epsilon": -1, "delta": 0.2},
        "frame": 7,
        "recording": "sample:laboratory",
        "layers": {"fog": True},
    }
    view, complaint = View(recording="sample:hallway").salvaged(patch)
    assert (view.recording, view.frame, view.params.delta, view.params.epsilon) == ("sample:laboratory", 7, 0.2, 0.03)
    assert complaint is not None and complaint.startswith("epsilon is -1")
    assert view.salvaged({"params": {"epsilon": 0.05}}) == (view.patched({"params": {"epsilon": 0.05}}), None)


def test_who_chooses_a_frame_or_a_step_follows_no_longer():
    view = View(recording="live:a", frame=5)
    assert view.patched({"params": {"epsilon": 0.05}, "frame": 5}).live
    assert not view.patched({"frame": 4}).live
    assert not view.patched({"step": 0}).live
    assert view.patched({"frame": 4, "live": True}).live
    assert view.patched({"frame": 4}).patched({"recording": "live:b"}).live
