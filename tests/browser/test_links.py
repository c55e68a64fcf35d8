"""Links, and what the page does with them."""

from __future__ import annotations

import pytest

NOTICE = ".notice-words:visible"


def test_a_link_without_weights_gives_the_defaults(new_tab):
    tab = new_tab("#mode=inspect&recording=sample:hallway&weights=gap:4")
    assert tab.until("s.weights.gap === 4")["weights"]["gap"] == 4
    tab.page.evaluate("location.hash = '#mode=inspect&recording=sample:hallway&frame=3'")
    assert tab.until("s.frame === 3")["weights"]["gap"] == 0
    tab.page.wait_for_function("!location.hash.includes('weights')")


def test_weights_set_back_to_their_defaults_leave_the_link(new_tab):
    tab = new_tab("#mode=inspect&score=suspicion&recording=sample:hallway&weights=gap:4")
    tab.page.get_by_role("tab", name="Frames").click()
    tab.page.locator(".weights-holder summary").click()
    slider = tab.page.locator(".weights input").first
    assert slider.get_attribute("max") == "10"
    tab.page.get_by_role("button", name="Default weights").click()
    tab.until("s.weights.gap === 0")
    tab.page.wait_for_function("!location.hash.includes('weights')")


@pytest.mark.parametrize(
    ("odd", "named"),
    [
        ("self=1", "self"),
        ("constructor=1&layers=constructor", "constructor"),
        ("step=9e99", "step"),
        ("beam=3000000000", "selected"),
        ("mode=zz", "mode"),
        ("method=zz", "method"),
        ("topic=" + "x" * 400, "topic"),
        ("weights=gap:11", "gap"),
        ("against=region-growing,epsilon:abc", "against"),
        ("epsilon=-1", "epsilon"),
    ],
)
def test_a_link_never_makes_the_page_unusable(new_tab, odd, named):
    tab = new_tab(f"#recording=sample:hallway&frame=3&{odd}")
    state = tab.until("s.frame === 3")
    assert (state["mode"], state["method"], state["selected"]) == ("tune", "region-growing", None)
    assert named in tab.page.locator(NOTICE).first.inner_text()
    tab.page.evaluate("location.hash = '#recording=sample:hallway&frame=4'")
    tab.until("s.frame === 4")
    tab.page.evaluate("(hash) => { location.hash = hash }", f"#recording=sample:hallway&frame=5&{odd}")
    tab.until("s.frame === 5")
    assert named in tab.page.locator(NOTICE).first.inner_text()


def test_a_link_to_a_lesson_that_is_gone_says_so_in_every_mode(new_tab):
    tab = new_tab("#recording=sample:hallway&frame=3&lesson=zz&page=2")
    assert tab.until("s.frame === 3")["segments"]
    tab.page.get_by_text("There is no lesson “zz”").locator("visible=true").first.wait_for()


def test_a_link_to_a_presenter_with_too_long_a_name_says_that_it_is_gone(new_tab):
    tab = new_tab("#follow=" + "a" * 100)
    assert tab.until("s.following === 'gone'")["segments"]


def test_a_very_long_link_does_not_break_the_page(new_tab):
    tab = new_tab("#recording=sample:hallway&frame=3&" + "&".join(f"a{k}=1" for k in range(20_000)))
    tab.until("s.frame === 3")


def test_a_new_field_needs_no_change_in_the_page(new_tab):
    tab = new_tab()
    told = tab.page.evaluate("""async () => {
        const { VIEW } = await import("/static/declared.js");
        const { Store } = await import("/static/view/store.js");
        const zoom = { name: "zoom", link: "zoom", written: "whole", default: 1, choices: [], most: 9, mirrored: true,
                       resetBy: ["recording"], lasting: true };
        const store = new Store([...VIEW, zoom]);
        const seen = [];
        store.onChange((view, patch) => seen.push([view.zoom, patch?.zoom ?? null]));
        store.read("#recording=sample:hallway&zoom=3");
        const linked = store.hash;
        store.change({ recording: "sample:laboratory" });
        store.read("#recording=sample:hallway&zoom=30");
        return { linked, seen, hash: store.hash };
    }""")
    assert told["linked"] == "recording=sample:hallway&zoom=3"
    assert told["seen"] == [[3, 3], [1, 1], [1, 30]]
    assert told["hash"] == "recording=sample:hallway"


@pytest.mark.own_tab
def test_a_link_to_a_missing_recording_shows_nothing_of_the_one_before(new_tab):
    tab = new_tab("#recording=sample:hallway")
    strip = tab.page.locator("#timeline canvas").first
    tab.eventually(strip.is_visible, "no strip")
    # Until the server has noticed that the page is gone, its session is given to no other.
    pupil = new_tab(tab.page.evaluate("new URL(lineseg.followLink).hash"))
    pupil.until("s.following === 'here'")
    tab.page.goto("about:blank")
    pupil.until("s.following === 'away'")
    tab.page.goto(f"{tab.address}#recording=sample:gone&name=gone.bag")
    tab.eventually(lambda: tab.page.locator(NOTICE).count(), "no notice")
    tab.eventually(lambda: not strip.is_visible(), "the strip of the recording before is shown")
    title, notice = (tab.page.locator(each).first.bounding_box() for each in (".empty > .empty-title", NOTICE))
    assert title["y"] >= notice["y"] + notice["height"]
