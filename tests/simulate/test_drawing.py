"""Worlds drawn by hand, as text."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lineseg import extract
from lineseg.simulate.drawing import Drawing

ROOM = "w-3,-2,3,-2;w3,-2,3,2;w3,2,-3,2;w-3,2,-3,-2"


def test_the_scan_of_a_room_has_its_walls_and_their_truth():
    recording = Drawing.parse(f"l0.5,0,0;b-180,180,0.5,30,0;s0;{ROOM}").recording()
    (scan,) = recording
    assert len(scan) == 720
    assert scan.full_circle
    assert scan.wall is not None
    assert set(scan.wall.tolist()) == {0, 1, 2, 3}
    ahead = scan.ranges[np.argmin(np.abs(scan.bearings))]
    assert ahead == pytest.approx(2.5, abs=1e-6)
    assert len(extract(scan).segments) == 4


def test_the_pose_turns_and_moves_what_is_seen():
    straight, turned = (Drawing.parse(f"l{pose};b-90,90,1,30,0;{ROOM}").recording()[0] for pose in ("0,0,0", "0,0,90"))
    assert straight.ranges[90] == pytest.approx(3.0, abs=1e-6)
    assert turned.ranges[90] == pytest.approx(2.0, abs=1e-6)


def test_a_circle_is_seen_and_is_no_wall():
    scan = Drawing.parse("b-10,10,1,30,0;c4,0,1").recording()[0]
    assert scan.ranges[10] == pytest.approx(3.0, abs=1e-6)
    assert scan.wall is not None
    assert (scan.wall == -1).all()


def test_noise_depends_on_the_seed_only():
    first, again, other = (
        Drawing.parse(f"b-90,90,1,30,0.02;s{seed};{ROOM}").recording()[0].ranges for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("x1,2", "parts begin with l, b, s, w or c"),
        ("w1,2,3", "a wall needs x1,y1,x2,y2"),
        ("w1,2,1,2", "and a length"),
        ("w1,2,1,two", "write numbers after the letter"),
        ("w0,0,nan,1", "a wall needs"),
        ("w0,0,1e9,1", "within ±100 m"),
        ("c0,0,-1", "a radius above 0"),
        ("b0,10,0,30,0", "3 to 4000 beams"),
        ("b0,360,0.01,30,0", "3 to 4000 beams"),
        ("b0,720,1,30,0", "at most one turn"),
        ("s1.5", "a whole number"),
        (";".join(["w0,0,1,0"] * 81), "81 walls and 0 circles; at most 80 and 40 are allowed"),
    ],
)
def test_an_impossible_drawing_is_named(text, complaint):
    with pytest.raises(ValueError, match="the drawing") as raised:
        Drawing.parse(text)
    assert complaint in str(raised.value)


@given(st.text(alphabet="lbswc0123456789.,;-+einaf", max_size=60))
def test_any_text_is_a_drawing_or_a_clear_error(text):
    try:
        drawing = Drawing.parse(text)
    except ValueError as error:
        assert str(error).startswith("the drawing")
    else:
        assert len(drawing.recording()) == 1
