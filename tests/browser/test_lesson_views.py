"""What each page of each lesson speaks of can be seen."""

from __future__ import annotations

import pytest
from lineseg_app.shelf.lesson import NamedLesson, Step
from lineseg_app.shelf.lesson_numbers import METHOD, found, trace_by
from lineseg_app.shelf.lessons import scan_of
from taught import taught

from lineseg import Params

LEAST_PX = 8
# Places and sizes of all names and measures on the stage [px].
SEEN = """() => {
    const stage = document.querySelector("#stage").getBoundingClientRect();
    const { framing } = lineseg.state;
    const at = ([x, y]) => lineseg.project(x, y);
    const inside = ([x, y]) => x >= 0 && y >= 0 && x <= stage.width && y <= stage.height;
    const boxes = [...document.querySelectorAll(".scene-name")].map((part) => part.getBoundingClientRect());
    const within = (box) => box.left >= stage.left - 1 && box.right <= stage.right + 1
        && box.top >= stage.top - 1 && box.bottom <= stage.bottom + 1;
    const over = (one, other) => Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1
        && Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > 1;
    return {
        outside: framing.names.filter((name) => !inside(at(name.at))).map((name) => name.text),
        measures: framing.measures.map(({ text, start, end }) => {
            const [one, other] = [at(start), at(end)];
            return [text, Math.hypot(one[0] - other[0], one[1] - other[1])];
        }),
        cut: boxes.filter((box) => !within(box)).length,
        onEnds: boxes.filter((box) => lineseg.state.segments.flatMap(({ start, end }) => [start, end])
            .map(at).some(([x, y]) => x + stage.left > box.left + 2 && x + stage.left < box.right - 2
                && y + stage.top > box.top + 2 && y + stage.top < box.bottom - 2)).length,
        hidden: boxes.filter((box, k) => boxes.slice(0, k).some((other) => over(box, other))).length,
        unset: document.querySelector("#learn").innerText.match(/\\b[A-Z]_\\w+/g) ?? [],
        behindKey: [...document.querySelectorAll(".stage > .scene-key:not([hidden])")].flatMap((key) =>
            boxes.filter((box) => over(box, key.getBoundingClientRect()))).length,
        words: document.querySelectorAll(".scene-name").length - framing.names.length - framing.measures.length,
    };
}"""


def step_of(lesson: NamedLesson, step: Step) -> int | None:
    """The decision that a page of a lesson shows."""
    if step.find is None:
        return None
    traced = trace_by(scan_of(lesson), METHOD, Params().but(**{**lesson.params, **step.params}))
    return found(traced, step.find)[step.find.nth].index


def check_page(tab, place: str) -> None:
    """What is named lies on the stage and covers no end of a line, and what is compared lies apart."""
    tab.eventually(lambda: tab.page.evaluate(SEEN)["words"] == 0, f"{place}: names are missing")
    seen = tab.page.evaluate(SEEN)
    # Of a long line only the part under test is shown.
    outside = [name for name in seen["outside"] if not name.startswith(("P_b", "P_f"))]
    covered = (outside, seen["cut"], seen["hidden"], seen["onEnds"], seen["behindKey"])
    assert covered == ([], 0, 0, 0, 0), place
    assert seen["unset"] == [], f"{place}: an index is not set as one"
    for text, pixels in seen["measures"]:
        assert pixels >= LEAST_PX, f"{place}: {text} is {pixels:.1f} px long"


def test_every_page_of_every_lesson_shows_what_it_speaks_of(new_tab):
    tab = new_tab("#mode=learn&recording=lesson:1_perfect_corner")
    for lesson in taught().lessons:
        tab.page.locator(f"[data-lesson='{lesson.id}']").click()
        for page, step in enumerate([*lesson.steps, None]):
            wanted = "null" if step is None or (at := step_of(lesson, step)) is None else str(at)
            tab.until(f"s.view.lesson === '{lesson.id}' && s.view.page === {page} && s.step === {wanted}")
            check_page(tab, f"{lesson.id}, page {page + 1}")
            if step is not None:
                tab.page.locator(".lesson-foot .primary").click()
        tab.page.get_by_role("button", name="Back to the list of lessons").click()
        tab.until("s.view.lesson === null")


