"""The window: its parts dragged to size and hidden, narrow and wide."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from browser.conftest import Tab
from playwright.sync_api import ViewportSize

pytestmark = pytest.mark.own_tab
GRIP = ".divider-grip >> nth=0"
# Parts that stand out of the window, and rows that are wider than the place they have.
PARTS = "#topbar > *, #timeline > *, #status > *, #stage, #replay, #panel .tab"
CUT_OFF = """(parts) => [...document.querySelectorAll(parts)]
    .filter((part) => part.checkVisibility() && !part.matches(".off-screen"))
    .filter((part) => {
        const { left, right, top, bottom } = part.getBoundingClientRect();
        return left < -0.5 || right > innerWidth + 0.5 || top < -0.5 || bottom > innerHeight + 0.5;
    })
    .map((part) => part.id || part.className)"""


def width(tab: Tab) -> float:
    return tab.page.locator("#panel").evaluate("(panel) => panel.getBoundingClientRect().width")


def test_the_panel_is_dragged_to_a_width_that_a_new_page_has_too(new_tab: Callable[..., Tab]):
    tab = new_tab()
    usual = width(tab)
    box = tab.page.locator(GRIP).bounding_box()
    assert box is not None
    tab.page.mouse.move(box["x"] + 5, box["y"] + 200)
    tab.page.mouse.down()
    # Over the scene, whose frame would take the pointer.
    tab.page.mouse.move(box["x"] - 115, box["y"] + 220, steps=4)
    tab.page.mouse.up()
    tab.eventually(lambda: abs(width(tab) - usual - 120) < 2, "the panel is as wide as before")
    tab.page.reload()
    tab.until("true")
    tab.eventually(lambda: abs(width(tab) - usual - 120) < 2, "the width was forgotten")
    tab.page.locator(GRIP).dblclick(position={"x": 5, "y": 100})
    tab.eventually(lambda: width(tab) == usual, "a double click gives no usual width")
    tab.page.locator(GRIP).press("Enter")
    tab.eventually(lambda: not tab.page.locator("#panel").is_visible(), "the panel is not hidden")
    tab.page.keyboard.press("p")
    tab.eventually(lambda: tab.page.locator("#panel").is_visible(), "the panel does not come back")


def test_at_every_width_nothing_is_cut_off_and_the_view_fits(new_tab: Callable[..., Tab]):
    tab = new_tab("#recording=sample:hallway")
    x1, y1, x2, y2 = tab.state["bounds"]
    inside = f"""() => [[{x1}, {y1}], [{x2}, {y2}]].every(([x, y]) => {{
        const at = lineseg.project(x, y);
        return at && at[0] > 0 && at[1] > 0 && at[0] < stage.clientWidth && at[1] < stage.clientHeight;
    }})"""
    for wide, high in (2560, 1080), (1024, 700), (820, 1180), (480, 800):
        tab.page.set_viewport_size(ViewportSize(width=wide, height=high))
        tab.eventually(
            lambda: tab.page.evaluate(CUT_OFF, PARTS) == [],
            f"cut off at {wide} px: {tab.page.evaluate(CUT_OFF, PARTS)}",
        )
        tab.eventually(lambda: tab.page.evaluate(inside), f"the view does not fit at {wide} px")
    assert tab.page.evaluate("() => stage.getBoundingClientRect().bottom <= panel.getBoundingClientRect().top + 1")
