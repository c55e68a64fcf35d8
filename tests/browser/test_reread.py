"""Files that need help: what they were taken for is said, and the advice is followed where it is read."""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np
import pytest

CASES = Path(os.environ.get("LINESEG_DATA", "/nowhere")).parent / "cases"
needs_cases = pytest.mark.skipif(
    not CASES.is_dir(), reason="set LINESEG_DATA to a folder that has the folder cases beside it"
)


def long_lines(state: dict, least: float = 1.5) -> list[dict]:
    return [segment for segment in state["segments"] if segment["length"] >= least]


def room(beams: int, half: float = 2.0) -> np.ndarray:
    """Ranges [m] in a square room of 2·half, from −60° to 60°, with a millimetre of noise."""
    bearings = np.linspace(-np.pi / 3, np.pi / 3, beams)
    exact = half / np.maximum(np.abs(np.cos(bearings)), np.abs(np.sin(bearings)))
    return exact + np.random.default_rng(3).normal(0, 1e-3, beams)


@needs_cases
def test_a_finding_is_mended_by_one_click_and_undone(new_tab):
    tab = new_tab()
    tab.upload(CASES / "angles_in_degrees" / "run.bag")
    broken = tab.until('s.label === "run.bag"')
    assert len(long_lines(broken)) < 3
    card = tab.page.get_by_label("What this file was taken for")
    assert "more than a turn" in card.inner_text()
    card.get_by_role("button", name="Set unit of angles: deg").click()
    mended = tab.until('s.readAs.angle_unit === "deg"')
    assert len(long_lines(mended)) >= 3
    tab.eventually(lambda: "reading=angle_unit:deg" in tab.page.url, "the link says how the file is read")
    tab.page.keyboard.press("Control+z")
    tab.until("s.readAs.angle_unit === undefined")


def test_the_sentence_of_an_error_leads_to_the_panel_where_its_advice_is_followed(new_tab, tmp_path):
    file = tmp_path / "odd.csv"
    rows = [",".join(f"{each:.4f}" for each in room(97)) for _ in range(4)]
    file.write_text("\n".join(rows) + "\n")
    tab = new_tab()
    tab.upload(file)
    error = tab.page.locator(".notice.error")
    error.get_by_text("angle_increment").wait_for()
    error.get_by_role("button", name="Read as…").click()
    panel = tab.page.get_by_role("dialog")
    apply = panel.get_by_role("button", name="Apply")
    panel.locator("[data-field=angle_increment].named").wait_for()
    assert apply.is_disabled()
    assert panel.get_by_label("The first lines of the file").inner_text().startswith(rows[0][:40])
    panel.locator("[data-field=angle_min] input").fill("-60°")
    panel.locator("[data-field=angle_increment] input").fill("1.25°")
    panel.get_by_text(re.compile("4 scans × 97 beams.*−60…60°")).wait_for()
    apply.click()
    state = tab.until('s.label === "odd.csv"')
    assert max(segment["length"] for segment in state["segments"]) == pytest.approx(4.0, abs=0.15)


@needs_cases
def test_the_line_in_the_menu_leads_to_the_panel_which_is_cancelled_without_a_change(new_tab):
    tab = new_tab()
    tab.upload(CASES / "range_max_for_no_return" / "slightly_below.bag")
    before = tab.until('s.label === "slightly_below.bag"')
    tab.page.locator(".recording").click()
    assert "5 scans × 541 beams" in tab.page.locator(".menu:popover-open").inner_text()
    tab.page.get_by_role("menuitem", name="Change…").click()
    panel = tab.page.get_by_role("dialog")
    panel.get_by_role("button", name="Set no return: 9.99").click()
    tab.eventually(lambda: panel.locator("[data-field=no_return] input").input_value() == "9.99", "it is filled in")
    panel.get_by_role("button", name="Cancel").click()
    assert tab.state["place"] == before["place"]


@needs_cases
def test_parts_of_a_split_bag_that_are_dropped_together_are_one_recording(new_tab):
    tab = new_tab()
    folder = CASES / "split_bag_dropped" / "run"
    tab.upload(*sorted(folder.iterdir()))
    assert tab.until('s.label === "run"')["frames"] == 5
    tab.upload(*sorted(folder.glob("*.db3")))
    tab.until('s.label === "run"')
