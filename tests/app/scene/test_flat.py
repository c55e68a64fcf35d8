"""A Picture as it is told to a 2D canvas."""

from __future__ import annotations

import json

import numpy as np
from lineseg_app.frame.findings import findings
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.scene.flat import flat, shapes_of
from lineseg_app.scene.looks import CLOUDS, LINES, ORDER
from lineseg_app.scene.palette import DARK, LIGHT, NUMBERED, in_theme
from lineseg_app.scene.picture import picture
from lineseg_app.view import View
from scenes import corner

from lineseg import Recording
from lineseg.colours import SEGMENTS

CORNER = Recording.from_scans([corner(noise=0.006, seed=1)])


def drawn(view: View, **options):
    found = findings(CORNER, 0, view.method, view.params)
    return picture(view, CORNER, found, bounds_of(CORNER), **options)


def test_every_shape_has_a_look_and_a_place_in_the_order():
    assert sorted(ORDER) == sorted([*CLOUDS, *LINES])


def test_a_flat_picture_has_the_places_and_colours_of_the_picture():
    whole = drawn(View(step=8, selected=3))
    told = json.loads(json.dumps(flat(whole)))
    assert [node["name"] for node in told["nodes"]] == [name for name in ORDER if name in whole.nodes]
    for node in told["nodes"]:
        shape = whole.points[node["name"]] if node["kind"] == "points" else whole.lines[node["name"]]
        np.testing.assert_allclose(node["xy"], shape.xyz[..., :2].ravel(), atol=1e-5)
        colours = [told["palette"][tone] for tone in node["tones"]]
        assert colours == ["#{:02x}{:02x}{:02x}".format(*colour) for colour in shape.colours.tolist()]


def test_numbered_colours_stand_for_both_themes():
    assert not (set(map(tuple, SEGMENTS.tolist())) & set(vars(NUMBERED).values()))
    numbered = shapes_of(drawn(View(step=8), theme=NUMBERED))
    for dark, theme in ((False, LIGHT), (True, DARK)):
        for (name, _, both), (_, _, own) in zip(numbered, shapes_of(drawn(View(step=8, dark=dark))), strict=True):
            np.testing.assert_array_equal(in_theme(both, theme), own, err_msg=name)
