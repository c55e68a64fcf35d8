"""Colours of everything that is drawn, on light and dark backgrounds."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Colour = tuple[int, int, int]
Colours = NDArray[np.uint8]


@dataclass(frozen=True)
class Theme:
    """Colours of everything except segments."""

    point: Colour
    invalid: Colour
    strong: Colour
    faint: Colour
    grid: Colour
    axis: Colour
    truth: Colour
    laser: Colour
    accepted: Colour
    refused: Colour
    candidate: Colour
    predicted: Colour
    first: Colour
    other: Colour
    pinned: Colour
    changed: Colour
    matched: Colour
    missed: Colour
    false: Colour
    ghost: Colour
    past: Colour
    past_line: Colour
    trajectory: Colour
    mapped: Colour
    second: Colour
    third: Colour
    fourth: Colour


LIGHT = Theme(
    point=(118, 123, 130), invalid=(139, 144, 151), strong=(20, 22, 26), faint=(139, 144, 151),
    grid=(232, 234, 237), axis=(205, 208, 213), truth=(140, 140, 20), laser=(20, 22, 26),
    accepted=(0, 136, 85), refused=(204, 51, 17), candidate=(238, 51, 119),
    predicted=(110, 70, 215), first=(20, 22, 26), other=(0, 119, 187),
    pinned=(140, 147, 158), changed=(178, 102, 210),
    matched=(0, 119, 187), missed=(20, 22, 26), false=(222, 105, 20), ghost=(110, 70, 215),
    past=(136, 141, 148), past_line=(95, 145, 190), trajectory=(222, 105, 20), mapped=(16, 62, 105),
    second=(200, 30, 150), third=(0, 130, 140), fourth=(135, 105, 0),
)  # fmt: skip
DARK = Theme(
    point=(150, 156, 164), invalid=(107, 113, 122), strong=(245, 246, 248), faint=(120, 126, 134),
    grid=(56, 60, 67), axis=(92, 98, 107), truth=(150, 150, 60), laser=(235, 237, 240),
    accepted=(60, 200, 140), refused=(255, 110, 80), candidate=(255, 110, 170),
    predicted=(170, 140, 255), first=(245, 246, 248), other=(51, 160, 238),
    pinned=(100, 106, 118), changed=(150, 88, 190),
    matched=(51, 160, 238), missed=(245, 246, 248), false=(255, 140, 70), ghost=(170, 140, 255),
    past=(112, 118, 127), past_line=(74, 122, 167), trajectory=(255, 140, 70), mapped=(150, 205, 250),
    second=(250, 120, 215), third=(60, 205, 215), fourth=(215, 190, 70),
)  # fmt: skip
# In place of both themes: the colour of a field is its number, as no segment has it.
NUMBERED = Theme(*((number, 1, 254) for number in range(len(fields(Theme)))))


def in_theme(colours: Colours, theme: Theme) -> Colours:
    """(n, 3) colours of a picture in NUMBERED as they are in a theme."""
    roles = np.array([getattr(theme, field.name) for field in fields(Theme)], dtype=np.uint8)
    numbered = (colours[:, 1] == 1) & (colours[:, 2] == 254) & (colours[:, 0] < len(roles))
    return np.where(numbered[:, None], roles[np.minimum(colours[:, 0], len(roles) - 1)], colours)


def linear(colours: Colours) -> Colours:
    """Convert sRGB to linear light; viser treats the colours of line vertices as linear."""
    return _LINEAR[colours]


_SRGB = np.arange(256) / 255
_LINEAR = np.round(255 * np.where(_SRGB <= 0.04045, _SRGB / 12.92, ((_SRGB + 0.055) / 1.055) ** 2.4)).astype(np.uint8)
