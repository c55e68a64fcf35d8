"""Other ways in: a recording dropped on the page, viser's view opened on its own."""

from __future__ import annotations

import base64
from pathlib import Path

SAMPLES = Path(__file__).parents[2] / "sample_scans"


def test_a_recording_dropped_on_the_page_is_opened(tab):
    content = base64.b64encode((SAMPLES / "hallway.log").read_bytes()).decode()
    tab.page.evaluate(
        """([name, content]) => {
            const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
            const data = new DataTransfer();
            data.items.add(new File([bytes], name));
            for (const kind of ["dragenter", "dragover", "drop"])
                document.body.dispatchEvent(
                    new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
        }""",
        ["corridor.log", content],
    )
    state = tab.until("s.label === 'corridor.log'")
    assert (state["format"], state["frames"]) == ("CARMEN log", 30)


def test_visers_own_sliders_change_the_page_that_they_belong_to(tab):
    before = tab.state["params"]["epsilon"]
    alone = tab.page.context.new_page()
    alone.goto(tab.scene.url)
    slider = alone.get_by_role("slider").first
    slider.focus()
    slider.press("ArrowRight")
    state = tab.until(f"s.params.epsilon !== {before}")
    assert state["params"]["epsilon"] > before
    assert float(tab.field("epsilon").input_value()) == state["params"]["epsilon"]
    alone.close()


def test_the_newest_upload_comes_first_and_space_plays_what_the_menu_opened(new_tab):
    tab = new_tab()
    tab.upload(SAMPLES / "hallway.log")
    tab.until("s.label === 'hallway.log'")
    tab.upload(SAMPLES / "hallway.csv")
    tab.until("s.label === 'hallway.csv'")
    tab.page.locator(".recording").click()
    uploads = tab.page.get_by_role("group", name="Uploaded").get_by_role("menuitemradio")
    tab.eventually(lambda: uploads.all_inner_texts()[:2] == ["hallway.csv", "hallway.log"], "the newest is first")
    uploads.nth(1).click()
    tab.until("s.label === 'hallway.log'")
    tab.page.keyboard.press("Space")
    tab.page.get_by_role("button", name="Pause (Space)").wait_for()
    tab.page.keyboard.press("Space")
    tab.page.get_by_role("button", name="Play (Space)").first.wait_for()
