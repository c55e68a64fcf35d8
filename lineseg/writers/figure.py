"""Draws one frame as SVG: points and segments from above, with a scale bar and a legend."""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape

import numpy as np
from numpy.typing import NDArray

from ..colours import segment_colours
from ..scan import Recording, Scan
from ..segment import Extraction

WIDTH, HEIGHT = 960.0, 720.0
MARGIN, FOOT = 24.0, 64.0
POINT, INK, GROUND = "#8c9198", "#14161a", "#ffffff"
STEPS = (1, 2, 5)


def figure_svg(scan: Scan, extraction: Extraction, title: str = "") -> str:
    """The frame as an SVG document of WIDTH × HEIGHT in the frame of the laser, x to the right and y up.

    A cross marks the laser. The drawing is scaled to fit all valid points; the scale bar is below it.
    """
    place = _Place(scan.xy[scan.valid])
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH:g}" height="{HEIGHT:g}" '
        f'viewBox="0 0 {WIDTH:g} {HEIGHT:g}" font-family="sans-serif" font-size="14" fill="{INK}">',
        f"<title>{escape(title or 'laser scan', quote=False)}</title>",
        f'<rect width="{WIDTH:g}" height="{HEIGHT:g}" fill="{GROUND}"/>',
        *_points(scan, place),
        *_segments(extraction, place),
        *_laser(place),
        *_foot(scan, extraction, title, place),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def figure_title(recording: Recording, frame: int, method: str) -> str:
    """ "corridor.bag, frame 17 of 300, Region growing", with frames counted from 0."""
    if recording.pack is not None:
        return f"{recording.pack.recording}, frame {recording.pack.frame}, {method}"
    frames = recording.whole or len(recording)
    return f"{recording.name}, frame {recording.number(frame)} of {frames}, {method}"


class _Place:
    """The position in the drawing [px] of a point in the frame [m]."""

    def __init__(self, xy: NDArray[np.float64]) -> None:
        corners = np.vstack((xy, (0.0, 0.0)))
        low, high = corners.min(axis=0), corners.max(axis=0)
        room = np.array((WIDTH - 2 * MARGIN, HEIGHT - 2 * MARGIN - FOOT))
        self.scale = float((room / np.maximum(high - low, 1e-3)).min())
        self._middle = (low + high) / 2
        self._centre = np.array((WIDTH / 2, MARGIN + room[1] / 2))

    def __call__(self, x: float, y: float) -> tuple[float, float]:
        across, up = (np.array((x, y)) - self._middle) * self.scale
        return float(self._centre[0] + across), float(self._centre[1] - up)


def _points(scan: Scan, place: _Place) -> Iterator[str]:
    spots = (place(x, y) for x, y in scan.xy[scan.valid].tolist())
    path = " ".join(f"M{x:.1f} {y:.1f}h0" for x, y in spots)
    yield f'<path class="points" d="{path}" stroke="{POINT}" stroke-width="3" stroke-linecap="round"/>'


def _segments(extraction: Extraction, place: _Place) -> Iterator[str]:
    for number, (segment, colour) in enumerate(
        zip(extraction.segments, segment_colours(extraction.segments).tolist(), strict=True)
    ):
        (x1, y1), (x2, y2) = place(*segment.start), place(*segment.end)
        paint = f'stroke="rgb({colour[0]} {colour[1]} {colour[2]})" stroke-width="3" stroke-linecap="round"'
        words = f"segment {number}: beams {segment.first}–{segment.last}, {segment.length:.2f} m"
        line = f'<line class="segment" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {paint}>'
        yield f"{line}<title>{words}</title></line>"


def _laser(place: _Place) -> Iterator[str]:
    x, y = place(0.0, 0.0)
    yield f'<path class="laser" d="M{x - 6:.1f} {y:.1f}h12M{x:.1f} {y - 6:.1f}v12" stroke="{INK}" stroke-width="2"/>'


def _foot(scan: Scan, extraction: Extraction, title: str, place: _Place) -> Iterator[str]:
    """Scale bar, legend and title."""
    metres = bar_length(160 / place.scale)
    y, width = HEIGHT - 40, metres * place.scale
    yield f'<path class="bar" d="M{MARGIN:g} {y - 5:g}v5h{width:.1f}v-5" fill="none" stroke="{INK}" stroke-width="2"/>'
    yield f'<text x="{MARGIN:g}" y="{y + 20:g}">{metres:g} m</text>'
    x, middle = MARGIN + max(width, 60) + 40, y - 5
    segments, covered, valid = len(extraction.segments), extraction.covered, int(np.count_nonzero(scan.valid))
    entries = [
        (f'<circle cx="{{x}}" cy="{middle:g}" r="3" fill="{POINT}"/>', f"{valid} points, {covered} in segments"),
        (
            f'<path d="M{{x}} {middle:g}m-8 0h16" stroke="rgb(0 119 187)" stroke-width="3" stroke-linecap="round"/>',
            f"{segments} segment{'' if segments == 1 else 's'}",
        ),
        (f'<path d="M{{x}} {middle:g}m-6 0h12m-6 -6v12" stroke="{INK}" stroke-width="2"/>', "laser"),
    ]
    for sign, words in entries:
        yield sign.format(x=f"{x:.1f}") + f'<text x="{x + 14:.1f}" y="{middle + 5:g}">{words}</text>'
        x += 44 + 8 * len(words)
    yield f'<text x="{MARGIN + max(width, 60) + 32:.1f}" y="{y + 20:g}">{escape(title, quote=False)}</text>'


def bar_length(most: float) -> float:
    """The greatest of 1, 2 and 5 times a power of ten that is at most `most` [m], most > 0."""
    power = 10.0 ** math.floor(math.log10(most) + 1e-12)
    return power * max(step for step in STEPS if step * power <= most * (1 + 1e-9))
