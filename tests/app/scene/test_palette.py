"""Every mark of the scene can be seen on the ground that it is drawn on."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lineseg_app.scene.palette import DARK, LIGHT, Theme

from lineseg.colours import SEGMENTS

BASE = Path(__file__).parents[3] / "static" / "base.css"
# They help the eye, and tell nothing by themselves.
QUIET = {"grid", "axis"}


def luminance(colour: tuple[int, int, int]) -> float:
    """Relative luminance of sRGB (WCAG 2)."""
    red, green, blue = (c / 12.92 if (c := each / 255) <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for each in colour)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: tuple[int, int, int], other: tuple[int, int, int]) -> float:
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
