"""The mode Inspect: frames ordered by doubt, two results side by side, changes of an answer, the truth."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from lineseg_app.places import data_folder

from lineseg import (
    EXTRACTORS,
    WEIGHTS,
    Agreement,
    Params,
    agreements,
    difference,
    extract,
    open_recording,
    save_npz,
    simulate,
    survey,
    what_if,
    why,
    with_disputes,
    with_stability,
    worst_first,
)
from lineseg.survey.disputes import lines_missed

HALLWAY = data_folder("sample_scans") / "hallway.npz"


@pytest.fixture(scope="module")
def hallway():
    return open_recording(HALLWAY)


def scored(tab) -> dict:
    """The strip once it is complete."""
    return tab.found(
        "const t = window.lineseg.strip; if (t?.complete) return { ...t, values: [...t.values] };", "the scores"
    )


@pytest.mark.own_tab
def test_frames_are_listed_worst_first_filtered_and_walked_by_key(new_tab):
    tab = new_tab("#mode=inspect&score=coverage")
    values = scored(tab)["values"]
    worst = sorted(range(len(values)), key=lambda frame: (values[frame], frame))
    rows = tab.page.locator(".frames-row")
    tab.eventually(lambda: rows.count() > 5, "no rows")
    assert rows.first.get_attribute("data-frame") == str(worst[0])
    tab.page.keyboard.press("n")
    tab.until(f"s.frame === {worst[0]}")
    tab.page.keyboard.press("n")
    tab.until(f"s.frame === {worst[1]}")
    tab.page.get_by_role("listbox").press("ArrowDown")
    tab.until(f"s.frame === {worst[2]}")
    few = sum(value >= 0.96 for value in values)
    limit = tab.page.get_by_label("Show only frames with this score from")
    limit.fill("0.96")
    limit.press("Enter")
    tab.eventually(lambda: tab.page.get_by_text(f"{few} of 300 frames").count() == 1, "the filter shows no count")
    tab.page.keyboard.press("Tab")
    tab.page.locator(".frames-row").first.click()
    assert values[tab.until("true")["frame"]] >= 0.96
    tab.page.get_by_label("Sorted by").select_option("misses")
    tab.until("s.score === 'misses'")
    assert tab.page.locator(".timeline").get_by_label("Score of the frames").input_value() == "misses"


def test_a_pinned_result_stands_beside_the_present_one(new_tab, hallway):
    tab = new_tab("#frame=200")
    tab.page.keyboard.press("b")
    assert tab.until("s.against !== null")["difference"]["lost"] == 0
    tab.type_value("epsilon", "0.015")
    state = tab.until("s.params.epsilon === 0.015")
    scan, mine = hallway[200], Params(epsilon=0.015)
    assert state["difference"] == difference(extract(scan), extract(scan, mine)).counts
    assert sum(state["difference"].values()) > state["difference"]["kept"]
    totals = dict.fromkeys(("kept", "lost", "gained", "split", "merged"), 0)
    for each in hallway:
        for name, count in difference(extract(each), extract(each, mine)).counts.items():
            totals[name] += count
    cells = tab.page.locator(".ab tbody tr").nth(1).locator("td")
    shown = [f"{count:,}" for count in totals.values()]
    tab.eventually(lambda: cells.all_inner_texts() == shown, f"the totals are not {shown}")
    tab.page.get_by_role("button", name="Next difference").click()
    tab.until("s.frame !== 200 && Object.entries(s.difference).some(([fate, n]) => fate !== 'kept' && n > 0)")
    tab.page.get_by_role("button", name="Swap").click()
    swapped = tab.until("s.params.epsilon === 0.03")
    assert swapped["against"]["params"]["epsilon"] == 0.015
    tab.page.wait_for_function("location.hash.includes('epsilon:0.015')")
    again = new_tab(tab.page.evaluate("location.hash"))
    assert again.state["against"] == swapped["against"]
    tab.page.get_by_role("button", name="Back to A").click()
    assert tab.until("s.against === null")["params"]["epsilon"] == 0.015
    tab.page.keyboard.press("Control+z")
    tab.until("s.params.epsilon === 0.03")


def test_the_strip_shows_where_a_and_b_differ(new_tab, hallway):
    tab = new_tab("#score=difference&epsilon=0.02")
    hint = tab.page.get_by_text("Pin a result as A first")
    tab.eventually(hint.is_visible, "nothing says what to do")
    tab.page.keyboard.press("b")
    tab.type_value("epsilon", "0.04")
    state = tab.until("s.params.epsilon === 0.04")
    expected = []
    for scan in hallway:
        counts = difference(extract(scan, Params(epsilon=0.02)), extract(scan, Params(epsilon=0.04))).counts
        expected.append(sum(counts.values()) - counts["kept"])
    tab.eventually(
        lambda: (strip := scored(tab))["params"] == state["params"] and strip["values"] == expected,
        "the strip does not show the differences",
    )


def test_what_would_change_an_answer_is_marked_on_the_slider_and_done_by_a_click(new_tab, hallway):
    tab = new_tab("#mode=inspect&frame=20&beam=300")
    (change,) = (each for each in what_if(hallway[20], 300) if each.name == "epsilon")
    assert change.value
    button = tab.page.locator(".what-if-change").filter(has_text="ε")
    button.wait_for()
    tab.page.get_by_role("tab", name="Thresholds").click()
    mark = tab.page.locator("[data-knob=epsilon] .what-if-mark")
    assert mark.get_attribute("aria-label") == change.text
    before = tab.state["explanation"]["segment"]
    button.click()
    state = tab.until(f"s.params.epsilon === {change.value}")
    assert state["explanation"]["segment"] == change.segment != before


def test_segments_are_judged_by_the_truth_in_numbers_and_in_the_scene(new_tab, hallway):
    tab = new_tab("#mode=inspect&frame=250")
    tab.page.get_by_role("tab", name="Truth").click()
    state = tab.until("s.agreement !== null")
    total = Agreement.of_all(each for each in agreements(hallway) if each is not None)
    of_frame = list(agreements(hallway))[250]
    assert of_frame is not None
    assert (state["agreement"]["matches"], state["agreement"]["trueLines"]) == (of_frame.matches, of_frame.true_lines)
    row = tab.page.locator(".truth-table tr:has(th:text-is('TR'))")
    shown = f"{100 * total.true_rate:.1f} %"
    tab.eventually(lambda: row.locator("td").nth(1).inner_text() == shown, f"TR of all frames is not {shown}")
    tab.page.get_by_role("checkbox", name="Show in the scene").check()
    tab.until("s.layers.verdicts")
    assert tab.page.locator(".verdict-key").all_inner_texts() == ["matched", "false", "missed", "just short or unknown"]


def test_a_truth_is_made_from_poses_marked_and_forgotten(new_tab):
    tab = new_tab("#mode=inspect&recording=sample:hallway.log&frame=7")
    tab.page.get_by_role("tab", name="Truth").click()
    tab.page.get_by_role("button", name="Truth from poses").click()
    state = tab.until("s.byViews !== '' && s.agreement !== null && s.layers.truth")
    assert (state["frame"], state["judgedBy"]) == (7, "wall")
    assert state["agreement"]["trueLines"] > 2
    tab.page.locator(".from-poses").get_by_text("TR and FR measured with such a truth were off by").wait_for()
    tab.page.locator(".truth-figures", has_text="by many views").wait_for()
    tab.page.get_by_label("Compared with").get_by_text("walls by many views").wait_for(state="attached")
    tab.page.get_by_role("button", name="Remove this truth").click()
    tab.until("s.byViews === '' && s.agreement === null")
    tab.page.get_by_role("button", name="Truth from poses").wait_for()


def test_why_no_truth_can_be_made_is_said_where_it_was_asked_for(new_tab, tmp_path):
    stamps = np.arange(6.0)
    poses = np.tile((2.0, 2.0, 0.3), (6, 1))
    world = simulate.room([(0, 0), (7, 0), (7, 5), (0, 5)])
    standing = simulate.record(lambda stamp: world, poses, stamps, simulate.LMS_200, np.random.default_rng(1), "stands")
    save_npz(replace(standing, wall=None, walls=None), tmp_path / "stands.npz")
    tab = new_tab("#mode=inspect")
    tab.upload(tmp_path / "stands.npz")
    tab.until("s.label === 'stands.npz'")
    tab.page.get_by_role("tab", name="Truth").click()
    tab.page.get_by_role("button", name="Truth from poses").click()
    tab.page.locator(".from-poses").get_by_text("the robot stands still").wait_for()
    assert tab.state["byViews"] == ""


def test_a_recording_without_truth_says_so(new_tab):
    tab = new_tab("#mode=inspect&recording=sample:hallway.log")
    tab.page.get_by_role("tab", name="Truth").click()
    tab.eventually(lambda: tab.page.get_by_text("are not known").is_visible(), "nothing says that the truth is unknown")
    tab.page.get_by_role("tab", name="Frames").click()
    assert tab.state["agreement"] is None


def test_the_most_suspicious_frame_says_what_looks_wrong_and_weights_change_the_order(new_tab, hallway):
    tab = new_tab()
    tab.page.get_by_role("button", name="Inspect").click()
    tab.until("s.mode === 'inspect' && s.score === 'suspicion'")
    found = with_stability(hallway, with_disputes(hallway, survey(hallway)))
    assert found.scores is not None
    worst = int(worst_first(found.scores)[0])
    row = tab.page.locator(".frames-row").first
    tab.eventually(lambda: row.get_attribute("data-frame") == str(worst), f"frame {worst} is not the first")
    tab.until(f"s.frame === {worst}")
    first = why(hallway, worst)[0].text
    tab.eventually(lambda: first in row.locator(".frames-words").inner_text(), f"the row does not say: {first}")
    only_gap = dict.fromkeys(WEIGHTS, 0.0) | {"gap": 1.0}
    tab.page.evaluate(
        "(w) => { location.hash += '&weights=' + Object.entries(w).map((pair) => pair.join(':')).join(',') }", only_gap
    )
    other = int(worst_first(found.scores, only_gap)[0])
    tab.eventually(lambda: row.get_attribute("data-frame") == str(other), f"frame {other} is not the first")
    tab.page.locator(".weights-holder summary").click()
    tab.page.get_by_role("button", name="Default weights").click()
    tab.eventually(lambda: row.get_attribute("data-frame") == str(worst), "the usual weights do not come back")
    # A link to Inspect alone does the same, one that names a frame opens that frame.
    new_tab("#mode=inspect&recording=sample:hallway").until(f"s.frame === {worst}")
    named = new_tab("#mode=inspect&recording=sample:hallway&frame=0")
    first = named.page.locator(".frames-row").first
    named.eventually(lambda: first.get_attribute("data-frame") == str(worst), f"frame {worst} is not the first")
    assert named.state["frame"] == 0


def test_the_lines_that_a_sentence_says_are_missed_are_ghosts_in_the_scene(new_tab):
    boards = open_recording(data_folder("sample_scans") / "room_of_boards.npz")
    ghosts = lines_missed(boards, 5)
    assert ghosts
    ends = np.array(ghosts).reshape(-1, 2)
    tab = new_tab("#mode=inspect&score=suspicion&recording=sample:room_of_boards&frame=5")
    drawn = """() => {
        const node = window.__viserMutable.nodeRefFromName["/seen/ghosts"];
        let found = null;
        if (node?.visible) node.traverse((part) => (found = part.geometry?.attributes.instanceStart ?? found));
        return found ? [...found.data.array] : [];
    }"""

    def span_the_ghosts(dashes):
        points = np.array(dashes).reshape(-1, 3)[:, :2]
        return np.allclose((points.min(axis=0), points.max(axis=0)), (ends.min(axis=0), ends.max(axis=0)), atol=0.3)

    # Those of another frame may still be drawn.
    tab.eventually(lambda: (now := tab.scene.evaluate(drawn)) and span_the_ghosts(now), "no such ghosts are drawn")
    row = tab.page.locator(".frames-row[data-frame='5'] .frames-words")
    tab.eventually(lambda: "m line at beams" in row.inner_text(), "no sentence says what is missed")
    tab.page.evaluate("() => { location.hash += '&layers=-ghosts' }")
    tab.eventually(lambda: not tab.scene.evaluate(drawn), "the ghosts stay although their layer is off")


@pytest.mark.own_tab
@pytest.mark.parametrize("other", ["split-and-merge", "hough"])
def test_another_method_is_compared_explained_and_asked_what_would_change_it(new_tab, hallway, other):
    tab = new_tab(f"#mode=inspect&frame=20&score=gap&method={other}&beam=300")
    tab.page.keyboard.press("b")
    tab.page.get_by_label("Method", exact=True).select_option("region-growing")
    state = tab.until("s.method === 'region-growing' && s.difference !== null")
    mine = extract(hallway[20], EXTRACTORS[other].params_type())
    assert state["difference"] == difference(mine, extract(hallway[20])).counts
    card = tab.page.get_by_role("region", name="A/B")
    assert EXTRACTORS[other].label in card.inner_text()
    tab.eventually(lambda: "…" not in card.locator("tbody").inner_text(), "the recording is never compared")
    card.get_by_role("button", name="Swap").click()
    state = tab.until(f"s.method === {other!r}")
    assert state["against"]["method"] == "region-growing"
    assert state["explanation"]["text"] in tab.page.get_by_role("region", name="Why").inner_text()
    tab.eventually(
        lambda: re.search("The answer changes with|Changing one threshold", tab.page.locator(".what-if").inner_text()),
        "nothing says what would change the answer",
    )
    row = tab.page.locator(".frames-row").first

    @cache
    def first_remark(frame: int) -> str:
        return why(hallway, frame, EXTRACTORS[other].params_type())[0].text

    def says_what_looks_wrong() -> bool:
        return first_remark(int(row.get_attribute("data-frame"))) in row.inner_text()

    tab.eventually(says_what_looks_wrong, "the worst frame does not say what looks wrong by this method")
    card.get_by_role("button", name="Back to A").click()
    tab.until("s.method === 'region-growing' && s.against === null")
