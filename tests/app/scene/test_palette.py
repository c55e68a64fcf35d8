"""Every mark of the scene can be seen on the ground that it is drawn on."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from lineseg_app.scene.palette import DARK, LIGHT, Theme

from lineseg.colours import SEGMENTS

STATIC = Path(__file__).parents[3] / "static"
BASE = STATIC / "base.css"
# They help the eye, and tell nothing by themselves.
QUIET = {"grid", "axis"}


def luminance(colour: tuple[float, ...]) -> float:
    """Relative luminance of sRGB (WCAG 2)."""
    red, green, blue = (c / 12.92 if (c := each / 255) <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for each in colour)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def declared(name: str) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
    """A colour of the page in the light theme and in the dark one."""
    found = re.search(rf"--{name}: light-dark\((#\w+), (#\w+)\)", BASE.read_text("utf-8"))
    assert found
    light, dark = (tuple(bytes.fromhex(code[1:])) for code in found.groups())
    return light, dark  # type: ignore[return-value]


@pytest.mark.parametrize(("theme", "number"), [(LIGHT, 0), (DARK, 1)], ids=["light", "dark"])
def test_marks_have_a_contrast_of_3_to_the_ground(theme: Theme, number: int):
    ground = declared("ground")[number]
    marks = {name: colour for name, colour in vars(theme).items() if name not in QUIET}
    marks |= {f"segment {k}": tuple(colour) for k, colour in enumerate(SEGMENTS.tolist())}
    assert {
        name: round(contrast(colour, ground), 2) for name, colour in marks.items() if contrast(colour, ground) < 3
    } == {}


@pytest.mark.parametrize("number", [0, 1], ids=["light", "dark"])
@pytest.mark.parametrize("ground", ["ground", "surface", "raised", "hover", "accent-soft"])
def test_text_has_a_contrast_of_4_5_to_what_it_lies_on(ground: str, number: int):
    texts = {
        name: contrast(declared(name)[number], declared(ground)[number])
        for name in ("ink", "muted", "accent", "trouble", "good")
    }
    assert {name: round(value, 2) for name, value in texts.items() if value < 4.5} == {}


# The grid, and planes; what is drawn over a plane has its colour.
HELPERS = {
    "grid",
    "grid-axis",
    "ground",
    "surface",
    "raised",
    "hover",
    "accent-soft",
    "on-accent",
}


def test_legends_and_overlays_have_the_colours_of_the_scene():
    said = re.findall(r"--scene-([\w-]+):", BASE.read_text("utf-8"))
    pairs = {name: (vars(LIGHT)[name.replace("-", "_")], vars(DARK)[name.replace("-", "_")]) for name in said}
    assert {name: declared(f"scene-{name}") for name in said} == pairs


# Elements whose lower border is the axis of a chart.
BASES_OF_CHARTS = {".histogram", ".curve"}


def drawn() -> Iterator[tuple[str, str, float]]:
    """What the page draws with SVG and on canvases: where, the name of its colour, its opacity."""
    for sheet in sorted(STATIC.rglob("*.css")):
        for selector, block in re.findall(r"([^{}]+)\{([^{}]*)\}", sheet.read_text("utf-8")):
            opacity = re.search(r"(?<![-\w])opacity: ([\d.]+)", block)
            if "stroke:" not in block:
                opacity = opacity or re.search(r"fill-opacity: ([\d.]+)", block)
            for name in re.findall(
                r"(?:(?:stroke|fill|--mark|--line-colour): |gradient\([^;]*?)var\(--([\w-]+)\)", block
            ):
                yield f"{sheet.name} {selector.strip()}", name, float(opacity[1]) if opacity else 1.0
            if selector.strip() in BASES_OF_CHARTS:
                for name in re.findall(r"border-bottom: [^;]*var\(--([\w-]+)\)", block):
                    yield f"{sheet.name} {selector.strip()}", name, 1.0
    for script in sorted(STATIC.rglob("*.js")):
        for name in re.findall(r'"--([\w-]+)"', script.read_text("utf-8")):
            yield script.name, name, 1.0


@pytest.mark.parametrize("number", [0, 1], ids=["light", "dark"])
def test_marks_of_the_page_have_a_contrast_of_3_to_what_they_lie_on(number: int):
    known = set(re.findall(r"--([\w-]+): light-dark", BASE.read_text("utf-8"))) - HELPERS
    low = {}
    for where, name, opacity in drawn():
        for ground in (declared(each)[number] for each in ("ground", "surface", "raised") if name in known):
            seen = [opacity * c + (1 - opacity) * g for c, g in zip(declared(name)[number], ground, strict=True)]
            if contrast(tuple(seen), ground) < 3:
                low[where, name] = round(contrast(tuple(seen), ground), 2)
    assert low == {}


# Below about 25, two lines are easily taken for the same colour.
APART = 25.0


def lab(colour: tuple[float, ...]) -> tuple[float, float, float]:
    """CIE L*a*b* of sRGB, for the white D65."""
    red, green, blue = (c / 12.92 if (c := each / 255) <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for each in colour)
    x = (0.4124564 * red + 0.3575761 * green + 0.1804375 * blue) / 0.95047
    y = 0.2126729 * red + 0.7151522 * green + 0.0721750 * blue
    z = (0.0193339 * red + 0.1191920 * green + 0.9503041 * blue) / 1.08883
    x, y, z = (c ** (1 / 3) if c > 216 / 24389 else (24389 / 27 * c + 16) / 116 for c in (x, y, z))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_no_line_that_was_found_has_the_colour_of_what_is_refused_or_under_test(theme: Theme):
    for mark in (theme.refused, theme.candidate):
        for colour in SEGMENTS.tolist():
            assert math.dist(lab(tuple(colour)), lab(mark)) > APART, colour


def test_colours_of_lines_differ_from_each_other():
    for k, one in enumerate(SEGMENTS.tolist()):
        for other in SEGMENTS.tolist()[:k]:
            assert math.dist(lab(tuple(one)), lab(tuple(other))) > APART, (one, other)
