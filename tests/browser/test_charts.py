"""Charts name their scales and the value at the pointer; the truth is told where it is known."""

from __future__ import annotations

import numpy as np
from lineseg_app.places import data_folder

from lineseg import agreements, open_recording

SAMPLES = data_folder("sample_scans")


def test_the_truth_of_a_frame_is_told_and_shown_in_the_scene(new_tab):
    recording = open_recording(SAMPLES / "hallway.npz")
    tab = new_tab("#frame=39&reference=wall")
    figures = tab.page.locator(".truth-figures")
    (told,) = agreements(recording.only(np.array([39])))
    wanted = f"TR {told.true_rate:.0%} · FR {told.false_rate:.0%}".replace("%", " %")
    tab.eventually(lambda: figures.inner_text().startswith(wanted), f"not {wanted}")
    figures.click()
    tab.until("s.layers.verdicts && s.agreement !== null")
    tab.eventually(lambda: figures.get_attribute("aria-pressed") == "true", "the button is not pressed")


def test_a_histogram_names_its_ends_and_what_is_counted_at_the_pointer(new_tab):
    tab = new_tab("#frame=39")
    row = tab.page.locator("[data-knob=epsilon]")
    tab.eventually(lambda: row.get_attribute("data-low") == "0.005", "the low end has no name")
    tab.eventually(lambda: row.get_attribute("data-high") == "0.500 m", "the high end has no name")
    row.locator(".histogram-holder").hover(position={"x": 4, "y": 8})
    tip = tab.page.locator(".tooltip")
    tab.eventually(lambda: "At the pointer, 0.005 – 0.0061 m:" in tip.inner_text(), "no value at the pointer")


def test_the_range_of_scores_is_of_one_score(new_tab):
    tab = new_tab("#mode=inspect&score=coverage")
    low = tab.page.get_by_label("Show only frames with this score from")
    low.fill("0.96")
    low.press("Enter")
    tab.eventually(lambda: "of 300" in tab.page.locator(".frames-count").inner_text(), "no frame is left out")
    tab.page.get_by_label("Sorted by").select_option("segments")
    tab.until("s.score === 'segments'")
    tab.eventually(lambda: tab.page.locator(".frames-count").inner_text() == "300 frames", "the range stays")
    tab.eventually(lambda: low.input_value() == "", "the field keeps its value")
