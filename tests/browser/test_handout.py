"""Pages that stand alone, opened from disk with the network off."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from lineseg_app.handout.handouts import frame_page, lesson_page
from lineseg_app.shelf.lesson_shelf import LessonShelf
from playwright.sync_api import Browser, BrowserContext, Page
from scenes import corner
from waiting import SECONDS

from lineseg import Params, Recording, extract, trace

LESSONS = LessonShelf()
CORNER = Recording.from_scans([corner(noise=0.006, seed=1)])


@pytest.fixture(scope="module")
def html() -> str:
    return frame_page(CORNER, 0, "corner", "region-growing", Params(), 3)


class File:
    """An opened page; `drawn` is what it shows: method, thresholds, step, number of lines."""

    def __init__(self, page: Page, heard: list[str]) -> None:
        self.page, self.heard = page, heard

    def drawn(self) -> list:
        return json.loads(self.page.evaluate("document.documentElement.dataset.drawn ?? '[null, {}, null, 0]'"))

    def until(self, true: Callable[[list], bool]) -> list:
        self.eventually(lambda: true(self.drawn()))
        return self.drawn()

    def eventually(self, true: Callable[[], bool]) -> None:
        """Asked from here, because the page forbids code that is made from text."""
        late = time.monotonic() + SECONDS
        while not true():
            assert time.monotonic() < late, self.drawn()
            self.page.wait_for_timeout(20)


@pytest.fixture
def open_file(browser: Browser, tmp_path: Path) -> Iterator[Callable[..., File]]:
    """Opens pages in a browser without a network; nothing may be requested or complained about."""
    contexts, heard = list[BrowserContext](), list[str]()

    def opened(html: str, width: int = 1100, height: int = 760, after: str = "") -> File:
        (tmp_path / "page.html").write_text(html, encoding="utf-8")
        context = browser.new_context(viewport={"width": width, "height": height}, offline=True)
        context.set_default_timeout(1000 * SECONDS)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: heard.append(message.text))
        page.on("pageerror", lambda error: heard.append(str(error)))
        page.on("request", lambda request: heard.append(request.url) if "page.html" not in request.url else None)
        page.goto((tmp_path / "page.html").as_uri() + after)
        return File(page, heard)

    yield opened
    for context in contexts:
        context.close()
    assert heard == []


def test_a_frame_is_stepped_both_ways_and_each_threshold_is_dragged(open_file, html):
    file = open_file(html)
    page = file.page
    decisions = list(trace(CORNER[0], Params()))
    file.until(lambda drawn: drawn[2] == 3)
    page.keyboard.press("ArrowRight")
    file.until(lambda drawn: drawn[2] == 4)
    page.get_by_role("button", name="Step back").click()
    file.until(lambda drawn: drawn[2] == 3)
    page.locator(".decision", has_text=decisions[3].text).wait_for()
    page.locator(".code-line.lit").wait_for()
    page.locator(".formula math").first.wait_for()
    stage, panel = (page.locator(part).bounding_box() for part in ("#stage", "#learn"))
    assert stage and panel and 250 < stage["height"] < 600 and panel["x"] >= stage["x"] + stage["width"] > 500
    assert page.evaluate("document.documentElement.scrollHeight") <= 760
    page.keyboard.press("Escape")
    file.until(lambda drawn: drawn[2] is None)
    for name in ("epsilon", "min_points"):
        slider = page.locator(f".handout-ranges [data-knob={name}] input[type=range]")
        box = slider.bounding_box()
        assert box is not None
        y = box["y"] + box["height"] / 2
        page.mouse.move(box["x"] + box["width"] * 0.3, y)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] * 0.9, y, steps=5)
        page.mouse.up()
        usual = Params().numbers()
        _, params, _, lines = file.until(lambda drawn, name=name: drawn[1].get(name, 0) > 3 * usual[name])  # noqa: B023
        assert {other for other in usual if params[other] != usual[other]} == {name}
        assert lines == len(extract(CORNER[0], Params(**params)).segments)
    page.get_by_role("button", name="Back to the original thresholds").click()
    file.until(lambda drawn: drawn[1] == Params().numbers())
    page.keyboard.press("ArrowRight")
    file.until(lambda drawn: drawn[2] == 0)


def test_a_lesson_is_read_and_its_task_solved_on_a_phone(open_file):
    lesson = LESSONS.find("02_delta")
    assert lesson is not None
    file = open_file(lesson_page(LESSONS, lesson), 480, 800)
    page = file.page
    forward = page.locator(".lesson-foot button").last
    page.get_by_role("region", name="Lesson").get_by_text(lesson.steps[0].text[:40]).wait_for()
    forward.click()
    file.until(lambda drawn: drawn[2] is not None)
    page.locator(".scene-name", has_text="P, beam").wait_for()
    for _ in lesson.steps[1:]:
        forward.click()
    page.get_by_role("heading", name="Your turn").wait_for()
    field = page.locator(".lesson-knobs [data-knob=delta] .number")
    field.fill("0.5")
    field.press("Enter")
    page.locator(".lesson-verdict.solved").wait_for()
    assert file.drawn()[1]["delta"] == pytest.approx(0.5, abs=0.03)
    assert page.evaluate("document.documentElement.scrollWidth") <= 480


def test_a_point_is_asked_why_and_a_link_leads_to_a_step(open_file, html):
    file = open_file(html, after="#step=7")
    page = file.page
    file.until(lambda drawn: drawn[2] == 7)
    page.keyboard.press("Escape")
    file.until(lambda drawn: drawn[2] is None)
    page.locator(".beam-number").fill("20")
    page.locator(".beam-number").press("Enter")
    why = trace(CORNER[0], Params()).explain(20).text
    page.locator(".handout-why", has_text=why[1:60]).wait_for()


def test_it_works_in_a_closed_frame_and_a_damaged_file_is_told(open_file, html):
    file = open_file("<iframe sandbox='allow-scripts' width=900 height=600></iframe>")
    file.page.locator("iframe").evaluate("(frame, html) => { frame.srcdoc = html; }", html)
    inner = file.page.frame_locator("iframe")
    inner.locator(".code-line.lit").wait_for()
    inner.locator("canvas.scene").press("ArrowRight")
    number = inner.get_by_role("textbox", name="Number of the decision")
    file.eventually(lambda: number.input_value() == "5")
    broken = open_file(html[: html.index('id="data">') + 400] + html[html.index("</script>") :])
    broken.page.get_by_text("This file is damaged").wait_for()
    broken.heard.clear()
