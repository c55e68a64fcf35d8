"""The menu of methods: each has its own sliders, segments, replay and link."""

from __future__ import annotations

from pathlib import Path

import pytest

from lineseg import EXTRACTORS, open_recording

SAMPLE = Path(__file__).parents[2] / "sample_scans" / "hallway.npz"
FRAME = 20


def shown(state):
    return [(each["first"], each["last"]) for each in state["segments"]]


def found(method, params):
    segments = EXTRACTORS[method].extract(open_recording(SAMPLE)[FRAME], params).segments
    return [(each.first, each.last) for each in segments]


def test_the_menu_offers_every_method_with_its_own_thresholds_and_segments(new_tab):
    tab = new_tab(f"#frame={FRAME}")
    menu = tab.page.get_by_label("Method", exact=True)
    offered = menu.locator("option").evaluate_all("(options) => options.map((option) => option.value)")
    assert offered == list(EXTRACTORS)
    for method in reversed(offered):
        menu.select_option(method)
        state = tab.until(f"s.method === {method!r}")
        params = EXTRACTORS[method].params_type()
        rows = tab.page.locator("[data-knob]").evaluate_all("(rows) => rows.map((row) => row.dataset.knob)")
        assert sorted(rows) == sorted(params.numbers()), method
        assert shown(state) == found(method, params), method


@pytest.mark.parametrize(
    ("method", "name", "value"),
    [("hough", "rho_step", 0.1), ("line-tracking", "epsilon", 0.06), ("authors", "epsilon", 0.02)],
)
def test_a_threshold_of_another_method_is_set_undone_and_kept_in_the_link(new_tab, method, name, value):
    tab = new_tab(f"#frame={FRAME}")
    tab.page.get_by_label("Method", exact=True).select_option(method)
    tab.until(f"s.method === {method!r}")
    tab.type_value(name, str(value))
    state = tab.until(f"s.params.{name} === {value}")
    params = EXTRACTORS[method].params_type().but(**{name: value})
    assert shown(state) == found(method, params)
    tab.page.wait_for_function("(part) => location.hash.includes(part)", arg=f"{name}={value}")
    link = tab.page.evaluate("location.hash")
    assert f"method={method}" in link

    other = new_tab(link)
    state = other.until(f"s.method === {method!r}")
    assert (state["params"], state["frame"]) == (params.numbers(), FRAME)
    assert shown(state) == found(method, params)
    tab.page.locator("body").press("Control+z")
    tab.until(f"s.params.{name} === {EXTRACTORS[method].params_type().numbers()[name]}")


def test_a_replay_of_another_method_goes_from_its_first_decision_to_its_last(new_tab):
    tab = new_tab(f"#frame={FRAME}&method=ransac")
    trace = EXTRACTORS["ransac"].trace(open_recording(SAMPLE)[FRAME], EXTRACTORS["ransac"].params_type())
    tab.page.get_by_role("button", name="Replay this frame").click()
    for step, decision in enumerate(trace):
        state = tab.until(f"s.step === {step}")
        assert state["decision"]["text"] == decision.text
        tab.page.keyboard.press("ArrowRight")
    tab.until(f"s.step === {len(trace) - 1}")


@pytest.mark.own_tab
def test_a_link_to_an_unknown_method_says_so(new_tab):
    tab = new_tab("#method=guessing")
    tab.page.get_by_text("guessing").wait_for()
    assert tab.state["method"] == "region-growing"
