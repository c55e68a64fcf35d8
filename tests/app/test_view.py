"""The state of a tab, and how it changes."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated

import pytest
from lineseg_app.session.following import mirrored
from lineseg_app.view import MOST_WEIGHT, Against, Layers, View
from lineseg_app.view_field import EACH, ViewField, field_entries, patch_of, view_fields
from pydantic import Field, ValidationError

from lineseg import Params
from lineseg.readers import Reading

OF_EACH_OTHER = View(
    mode="inspect", recording="c", topic="/rear", reading=Reading(unit="mm"), frame=2, method="region-growing",
    params=Params(epsilon=0.05), step=1, selected=4, beside=9, camera="free", score="gap",
    against=Against("region-growing", Params()), weights=(("gap", 4.0),), reference="wall", layers=Layers(grid=False),
    speed="2", space="world", past="10", ride="on", live=False, dark=True,
)  # fmt: skip
LINK_KEYS = {
    "mode", "recording", "topic", "reading", "frame", "method", "step", "beam", "beside", "camera", "score", "against",
    "weights", "reference", "layers", "speed", "closeup", "lesson", "page", "space", "past", "ride", EACH,
}  # fmt: skip


@dataclass(frozen=True)
class Zoomed(View):
    """A View with one additional field, declared only here."""

    zoom: Annotated[int, Field(ge=1, le=9), ViewField(link="zoom", mirrored=True, reset_by=("recording",))] = 1


def test_a_patch_changes_what_it_names():
    view = View(recording="sample:hallway", frame=7).patched({"params": {"epsilon": 0.05}, "layers": {"grid": False}})
    assert (view.frame, view.params, view.layers.grid, view.layers.points) == (7, Params(epsilon=0.05), False, True)


def test_a_view_patched_with_another_becomes_the_other():
    other = View(recording="b", topic="/scan", frame=3, step=5, selected=9, params=Params(delta=0.2), dark=True)
    assert View(recording="a", frame=1).patched(other.as_json()) == other
    assert other.patched(OF_EACH_OTHER.as_json()) == OF_EACH_OTHER


def test_another_recording_resets_the_view_unless_the_patch_says_otherwise():
    view = View(recording="a", topic="/scan", frame=7, step=3, selected=1)
    assert view.patched({"recording": "b"}) == View(recording="b")
    assert view.patched({"recording": "b", "frame": 2}).frame == 2
    assert view.patched({"recording": "a"}) == view


def test_another_topic_resets_the_view():
    view = View(recording="a", reading=Reading(unit="mm"), frame=7, step=3)
    assert view.patched({"topic": "/rear"}) == View(recording="a", topic="/rear")


def test_another_reading_is_of_another_place_and_begins_at_its_first_frame():
    view = View(recording="a", topic="/rear", frame=7)
    reread = view.patched({"reading": {"unit": "mm"}})
    assert (reread.frame, reread.read_as) == (0, Reading(topic="/rear", unit="mm"))
    assert reread.place != view.place == view.patched({"frame": 3}).place
    assert reread.patched({"reading": {"unit": None}, "frame": 7}) == view


def test_a_link_gives_numbers_of_a_reading_as_text_and_its_valid_part_is_kept():
    said = {"reading": {"every_beam": "2", "frame_id": "2", "unit": "furlong", "angle_min": "-1.5", "speed": "3"}}
    view, complaint = View().salvaged(said)
    assert view.reading == Reading(every_beam=2, frame_id="2", angle_min=-1.5)
    assert "furlong" in str(complaint)
    assert "speed" in str(complaint)


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
def test_an_unknown_field_of_a_view_is_named(patch, named):
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


def test_choosing_a_frame_or_a_step_stops_following():
    view = View(recording="live:a", frame=5)
    assert view.patched({"params": {"epsilon": 0.05}, "frame": 5}).live
    assert not view.patched({"frame": 4}).live
    assert not view.patched({"step": 0}).live
    assert view.patched({"frame": 4, "live": True}).live
    assert view.patched({"frame": 4}).patched({"recording": "live:b"}).live


def test_every_field_is_the_presenters_or_the_followers_own():
    follower = mirrored(View(), OF_EACH_OTHER)
    for name in (entry.name for entry in fields(View)):
        own, shown = getattr(View(), name), getattr(OF_EACH_OTHER, name)
        assert getattr(follower, name) == (shown if view_fields(View)[name].mirrored else own)
    kept = {name for name, entry in view_fields(View).items() if not entry.mirrored}
    assert kept == {"dark", "camera", "layers", "speed"}


def test_every_field_has_a_key_in_the_link_or_says_that_it_has_none():
    keys = [entry.link for entry in view_fields(View).values() if entry.link is not None]
    assert set(keys) == LINK_KEYS
    assert len(keys) == len(LINK_KEYS)
    assert {name for name, entry in view_fields(View).items() if entry.link is None} == {"live", "dark"}


def test_a_field_is_declared_after_those_that_reset_it_or_switch_it_off():
    names = list(view_fields(View))
    for place, entry in enumerate(view_fields(View).values()):
        assert set(names[:place]) >= {*entry.reset_by, *entry.off_by}


def test_a_new_field_is_declared_in_one_place():
    view = Zoomed(recording="a").patched({"zoom": 3})
    assert view == Zoomed(recording="a", zoom=3)
    assert view.patched({"recording": "b"}) == Zoomed(recording="b")
    assert view.as_json()["zoom"] == 3
    assert mirrored(Zoomed(dark=True), view) == Zoomed(recording="a", zoom=3, dark=True)
    with pytest.raises(ValidationError, match="zoom"):
        patch_of(Zoomed).model_validate({"zoom": 10})
    assert view.salvaged({"zoom": "x", "frame": 3})[0].frame == 3
    entry = field_entries(Zoomed)[-1]
    assert (entry.name, entry.link, entry.written, entry.default, entry.most) == ("zoom", "zoom", "whole", 1, 9)


def test_a_field_without_a_declaration_is_refused():
    @dataclass(frozen=True)
    class Careless(View):
        zoom: int = 1

    with pytest.raises(TypeError, match=r"Careless\.zoom"):
        view_fields(Careless)


def test_the_greatest_weight_is_told_to_the_page():
    entry = next(entry for entry in field_entries(View) if entry.name == "weights")
    assert entry.most == MOST_WEIGHT
    assert View().patched({"weights": {"gap": MOST_WEIGHT}}).weights == (("gap", MOST_WEIGHT),)
    with pytest.raises(ValueError, match="gap"):
        View().patched({"weights": {"gap": MOST_WEIGHT + 1}})


def test_a_view_says_all_its_weights_so_that_it_replaces_changed_ones():
    assert View(weights=(("gap", 4.0),)).patched(View(recording="a").as_json()) == View(recording="a")


@pytest.mark.parametrize(
    ("said", "named"),
    [
        ({"params": {"self": 1}}, "self"),
        ({"layers": {"self": True}}, "self"),
        ({"weights": {"self": 1}}, "self"),
        ({"against": {"method": "region-growing", "params": {"self": 1}}}, "self"),
        ({"self": 1}, "self"),
        ({"params": {"epsilon": 10**400}}, "epsilon"),
        ({"params": 7}, "params"),
        ({"params": {"epsilon": "abc"}}, "epsilon"),
        ({"against": {}}, "against"),
        ({"against": "nothing"}, "against"),
        ({"topic": "x" * 400}, "topic"),
        ({"topic": ["x"]}, "topic"),
        ({"step": 9e99}, "step"),
        ({"selected": 3_000_000_000}, "selected"),
        ({"mode": "zz"}, "mode"),
        ({"x" * 5000: 1}, "xxx"),
    ],
)
def test_a_link_is_applied_as_far_as_possible_and_the_rest_is_reported(said, named):
    view, complaint = View().salvaged(said | {"frame": 7})
    assert view == View().patched({"frame": 7})
    assert complaint is not None
    assert named in complaint
    assert len(complaint) < 400


def test_only_the_first_of_many_complaints_are_reported():
    _, complaint = View().salvaged({"params": {f"zoom{k}": 1 for k in range(9)}})
    assert complaint is not None
    assert complaint.endswith("; and 6 more")


def test_a_threshold_that_is_no_number_is_told_in_words():
    assert View().salvaged({"params": {"epsilon": "on"}})[1] == "params.epsilon is 'on': it must be a number"


@pytest.mark.parametrize("topic", ["", "  "])
def test_an_empty_topic_of_a_link_is_none_and_the_rest_of_the_link_counts(topic: str):
    view, complaint = View(recording="sample:hallway").salvaged({"topic": topic, "frame": 16})
    assert (view.topic, view.frame, complaint) == (None, 16, None)
    assert view.read_as.topic is None
