"""A world drawn by hand: dragged, typed, undone, linked, saved."""

from __future__ import annotations

import numpy as np
import pytest

from lineseg import extract, open_recording
from lineseg.simulate.drawing import Drawing

WALL = '.draw-handle[aria-label="Wall 1"]'


def drawing_of(state: dict) -> Drawing:
    return Drawing.parse(state["recording"].removeprefix("drawn:"))


def expected(state: dict) -> list[tuple[int, int]]:
    return [(line.first, line.last) for line in extract(drawing_of(state).recording()[0]).segments]


@pytest.fixture
def drawing(new_tab):
    tab = new_tab("#mode=learn")
    tab.page.get_by_role("button", name="Draw your own world").click()
    tab.until("s.recording.startsWith('drawn:')")
    tab.page.locator(WALL).wait_for()
    return tab


def test_scan_and_lines_follow_a_wall_under_the_hand(drawing):
    before = drawing.state
    assert [(line["first"], line["last"]) for line in before["segments"]] == expected(before)
    box = drawing.page.locator(WALL).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    drawing.page.mouse.move(x, y)
    drawing.page.mouse.down()
    drawing.page.mouse.move(x + 10, y + 30, steps=5)
    during = drawing.until(f"s.recording !== {before['recording']!r}")
    drawing.page.mouse.up()
    after = drawing.until("true")
    assert [(line["first"], line["last"]) for line in after["segments"]] == expected(after)
    assert drawing_of(after).walls[0][1] < drawing_of(before).walls[0][1]
    assert during["steps"] > 0
    drawing.page.keyboard.press("Control+z")
    assert drawing_of(drawing.until(f"s.recording === {before['recording']!r}")) == drawing_of(before)
    drawing.page.keyboard.press("Control+Shift+z")
    drawing.until(f"s.recording === {after['recording']!r}")


def test_the_laser_moves_and_the_world_keeps_its_place(drawing):
    before = drawing.state
    place = drawing.page.locator(WALL).bounding_box()
    laser = drawing.page.locator('.draw-handle[aria-label="Laser"]')
    laser.focus()
    laser.press("Shift+ArrowLeft")
    after = drawing.until(f"s.recording !== {before['recording']!r}")
    assert drawing_of(after).pose == (-0.5, 0.0, 0.0)
    drawing.eventually(
        lambda: drawing.page.locator(WALL).bounding_box()["x"] == pytest.approx(place["x"], abs=1.0),
        "the wall moved on the screen",
    )


def test_a_world_is_edited_by_typing_and_grows_and_shrinks(drawing):
    walls = len(drawing_of(drawing.state).walls)
    drawing.page.get_by_role("button", name="Add wall").click()
    state = drawing.until("true")
    assert len(drawing_of(state).walls) == walls + 1
    drawing.page.get_by_role("button", name="Add circle").click()
    drawing.page.get_by_label("radius [m]").fill("0.7")
    drawing.page.get_by_label("radius [m]").press("Enter")
    state = drawing.until("s.recording.includes(',0.7;')")
    assert drawing_of(state).circles[-1][2] == 0.7
    drawing.page.get_by_label("step [°]").fill("2")
    drawing.page.get_by_label("step [°]").press("Enter")
    assert drawing.until("s.beams === 136")["segments"] is not None
    drawing.page.locator('.draw-handle[aria-label="Circle 2"]').focus()
    drawing.page.keyboard.press("Delete")
    assert len(drawing_of(drawing.until("s.beams === 136 && !s.recording.includes(',0.7;')")).circles) == 1


def test_a_drawing_survives_a_reload_and_becomes_a_file_with_truth(drawing, tmp_path):
    drawing.page.locator(WALL).focus()
    drawing.page.keyboard.press("ArrowUp")
    state = drawing.until("s.recording.includes('2.05')")
    drawing.page.wait_for_function("location.hash.includes('2.05')")
    drawing.page.reload()
    assert drawing.until("s.recording.includes('2.05')")["segments"] == state["segments"]
    with drawing.page.expect_download() as saved:
        drawing.page.get_by_role("button", name="Save as NPZ").click()
    saved.value.save_as(tmp_path / "mine.npz")
    (mine,), (scan,) = open_recording(tmp_path / "mine.npz"), drawing_of(state).recording()
    np.testing.assert_array_equal(mine.ranges, scan.ranges)
    np.testing.assert_array_equal(mine.wall, scan.wall)


@pytest.mark.own_tab
def test_a_link_to_an_invalid_world_says_why(new_tab):
    tab = new_tab("#recording=drawn:w1,2,3")
    alert = tab.page.get_by_role("alert").filter(has_text="a wall needs x1,y1,x2,y2")
    tab.eventually(alert.is_visible, "the broken drawing is not named")
    assert tab.state["recording"].startswith("sample:")
