"""A drawing of a step shows what the step is about."""

import re
from pathlib import Path

from lineseg_app.frame.findings import findings
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.scene.drawing import WORDS, step_marks
from lineseg_app.scene.picture import picture
from lineseg_app.view import View
from scenes import corner

from lineseg import Params, Recording, figure_svg, open_recording

TOP = Path(__file__).parents[3]
HALLWAY = TOP / "sample_scans" / "hallway.npz"
# They have the colours of the lines, or grey, and need no words.
PLAIN = {"points", "segments", "laser"}


def test_a_drawing_at_a_step_has_its_window_its_predicted_point_and_its_band():
    recording = open_recording(HALLWAY)
    found = findings(recording, 0, "region-growing", View().params)
    seen = set()
    for step in range(40):
        marks, near = step_marks(View(step=step), recording, found)
        seen |= {mark.words for mark in marks}
        drawing = figure_svg(found.scan, found.extraction, "", None, marks, near)
        assert all(f"<title>{mark.words}</title>" in drawing for mark in marks)
    assert {WORDS[name] for name in ("window", "predicted", "band", "candidate")} <= seen


def marks_explained() -> set[str]:
    """The marks with words in the legend of the page, and with a picture beside them."""
    said = (TOP / "static" / "text" / "page.js").read_text("utf-8").split('label: "Marks"')[1].split("})")[0]
    words = set(re.findall(r"^\s*(\w+): \"", said, re.MULTILINE))
    drawn = set(re.findall(r"\.mark-(\w+)", (TOP / "static" / "stage" / "stage.css").read_text("utf-8")))
    return words & drawn


def test_the_legend_explains_every_mark_of_every_kind_of_decision():
    lessons = sorted((TOP / "sample_scans" / "lessons").glob("*.npz"))
    seen, kinds = set[str](), set[str]()
    for recording in [*map(open_recording, lessons), Recording.from_scans([corner(noise=0.006, seed=1)])]:
        params = Params(merge_rms=0.0, max_occluder=0.0)
        found = findings(recording, 0, "region-growing", params)
        for step in [*{(each.kind, each.check): each.index for each in found.trace}.values(), None]:
            kinds |= {found.trace[step].kind} if step is not None else set()
            seen |= set(picture(View(step=step, params=params), recording, found, bounds_of(recording)).nodes)
    assert {"lines merged", "overlap cut", "line dropped", "endpoints"} <= kinds
    assert {"first", "other", "dropped", "perpendicular", "bent"} <= seen
    assert seen - PLAIN - marks_explained() == set()
