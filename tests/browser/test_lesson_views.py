"""What each page of each lesson speaks of can be seen."""

from __future__ import annotations

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
    assert (outside, seen["cut"], seen["hidden"], seen["onEnds"]) == ([], 0, 0, 0), place
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
