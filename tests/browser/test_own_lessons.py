"""Lessons of one's own on the page: dropped, read, answered, and made of what is shown."""

from __future__ import annotations

import json

import pytest

LESSON = {
    "title": "Mine <b>too</b>",
    "about": "A corner.",
    "recording": "lesson:1_perfect_corner",
    "steps": [
        {"text": "*Look* at <b>this</b>, or [elsewhere](https://example.org/a), or at [corners](lesson:05_corner)."},
        {"text": "It begins at beam {first}.", "find": {"kind": "seed found", "nth": 1}},
    ],
    "task": {
        "text": "How many?",
        "hint": "Count.",
        "done": "There are {lines}.",
        "number": {"answer": "{lines}"},
    },
}


def answer(tab, typed: str, words: str) -> None:
    tab.page.get_by_label("Your answer").fill(typed)
    tab.page.get_by_role("button", name="Check").click()
    tab.page.locator(".lesson-verdict", has_text=words).wait_for()


@pytest.mark.own_tab
def test_a_dropped_lesson_is_read_and_answered_and_one_with_a_mistake_is_told(new_tab):
    tab = new_tab("#mode=tune&recording=sample:hallway")
    tab.drop("mine.json", json.dumps({**LESSON, "steps": [{"text": "{epsilom}"}]}, indent=1))
    tab.page.get_by_text("mine.json:7: step 1, text: {epsilom} is not known").wait_for()
    tab.forgive("400")
    tab.drop("mine.json", json.dumps(LESSON))
    lesson = tab.until("s.mode === 'learn' && s.recording === 'lesson:1_perfect_corner'")["view"]["lesson"]
    body = tab.page.locator(".lesson-body")
    tab.page.get_by_role("heading", name="Mine <b>too</b>").wait_for()
    body.get_by_text("at <b>this</b>").wait_for()
    assert body.locator("b").count() == 0
    assert body.locator("em").text_content() == "Look"
    assert body.get_by_role("link", name="elsewhere").get_attribute("href") == "https://example.org/a"
    tab.page.locator(".lesson-foot .primary").click()
    tab.until("s.decision?.kind === 'seed found' && s.step > 0")
    tab.page.locator(".lesson-foot .primary").click()
    for typed, words in [("1", "too small"), ("3", "too large"), ("two", "not a number"), ("2", "There are 2.")]:
        answer(tab, typed, words)
    # Who follows, or opens the link, has it too.
    tab.eventually(lambda: "page=2" in tab.page.url, "the address does not have the page")
    other = new_tab("#" + tab.page.url.partition("#")[2])
    other.until(f"s.view.lesson === '{lesson}' && s.view.page === 2")
    other.page.get_by_text("How many?").wait_for()


@pytest.mark.own_tab
def test_a_lesson_is_made_of_what_is_shown(new_tab):
    tab = new_tab("#mode=learn&recording=sample:hallway&frame=7&step=20&epsilon=0.04")
    shown = tab.until("s.step === 20")["decision"]["text"]
    tab.page.get_by_role("button", name="All lessons").click()
    tab.page.get_by_role("button", name="Make a lesson from here").click()
    fields = {
        "Title": "From here",
        "What it is about": "A decision.",
        "What is to be seen": "The value is {value}.",
        "A question about it": "Which?",
        "The right answer": "This one",
        "Wrong answers": "That one\nThe other",
    }
    for label, words in fields.items():
        tab.page.get_by_label(label).fill(words)
    with tab.page.expect_download() as saved:
        tab.page.get_by_role("button", name="Save and open").click()
    assert saved.value.suggested_filename == "From_here.json"
    made = json.loads(saved.value.path().read_text("utf-8"))
    assert (made["recording"], made["frame"], made["params"]["epsilon"]) == ("sample:hallway", 7, 0.04)
    tab.page.get_by_text("The value is 0.0").wait_for()
    assert tab.until("s.view.lesson && s.step === 20")["decision"]["text"] == shown
    tab.page.locator(".lesson-foot .primary").click()
    tab.page.get_by_role("button", name="That one").click()
    tab.page.locator(".lesson-verdict", has_text="No.").wait_for()
    tab.page.get_by_role("button", name="This one").click()
    tab.page.locator(".lesson-verdict.solved").wait_for()
