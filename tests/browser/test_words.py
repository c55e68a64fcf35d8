"""Words of sentences that name something: pointing at one lights it in the scene, a click goes there."""

from __future__ import annotations

import pytest
from lineseg_app.places import data_folder

from lineseg import open_recording, why, why_apart

LIT = ".overlay-lit"


def drawn_in(tab, selector: str):
    """What the overlay draws, once it does."""
    shape = tab.page.locator(selector)
    return tab.eventually(shape.count, f"{selector} is not drawn")


def test_a_word_of_an_answer_lights_what_it_names_and_a_click_goes_there(new_tab):
    tab = new_tab("#frame=39&beam=180")
    card = tab.page.locator(".explanation")
    words = card.locator(".named")
    tab.eventually(lambda: words.count() >= 3, "no words to point at")
    tab.eventually(lambda: words.all_inner_texts()[:2] == ["beam 180", "segment 0"], "other words")
    words.nth(1).hover()
    drawn_in(tab, f"{LIT} line")
    tab.page.mouse.move(5, 5)
    tab.eventually(lambda: tab.page.locator(LIT).count() == 0, "it stays lit")
    words.nth(0).click()
    drawn_in(tab, ".overlay-kept circle")
    tab.eventually(lambda: "look=" in tab.page.evaluate("location.hash"), "the camera stays where it is")


def test_a_threshold_in_a_sentence_lights_its_slider_and_leads_to_it(new_tab):
    tab = new_tab("#frame=39&beam=180")
    tab.page.get_by_role("tab", name="Lines").click()
    symbol = tab.page.locator(".explanation").locator(".named .symbol").first
    symbol.hover()
    tab.eventually(tab.page.locator("[data-knob=epsilon].lit").count, "the slider is not lit")
    symbol.click()
    tab.eventually(
        lambda: tab.page.evaluate("document.activeElement.closest('[data-knob]')?.dataset.knob") == "epsilon",
        "the slider is not focused",
    )


def test_a_decision_of_the_replay_names_its_beams(new_tab):
    tab = new_tab("#frame=39&step=60")
    state = tab.until("s.step === 60")
    words = tab.page.locator("#replay .decision .named")
    tab.eventually(lambda: words.count() > 0, "no words to point at")
    words.first.hover()
    drawn_in(tab, f"{LIT} circle")
    sentence = "".join(each if isinstance(each, str) else each["text"] for each in state["decision"]["words"])
    assert sentence == state["decision"]["text"]


def test_the_selected_row_says_all_and_a_chosen_finding_is_drawn(new_tab, hallway):
    tab = new_tab("#mode=inspect&frame=39")
    # The index of a symbol is a subscript.
    remarks = why(hallway, 39)
    texts = [remark.text.replace("_", "") for remark in remarks]
    items = tab.page.locator(".said-finding")
    tab.eventually(lambda: items.all_text_contents() == texts, "not all is said")
    chosen = next(k for k, remark in enumerate(remarks) if remark.first >= 0)
    items.nth(chosen).click(position={"x": 4, "y": 4})
    drawn_in(tab, ".overlay-finding circle")
    tab.eventually(lambda: items.nth(chosen).get_attribute("class") == "said-finding chosen", "it is not marked")


def test_a_second_point_clicked_with_shift_asks_why_both_are_apart(new_tab, hallway):
    tab = new_tab("#frame=39&beam=100")
    card = tab.page.locator(".explanation")
    tab.eventually(tab.page.locator("iframe.scene.ready").count, "no scene")

    def ask() -> bool:
        # Another test may have moved the camera.
        tab.page.keyboard.press("f")
        x, y = hallway[39].xy[470].tolist()
        at = tab.page.evaluate(f"window.lineseg.project({x}, {y})")
        box = tab.page.locator("iframe.scene").bounding_box()
        tab.page.keyboard.down("Shift")
        tab.page.mouse.click(box["x"] + at[0], box["y"] + at[1])
        tab.page.keyboard.up("Shift")
        tab.page.wait_for_timeout(500)
        return tab.state["view"]["beside"] is not None

    # A click is lost while the scene is not loaded yet.
    tab.eventually(ask, "no second beam")
    relation = why_apart(hallway[39], 100, tab.state["view"]["beside"])
    text = relation.text.replace("_", "")
    tab.eventually(lambda: text == card.locator(".decision").text_content(), "nothing says why")
    card.locator(".what-if-change").first.click()
    joined = tab.until(f"s.params.max_dropout === {relation.changes[0].values['max_dropout']}")
    assert joined["explanation"]["segment"] == 0
    tab.eventually(lambda: "is one line" in card.inner_text(), "they are not joined")


def test_beam_numbers_are_shown_on_request(new_tab):
    tab = new_tab("#frame=39")
    tab.page.keyboard.press("i")
    tab.until("s.layers.numbers")
    numbers = tab.page.locator(".overlay-numbers text")
    tab.eventually(lambda: numbers.count() > 20, "no numbers")
    tab.eventually(lambda: "100" in numbers.all_text_contents(), "no round numbers")
    tab.page.keyboard.press("i")
    tab.eventually(lambda: numbers.count() == 0, "the numbers stay")


@pytest.fixture(scope="module")
def hallway():
    return open_recording(data_folder("sample_scans") / "hallway.npz")
