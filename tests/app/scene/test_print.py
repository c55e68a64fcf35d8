"""A picture on paper has the names of the scene beside what they name."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import pytest
from lineseg_app.frame.findings import findings
from lineseg_app.frame.framing import framing_near, framing_of
from lineseg_app.frame.geometry import bounds_of
from lineseg_app.scene.picture import picture
from lineseg_app.scene.print import EDGE, LETTER, LINE, print_svg
from lineseg_app.view import View

from lineseg import Params, open_recording

LESSONS = Path(__file__).parents[3] / "sample_scans" / "lessons"
WORD = re.compile(r'<text x="([\d.]+)" y="([\d.]+)" paint-order[^>]*>(.*?)</text>')
# Lines of segments are drawn 3 px wide.
DRAWN = re.compile(r'<g stroke-width="3"[^>]*>(.*?)</g>')
ENDS = re.compile(r"M([-\d.]+) ([-\d.]+)L([-\d.]+) ([-\d.]+)")


def covered(svg: str) -> list[str]:
    """Names that lie over a line of a segment."""
    lines = [tuple(map(float, ends)) for group in DRAWN.findall(svg) for ends in ENDS.findall(group)]
    assert lines
    names = []
    for left, base, inner in WORD.findall(svg):
        words = unescape(re.sub("<[^>]*>", "", inner))
        x, y = float(left), float(base)
        for x1, y1, x2, y2 in lines:
            spots = [(x1 + (x2 - x1) * k / 500, y1 + (y2 - y1) * k / 500) for k in range(501)]
            if any(x < px < x + LETTER * len(words) and y - LINE + EDGE < py < y for px, py in spots):
                names.append(words)
                break
    return names


@pytest.mark.parametrize("named", [{"first wall": 25, "second wall": 90, "corner": 55}, {"here": 70, "there": 100}])
def test_names_on_paper_lie_beside_the_lines(named: dict[str, int]):
    recording = open_recording(LESSONS / "9_wide_corner.npz")
    found = findings(recording, 0, "region-growing", Params())
    framing = framing_near(found, (), named)
    assert framing is not None
    svg = print_svg(picture(View(), recording, found, bounds_of(recording)), framing, "")
    assert len(WORD.findall(svg)) == len(named)
    assert covered(svg) == []


def test_names_on_paper_are_beside_the_line_that_grows():
    recording = open_recording(LESSONS / "9_wide_corner.npz")
    found = findings(recording, 0, "region-growing", Params())
    step = int(found.trace.indices("lines kept apart")[0])
    framing = framing_of(found, step)
    assert framing is not None
    svg = print_svg(picture(View(step=step), recording, found, bounds_of(recording)), framing, "")
    assert covered(svg) == []
