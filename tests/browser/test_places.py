"""Navigation: frames, decisions, recordings, tabs, links, connections."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from browser.test_learn_scene import expected_at
from waiting import SECONDS

from lineseg import open_recording, trace

SAMPLES = Path(__file__).parents[2] / "sample_scans"


def seen(state: dict) -> dict:
    """The visible part of a state, without its timings and revision."""
    timings = {"rev", "latencyMs", "extractionUs", "pictureMs", "drawMs"}
    return {name: value for name, value in state.items() if name not in timings}


def test_the_scrubber_the_number_and_the_keys_move_through_the_frames(tab):
    track = tab.page.locator("#timeline input[type=range]")
    box = track.bounding_box()
    tab.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    state = tab.until("s.frame > 100")
    assert abs(state["frame"] - state["frames"] / 2) < 5
    number = tab.page.locator("#timeline input.number")
    number.fill("7")
    number.press("Enter")
    number.press("Escape")
    tab.until("s.frame === 7")
    tab.page.keyboard.press("ArrowRight")
    tab.until("s.frame === 8")
    tab.page.keyboard.press("End")
    tab.until("s.frame === s.frames - 1")
    tab.page.keyboard.press("Home")
    tab.until("s.frame === 0")


def test_a_frame_that_does_not_exist_is_refused_at_the_number(tab):
    number = tab.page.locator("#timeline input.number")
    number.fill("300")
    number.press("Enter")
    assert tab.page.locator("#timeline").get_by_role("alert").inner_text() == "Enter 0 to 299."
    assert tab.state["frame"] == 0


def test_space_plays_and_stops(tab):
    tab.page.keyboard.press("Space")
    tab.page.get_by_role("button", name="Pause (Space)").wait_for()
    tab.until("s.frame >= 3")
    tab.page.keyboard.press("Space")
    tab.page.get_by_role("button", name="Play (Space)").first.wait_for()
    stopped = tab.state["frame"]
    tab.page.keyboard.press("ArrowLeft")
    tab.until(f"s.frame === {stopped - 1}")


def test_replay_forward_and_back_returns_to_the_same_state_and_picture(tab):
    tab.choose_recording("1 perfect corner")
    tab.until("s.frames === 1")
    tab.page.keyboard.press("r")
    tab.until("s.step === 0")
    tab.page.keyboard.press("n")
    there = tab.until("s.step > 0")
    assert there["decision"]["kind"] == "line kept"
    scan = open_recording(SAMPLES / "lessons" / "1_perfect_corner.npz")[0]
    picture = at_rest(tab, expected_at(scan, trace(scan), trace(scan)[there["step"]])["exactly"]["segments"])
    for _ in range(5):
        tab.page.keyboard.press("ArrowLeft")
    tab.until(f"s.step === {there['step'] - 5}")
    drawn_when(tab, lambda now: now != picture)
    for _ in range(5):
        tab.page.keyboard.press("ArrowRight")
    back = tab.until(f"s.step === {there['step']}")
    assert seen(back) == seen(there)
    drawn_when(tab, lambda now: now == picture)


def drawn(tab) -> dict:
    """What viser draws: points and colours of each visible node."""
    return tab.scene.evaluate(
        """() => Object.fromEntries(Object.entries(window.__viserSceneTree.getState())
            .filter(([, node]) => node?.effectiveVisibility && node.message.props.points)
            .map(([name, node]) => [name, [node.message.props.points.join(), node.message.props.colors.join()]]))"""
    )


def at_rest(tab, lines: list[float]) -> dict:
    """What is drawn once it has these lines and ten checks in a row agree: the status may be ahead of the scene."""
    looks: list[dict] = []

    def same() -> bool:
        looks.append(drawn(tab))
        points = looks[-1].get("/seen/segments", [""])[0].split(",")
        there = [float(each) for k, each in enumerate(points) if each and k % 3 < 2]
        if there != pytest.approx(lines, abs=1e-4):
            looks.clear()
        return len(looks) > 10 and all(look == looks[-1] for look in looks[-10:])

    tab.eventually(same, "the scene never comes to rest")
    return looks[-1]


def drawn_when(tab, condition) -> dict:
    return tab.eventually(lambda: (now := drawn(tab)) and condition(now) and now, "the scene does not follow")


def test_the_replay_says_each_decision_and_jumps_to_the_next_of_a_kind(tab):
    tab.page.get_by_role("button", name="Replay this frame").click()
    first = tab.until("s.step === 0")
    assert tab.page.locator("#replay .decision").inner_text() == first["decision"]["text"]
    tab.page.get_by_role("button", name="Next seed").click()
    assert tab.until("s.step > 0")["decision"]["kind"] == "seed found"
    tab.page.get_by_role("button", name="Next drop").click()
    tab.until("s.decision.kind === 'line dropped'")
    tab.page.keyboard.press("End")
    tab.until("s.step === s.steps - 1")
    tab.page.keyboard.press("Escape")
    tab.until("s.step === null")


def test_the_card_does_not_lie_on_the_point_that_it_explains(new_tab):
    xy = open_recording(SAMPLES / "laboratory.npz")[223].xy
    high, low = int(np.nanargmax(xy[:, 1])), int(np.nanargmin(xy[:, 1]))
    tops = []
    for beam in (high, low):
        tab = new_tab(f"#recording=sample:laboratory&frame=223&beam={beam}")
        card = tab.page.locator(".explanation")
        tab.eventually(lambda card=card, beam=beam: f"beam {beam}" in card.inner_text(), "no explanation")
        tops.append(card.bounding_box()["y"])
    assert tops[0] > tops[1] + 200


def test_a_line_in_the_list_says_why_it_is_one_and_with_shift_why_two_are_two(tab):
    tab.page.get_by_role("tab", name="Lines").click()
    rows = tab.page.locator("#page-lines tbody").first.locator("tr")
    rows.nth(1).click()
    state = tab.until("s.selected !== null")
    assert state["explanation"]["segment"] == 1
    card = tab.page.locator(".explanation")
    tab.eventually(lambda: "segment 1 is one line" in card.inner_text(), "nothing says why it is one")
    rows.nth(2).click(modifiers=["Shift"])
    tab.eventually(lambda: "segments 1 and 2 are two lines" in card.inner_text(), "nothing says why they are two")
    tab.page.keyboard.press("Escape")
    tab.until("s.selected === null")
    card.wait_for(state="hidden")


def test_a_recording_opens_by_upload(tab):
    tab.upload(SAMPLES / "hallway.log")
    state = tab.until("s.recording.startsWith('upload:')")
    assert state["format"] == "CARMEN log"
    assert tab.page.locator(".recording").inner_text() == state["label"]


def test_a_broken_file_says_what_is_wrong_and_the_old_view_stays(tab, tmp_path):
    before = tab.state
    broken = tmp_path / "broken.bag"
    broken.write_bytes(b"#ROSBAG V2.0\n" + bytes(range(256)))
    tab.upload(broken)
    alert = tab.page.locator(".notice.error")
    alert.wait_for()
    assert "broken.bag" in alert.inner_text()
    state = tab.until(f"s.recording === {before['recording']!r}")
    assert state["segments"] == before["segments"]
    tab.type_value("epsilon", "0.05")
    tab.until("s.params.epsilon === 0.05")


def test_two_tabs_do_not_disturb_each_other(new_tab):
    one, other = new_tab(), new_tab()
    one.type_value("epsilon", "0.1")
    one.until("s.params.epsilon === 0.1")
    other.page.keyboard.press("ArrowRight")
    other.until("s.frame === 1")
    assert other.state["params"]["epsilon"] == 0.03
    assert one.state["frame"] == 0


@pytest.mark.own_tab
def test_a_duplicated_tab_gets_a_session_of_its_own(new_tab):
    one = new_tab()
    with one.page.expect_popup() as popup:
        one.page.evaluate("() => void window.open(location.href)")
    twin = type(one)(popup.value, one.address)
    twin.until("true")
    source = "() => document.querySelector('iframe').src"
    assert one.page.evaluate(source) != twin.page.evaluate(source)


@pytest.mark.own_tab
def test_a_reload_restores_the_view(tab):
    tab.page.keyboard.press("ArrowRight")
    tab.type_value("epsilon", "0.05")
    tab.page.get_by_role("button", name="Layers").click()
    tab.page.get_by_role("checkbox", name="Normals").check()
    before = tab.until("s.params.epsilon === 0.05 && s.layers.normals && s.frame === 1")
    tab.page.reload()
    assert seen(tab.until("s.frame === 1")) == seen(before)
    tab.type_value("epsilon", "0.06")
    tab.until("s.params.epsilon === 0.06")


def test_a_link_reproduces_the_case_in_a_fresh_tab(tab, browser):
    tab.choose_recording("Laboratory (simulated)")
    tab.until("s.recording === 'sample:laboratory'")
    tab.page.keyboard.press("End")
    tab.type_value("min_length", "0.3")
    tab.page.keyboard.press("r")
    tab.page.keyboard.press("ArrowRight")
    before = tab.until("s.step === 1 && s.params.min_length === 0.3")
    tab.page.get_by_role("button", name="Copy link").click()
    tab.page.get_by_text(re.compile("Link copied")).wait_for()
    link = tab.page.url
    assert re.search(r"#recording=sample:\S+&frame=299&min_length=0.3&step=1$", link)
    with browser.new_context() as stranger:
        stranger.set_default_timeout(1000 * SECONDS)
        fresh = type(tab)(stranger.new_page(), link)
        fresh.open()
        assert seen(fresh.until("s.step === 1")) == seen(before)


def test_a_killed_and_restarted_server_is_reconnected_with_the_same_view(new_tab, killable_server):
    tab = new_tab(at=killable_server.http)
    tab.type_value("epsilon", "0.05")
    tab.until("s.params.epsilon === 0.05")
    killable_server.kill()
    lost = tab.page.locator(".notice.lost")
    lost.wait_for()
    tab.page.keyboard.press("ArrowRight")
    killable_server.start()
    lost.wait_for(state="hidden")
    state = tab.until("s.frame === 1")
    assert state["params"]["epsilon"] == 0.05
    assert tab.scene
    # The browser notes each vain try to connect on its console.
    tab.forgive("WebSocket connection", "ERR_CONNECTION_REFUSED", "ERR_CONNECTION_RESET", "ERR_EMPTY_RESPONSE")