# At many widths of a text, the full stops, brackets and such that begin a line or end one away from their word.
TORN = """() => {
    const text = document.querySelector(".lesson-body");
    const torn = [];
    const rowsOf = (node, at) => {
        const range = document.createRange();
        range.setStart(node, at);
        range.setEnd(node, at + 1);
        return range.getBoundingClientRect();
    };
    for (let width = 180; width <= 400; width += 3) {
        text.style.width = `${width}px`;
        for (const button of text.querySelectorAll("p button")) {
            const box = button.getBoundingClientRect();
            const after = button.nextSibling;
            if (after instanceof Text && /^[.,:;!?)”’]/.test(after.data) && rowsOf(after, 0).top > box.bottom - 2)
                torn.push(`${button.textContent}${after.data[0]} at ${width} px`);
            const before = button.previousSibling;
            const last = before instanceof Text ? before.data.length - 1 : -1;
            if (last >= 0 && /[(“‘]$/.test(before.data) && rowsOf(before, last).bottom < box.top + 2)
                torn.push(`${before.data[last]}${button.textContent} at ${width} px`);
        }
    }
    text.style.width = "";
    return torn;
}"""


@pytest.mark.parametrize("lesson", ["02_delta", "09_shallow"])
def test_a_term_is_on_one_line_with_its_full_stop_and_its_bracket(new_tab, lesson):
    tasks = {each.id: len(each.steps) for each in taught().lessons}
    tab = new_tab(f"#mode=learn&lesson={lesson}&page={tasks[lesson]}")
    tab.until(f"s.view.lesson === '{lesson}'")
    tab.page.locator(".lesson-body p button.term").first.wait_for()
    assert tab.page.evaluate(TORN) == []


def test_the_rows_of_a_formula_are_as_wide_as_the_panel_in_a_small_window(new_tab):
    tab = new_tab("#mode=learn&recording=lesson:1_perfect_corner")
    tab.page.set_viewport_size({"width": 1024, "height": 700})
    tab.page.locator("[data-lesson='06_endpoints']").click()
    tab.page.locator(".lesson-foot .primary").click()
    tab.until("s.view.page === 1 && s.step !== null")
    tab.page.locator(".formula-row").first.wait_for()
    wide = (
        "() => [...document.querySelectorAll('.formula-row')].filter((row) => row.scrollWidth > row.clientWidth).length"
    )
    assert tab.page.evaluate(wide) == 0


@pytest.mark.parametrize(("lesson", "page"), [("02_delta", 3), ("14_without_it", 0)])
def test_the_legend_covers_neither_a_name_nor_its_place(new_tab, lesson, page):
    tab = new_tab("#mode=learn&recording=lesson:1_perfect_corner")
    tab.page.set_viewport_size({"width": 1440, "height": 900})
    tab.page.locator(f"[data-lesson='{lesson}']").click()
    for k in range(page):
        tab.until(f"s.view.lesson === '{lesson}' && s.view.page === {k}")
        tab.page.locator(".lesson-foot .primary").click()
    tab.until(f"s.view.page === {page} && s.step !== null")
    check_page(tab, lesson)
    behind = """() => {
        const stage = document.querySelector("#stage").getBoundingClientRect();
        const key = document.querySelector(".stage > .scene-key[open]").getBoundingClientRect();
        return lineseg.state.framing.names.filter(({ at }) => {
            const [x, y] = lineseg.project(...at);
            return x + stage.left > key.left && x + stage.left < key.right
                && y + stage.top > key.top && y + stage.top < key.bottom;
        }).map(({ text }) => text);
    }"""
    assert tab.page.evaluate(behind) == []
