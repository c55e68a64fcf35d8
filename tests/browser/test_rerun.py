"""The tab Rerun, and the export beside it, in a real browser."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from rrd import rows_of

if TYPE_CHECKING:
    from .conftest import Tab


def test_the_tab_shows_the_recording_and_its_cursor_and_the_pages_frame_follow_each_other(tab: Tab):
    page = tab.page
    page.set_viewport_size({"width": 900, "height": 600})
    page.get_by_role("button", name="Rerun", exact=True).click()
    follows = page.get_by_text("lineseg shows the frame at the cursor")
    follows.wait_for()
    page.wait_for_function("() => window.lineseg.rerunFrame === window.lineseg.state.frame")

    page.keyboard.press("ArrowRight")
    together = "(at) => window.lineseg.state.frame === at && window.lineseg.rerunFrame === at"
    page.wait_for_function(together, arg=1)
    (frame,) = [frame for frame in page.frames if frame.url.endswith("/rerun/")]
    canvas = frame.locator("canvas")

    def viewer_steps() -> bool:
        # A key is lost on a viewer that still draws.
        canvas.click(position={"x": 200, "y": 200})
        canvas.press("ArrowRight")
        page.wait_for_timeout(1000)
        return page.evaluate("() => window.lineseg.rerunFrame > 1 && window.lineseg.state.frame > 1")

    tab.eventually(viewer_steps, "the viewer takes no keys")
    page.wait_for_function("() => window.lineseg.state.frame === window.lineseg.rerunFrame")

    tab.type_value("epsilon", "0.05")
    page.get_by_text("The thresholds have changed").wait_for()
    page.get_by_role("button", name="Record again").wait_for()
    page.get_by_role("button", name="Back to the scene").click()
    follows.wait_for(state="hidden")

    # A replay is shown in the scene, not under the viewer.
    page.get_by_role("button", name="Rerun", exact=True).click()
    back = page.get_by_role("button", name="Back to the scene")
    back.wait_for()
    page.get_by_role("button", name="Replay this frame").click()
    back.wait_for(state="hidden")
    # Every complaint of the tab, foreign requests among them, is looked at when it closes.


def test_all_frames_are_exported_as_a_recording_that_rerun_reads(tab: Tab, tmp_path: Path):
    page = tab.page
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="All frames (.rrd)").click()
    assert re.fullmatch(r"[\w.-]+\.rrd", download.value.suggested_filename)
    download.value.save_as(tmp_path / "run.rrd")
    frames = [row["frame"] for row in rows_of(tmp_path / "run.rrd", "/laser/points") if row.get("frame") is not None]
    assert frames == list(range(tab.state["frames"]))


@pytest.mark.own_tab
def test_a_browser_that_cannot_draw_is_told_so_and_offered_the_download(new_tab: Callable[..., Tab]):
    tab = new_tab()
    assert tab.scene, "the scene itself must have its canvas before they are taken away"
    tab.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null; delete Navigator.prototype.gpu;")
    tab.page.get_by_role("button", name="Rerun", exact=True).click()
    tab.page.get_by_text("needs WebGL 2 or WebGPU").wait_for()
    assert tab.page.get_by_role("link", name="Download").get_attribute("href")
