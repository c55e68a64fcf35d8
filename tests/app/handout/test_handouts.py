"""Pages that stand alone: what they hold is what the library says, and nothing in them can be taken for markup."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.handout.bundle import script_of
from lineseg_app.handout.content import Content
from lineseg_app.handout.handouts import frame_page, lesson_page, shown_in, small_enough
from lineseg_app.handout.packing import packed
from lineseg_app.handout.page import page_of
from lineseg_app.handout.sheet import sheet_page
from lineseg_app.scene.flat import code_of, shapes_of
from lineseg_app.scene.palette import DARK, LIGHT
from lineseg_app.scene.picture import picture
from lineseg_app.shelf.lesson_shelf import LessonShelf
from lineseg_app.view import View
from scenes import corner

from lineseg import Params, Recording, Scan, extract, trace

LESSONS = LessonShelf()
CORNER = Recording.from_scans([corner(noise=0.006, seed=1)])
PAPER = ("epsilon", "delta", "seed_points", "min_points", "min_length")


class Page(NamedTuple):
    """A page with what it holds."""

    html: str
    content: Any
    arrays: dict[str, np.ndarray]

    def drawn(self, moment: int, dark: bool) -> list[tuple[str, list, list[str]]]:
        """Name, coordinates and colours of each shape, as pictures.js puts them together."""
        looks, moments = self.content["looks"], self.arrays["moments"].reshape(len(self.content["looks"]), -1)
        palette = self.content["dark" if dark else "light"]
        shapes = []
        for look, number in zip(looks, moments[:, moment].tolist(), strict=True):
            if number >= 0:
                members = self.arrays["members"][slice(*self.arrays["starts"][number : number + 2])]
                width = 2 if look["kind"] == "points" else 4
                columns = [self.arrays[f"{look['kind']}_{k}"][members] for k in range(width)]
                tones = self.arrays[f"{look['kind']}_tone"][members].tolist()
                xy = self.content["unit"] * np.column_stack(columns)
                shapes.append((look["name"], xy.tolist(), [palette[tone] for tone in tones]))
        return shapes


def opened(html: str) -> Page:
    """Reads a page as unpack.js does."""
    (data,) = re.findall(r'id="data">([^<]*)<', html)
    whole = gzip.decompress(base64.b64decode(data))
    begin = 4 + int.from_bytes(whole[:4], "little")
    head = json.loads(whole[4:begin])
    arrays = {name: array_in(whole, kind, n, begin + at) for name, (kind, at, n) in head["arrays"].items()}
    return Page(html, head["content"], arrays)


def array_in(whole: bytes, kind: str, n: int, at: int) -> np.ndarray:
    if kind == "uint8":
        return np.frombuffer(whole, kind, n, at)
    planes = np.frombuffer(whole, np.uint8, 4 * n, at).reshape(4, n)
    steps = [int.from_bytes(bytes(step), "little") for step in planes.T]
    sums = np.cumsum([(step >> 1) ^ -(step & 1) for step in steps], dtype=np.int64)
    return sums.astype(np.int32).astype(kind)


@pytest.fixture(scope="module")
def page() -> Page:
    return opened(frame_page(CORNER, 0, "corner", "region-growing", Params(), 3))


def test_the_result_at_every_value_of_a_slider_is_that_of_extract(page):
    (stand,) = page.content["stands"]
    assert tuple(stand["ranges"]) == PAPER
    counts = {name: len(stand["ranges"][name]["values"]) for name in PAPER}
    assert all(count >= 60 for name, count in counts.items() if name != "seed_points") and counts["seed_points"] == 18
    for name, swept in stand["ranges"].items():
        for value, number in zip(swept["values"], swept["results"], strict=True):
            found = extract(CORNER[0], Params().but(**{name: value})).segments
            stored = [page.content["segments"][k] for k in page.content["results"][number]["segments"]]
            assert [(line["first"], line["last"]) for line in stored] == [(line.first, line.last) for line in found]
            np.testing.assert_allclose(
                [line["start"] + line["end"] for line in stored], [line.start + line.end for line in found], atol=1e-6
            )
    assert len(page.content["results"]) < sum(counts.values()) / 3


def test_every_decision_is_there_with_its_sentence_and_its_picture(page):
    (stand,) = page.content["stands"]
    traced = trace(CORNER[0], Params())
    assert stand["trace"]["text"] == [decision.text for decision in traced]
    assert stand["why"] == [traced.explain(beam).text for beam in range(len(CORNER[0]))]
    view, found = View(mode="learn"), findings(CORNER, 0, "region-growing", Params())
    for step in (0, len(traced) // 2, len(traced) - 1):
        for dark, theme in ((False, LIGHT), (True, DARK)):
            own = picture(View(mode="learn", step=step), CORNER, found, bounds_of(CORNER), theme=theme)
            stored = page.drawn(stand["first"] + step, dark)
            assert [name for name, _, _ in stored] == [name for name, _, _ in shapes_of(own)]
            for (_, xy, colours), (_, places, tones) in zip(stored, shapes_of(own), strict=True):
                np.testing.assert_allclose(xy, places, atol=1e-5)
                assert colours == [code_of(tone) for tone in tones]
    result = page.content["results"][stand["result"]]["moment"]
    whole = picture(view, CORNER, found, bounds_of(CORNER))
    assert [name for name, _, _ in page.drawn(result, dark=False)] == [name for name, _, _ in shapes_of(whole)]


def test_nothing_runs_but_the_script_of_the_page_and_nothing_is_loaded(page):
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page.html)
    assert policy.startswith("default-src 'none'; ") and "unsafe" not in policy
    for tag, directive in (('<script type="module">', "script-src"), ("<style>", "style-src")):
        text = page.html.split(tag)[1].split(f"</{tag[1:].split()[0].rstrip('>')}>")[0]
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{directive} 'sha256-{digest}'" in policy
    addresses = set(re.findall(r"https?://[\w./-]+", page.html))
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1998/Math/MathML"}


@pytest.mark.parametrize("name", ["</script><script>alert(1)</script>", '"><img src=x>', "</title>&lt;", "name\u2028"])
def test_a_name_is_never_markup(name):
    html = page_of(name, packed({"title": name}, {}))
    assert html.count("<script") == 2 and html.count("</title>") == 1 and "<img" not in html
    assert opened(html).content["title"] == name


def test_a_lesson_is_there_with_its_texts_and_the_thresholds_of_all_its_pages():
    lesson = LESSONS.find("12_split_and_merge")
    assert lesson is not None
    content = opened(lesson_page(LESSONS, lesson, "next.html", "index.html")).content
    told = json.loads(content["answers"]["/api/lessons"])
    assert [each["id"] for each in told["lessons"]] == [lesson.id] and told["terms"]
    assert len(content["pages"]) == len(lesson.steps) + 1
    methods = {step.method or "region-growing" for step in lesson.steps}
    assert {stand["method"] for stand in content["stands"]} == methods | {"region-growing"}
    assert (content["next"], content["index"]) == ("next.html", "index.html")


def test_a_frame_without_points_and_one_that_is_too_large_are_refused():
    nothing = Recording.from_scans([Scan(np.full(9, np.inf), np.linspace(-1, 1, 9))])
    with pytest.raises(ValueError, match="frame 0 of dark has no points; choose another frame"):
        frame_page(nothing, 0, "dark", "region-growing", Params())
    with pytest.raises(ValueError, match="huge is too large for one file: it would have more than 3 MB"):
        small_enough(lambda most_steps: "x" * 4_000_000, "huge")
    assert len(small_enough(lambda most_steps: "x" * 1000 * most_steps, "long")) <= 3_000_000


def test_modules_that_cannot_become_one_script_are_named(tmp_path):
    (tmp_path / "a.js").write_text('import { b } from "./b.js";\nexport const a = 1;\n')
    (tmp_path / "b.js").write_text('import { a } from "./a.js";\nexport const b = 2;\n')
    with pytest.raises(ValueError, match=r"a\.js imports itself: a\.js → b\.js → a\.js"):
        script_of(tmp_path, "a.js", {})
    (tmp_path / "c.js").write_text("export default 3;\n")
    with pytest.raises(ValueError, match=r"c\.js: “export default 3;” cannot be put into one script"):
        script_of(tmp_path, "c.js", {})


def test_what_texts_let_one_try_is_in_the_file():
    asked = {
        "15_laser": ["noise?session="],
        "16_correctness": ["frames?session="],
        "17_splitting": [
            f"decisions?session=&method={method}" for method in ("iterative-end-point-fit", "split-and-merge")
        ],
        "18_time": ["times?session="],
    }
    for id, addresses in asked.items():
        lesson = LESSONS.find(id)
        assert lesson is not None
        answers = shown_in(Content(LESSONS.scans_of(lesson), lesson.frame, 0), lesson)
        assert list(answers) == [f"/api/lessons/{address}" for address in addresses]
        assert all(json.loads(answer) for answer in answers.values())


def test_a_lesson_on_paper_has_a_picture_of_each_step_the_question_and_room(tmp_path: Path):
    told = {
        "title": "A <b> title",
        "about": "A corner.",
        "recording": "lesson:1_perfect_corner",
        "steps": [
            {"text": "*All* of <it>, S_num = {seed_points}.", "names": {"a & b": 60}},
            {"text": "The seed.\n\n![A wall](wall.png)", "find": {"kind": "seed found"}},
        ],
        "task": {
            "text": "How many?",
            "hint": "Count.",
            "done": "Yes.",
            "choice": [{"text": "One", "right": True}, {"text": "Two"}],
        },
    }
    (tmp_path / "mine.json").write_text(json.dumps(told), "utf-8")
    (tmp_path / "wall.png").write_bytes(b"")
    shelf = LessonShelf(tmp_path)
    lesson = shelf.find("mine")
    assert lesson is not None
    page = sheet_page(shelf, lesson, lambda name: f"/picture?{name}&")
    shelf.close()
    assert page.count("<figure><svg") == 3
    assert "seed found: beams" in page and "A &lt;b&gt; title" in page and "<em>All</em> of &lt;it&gt;" in page
    assert "<i>S</i><sub>num</sub> = 6" in page and "a &amp; b" in page and 'src="/picture?wall.png&amp;"' in page
    assert page.count('class="sheet-choice"') == 2 and page.count('class="sheet-line"') > 4
