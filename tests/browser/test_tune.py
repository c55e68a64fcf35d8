"""Thresholds: dragged, set by keyboard, typed, undone, imported and exported."""

from __future__ import annotations

import threading

import pytest
from lineseg_app.session.session import Session
from waiting import SECONDS


def test_dragging_epsilon_changes_the_segments_before_the_button_is_released(tab):
    before = tab.state
    tab.drag("epsilon", by=-150)
    during = tab.until(f"s.params.epsilon < 0.02 && s.rev > {before['rev']}")
    assert during["segments"] != before["segments"]
    tab.page.mouse.up()
    assert tab.state["segments"] == during["segments"]


@pytest.mark.own_tab
def test_one_drag_is_one_step_of_undo(tab):
    before = tab.state
    tab.drag("epsilon", by=-120)
    tab.page.mouse.up()
    dragged = tab.until("s.params.epsilon < 0.025")
    tab.page.keyboard.press("Control+z")
    undone = tab.until("s.params.epsilon === 0.03")
    assert undone["segments"] == before["segments"]
    assert tab.page.get_by_role("button", name="Undo").is_disabled()
    tab.page.keyboard.press("Control+Shift+z")
    assert tab.until("s.params.epsilon !== 0.03")["params"] == dragged["params"]


def test_a_typed_value_is_taken_exactly(tab):
    tab.type_value("epsilon", "0.0425")
    assert tab.until("s.params.epsilon !== 0.03")["params"]["epsilon"] == 0.0425
    assert tab.slider("epsilon").get_attribute("aria-valuetext") == "0.0425 m"


@pytest.mark.parametrize(
    ("name", "typed", "expected"),
    [
        ("epsilon", "0.5x", "“0.5x” is not a number."),
        ("seed_points", "2", "Allowed: 3 to 1000; a seed needs 3 or more points"),
        ("min_points", "7.5", "Enter a whole number."),
        ("min_length", "-1", "Allowed: 0 to 1000 m"),
    ],
)
def test_an_invalid_typed_value_says_what_is_allowed_and_keeps_the_old_one(tab, name, typed, expected):
    before = tab.state
    tab.type_value(name, typed)
    row = tab.page.locator(f"[data-knob={name}]")
    assert expected in row.get_by_role("alert").inner_text()
    assert tab.state["params"] == before["params"]
    tab.field(name).press("Escape")
    assert float(tab.field(name).input_value()) == before["params"][name]


def test_the_keys_of_a_slider_step_page_and_end(tab):
    slider = tab.slider("min_points")
    slider.focus()
    for key, value in [("ArrowRight", 11), ("PageUp", 21), ("ArrowLeft", 20), ("Home", 3), ("End", 100)]:
        slider.press(key)
        tab.until(f"s.params.min_points === {value}")
    assert tab.state["frame"] == 0


def test_the_dot_resets_one_threshold_and_the_button_all(tab):
    tab.type_value("epsilon", "0.05")
    tab.type_value("delta", "0.2")
    tab.page.get_by_role("button", name="ε: Reset to 0.030 m").click()
    assert tab.until("s.params.epsilon === 0.03")["params"]["delta"] == 0.2
    tab.page.get_by_role("button", name="Reset all").click()
    tab.until("s.params.delta === 0.1")


def test_a_preset_sets_epsilon_and_its_growth_and_leaves_the_others(tab):
    tab.type_value("min_length", "0.8")
    tab.page.get_by_role("button", name="Preset").click()
    tab.page.get_by_role("menuitem", name="SICK LMS200").click()
    params = tab.until("s.params.epsilon === 0.02")["params"]
    assert (params["epsilon_growth"], params["min_length"]) == (0, 0.8)


def test_the_cut_of_a_histogram_stands_under_the_thumb(tab):
    box = tab.page.locator("[data-knob=epsilon] .histogram").bounding_box()
    cut = tab.page.locator("[data-knob=epsilon] .cut").bounding_box()
    place = tab.slider("epsilon").evaluate("(input) => input.valueAsNumber / input.max")
    assert cut["x"] == pytest.approx(box["x"] + place * box["width"], abs=1.5)


def test_parameters_are_exported_and_imported_again(tab):
    tab.type_value("epsilon", "0.07")
    tab.until("s.params.epsilon === 0.07")
    tab.page.get_by_role("button", name="Export").click()
    tab.page.get_by_role("menuitem", name="ROS 2 YAML").click()
    yaml = tab.page.locator("dialog pre").inner_text()
    assert "least_thresh: 0.07" in yaml
    tab.page.keyboard.press("Escape")
    tab.page.get_by_role("button", name="Reset all").click()
    tab.until("s.params.epsilon === 0.03")
    tab.drop("mine.yaml", yaml)
    tab.until("s.params.epsilon === 0.07")


def test_bad_parameters_are_refused_where_they_were_pasted(tab):
    tab.page.get_by_role("button", name="Export").click()
    tab.page.get_by_role("menuitem", name="Import parameters…").click()
    tab.page.get_by_role("textbox", name="Parameters").fill('{"epsilon": -1}')
    # The refusal is an answer of 400, which the browser notes on its console.
    tab.page.get_by_role("button", name="Apply").click()
    alert = tab.page.locator("dialog [role=alert]")
    alert.wait_for()
    assert "epsilon" in alert.inner_text()
    tab.forgive("400")


def test_segments_of_the_recording_are_downloaded(tab):
    tab.choose_recording("1 perfect corner")
    segments = tab.until("s.frames === 1")["segments"]
    tab.page.get_by_role("button", name="Export").click()
    with tab.page.expect_download() as download:
        tab.page.get_by_role("menuitem", name="JSON lines").click()
    (line,) = download.value.path().read_text().splitlines()
    assert line.count('"start"') == len(segments)


def test_each_stage_of_a_change_has_one_mark_and_marks_do_not_pile_up(tab):
    for epsilon in ("0.05", "0.06"):
        tab.type_value("epsilon", epsilon)
        tab.until(f"s.params.epsilon === {epsilon}")
    script = """() => {
        const marks = performance.getEntriesByType("mark").filter(({ name }) => name.startsWith("lineseg "));
        const { rev } = window.lineseg.state;
        return marks.filter(({ detail }) => detail === rev).map(({ name }) => name.slice(8)).sort().join(" ");
    }"""
    tab.eventually(lambda: tab.page.evaluate(script) == "answered changed sent shown", "not one mark of each stage")
    assert tab.page.evaluate("performance.getEntriesByType('mark').length") < 20


def test_scripts_hear_that_a_change_is_drawn_however_long_that_takes(tab, monkeypatch):
    go_on, paint = threading.Event(), Session._paint

    def held(session, *request):
        assert go_on.wait(SECONDS)
        return paint(session, *request)

    monkeypatch.setattr(Session, "_paint", held)
    tab.type_value("epsilon", "0.05")
    # The page itself waits for three seconds before it sends the next change anyway.
    tab.page.wait_for_timeout(4000)
    assert not tab.page.evaluate("window.lineseg.settled")
    go_on.set()
    assert tab.state["params"]["epsilon"] == 0.05
