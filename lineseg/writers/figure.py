"""Draws one frame as SVG: points and segments from above, with a scale bar and a legend."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..colours import segment_colours
from ..knobs import Thresholds
from ..readers.reading import Reading, as_flags
from ..scan import Recording, Scan
from ..segment import Extraction

WIDTH, HEIGHT = 960.0, 720.0
MARGIN, FOOT = 24.0, 64.0
# Of the thresholds, under the title.
SMALL, ROW, LETTERS = 12, 17.0, 145
# Where the legend begins, right of the scale bar.
LEGEND_AT = 240.0
POINT, INK, GROUND = "#8c9198", "#14161a", "#ffffff"
CROSS = f'<path d="M-6 0h12m-6 -6v12" stroke="{INK}" stroke-width="2"/>'
STEPS = (1, 2, 5)


class Mark(NamedTuple):
    """One kind of thing in a drawing. xy: (n, 2) points or (n, 4) lines [m]; colours: (n, 3) sRGB; width [px]."""

    words: str
    width: float
    xy: NDArray[np.floating]
    colours: NDArray[np.uint8]


def figure_svg(
    scan: Scan,
    extraction: Extraction,
    title: str = "",
    thresholds: Thresholds | None = None,
    marks: Sequence[Mark] | None = None,
    near: NDArray[np.floating] | None = None,
    reading: Reading | None = None,
) -> str:
    """The frame as an SVG document of WIDTH × HEIGHT in the frame of the laser, x to the right and y up.

    A cross marks the laser. The drawing is scaled to fit all valid points; the scale bar is below it.
    thresholds: written under it. reading: how the file was read, written there as flags. marks: drawn instead of the
    segments. near: (n, 2) points to fit instead [m].
    """
    notes = textwrap.wrap(_told(thresholds), LETTERS) if thresholds is not None else []
    if reading is not None and reading.given():
        notes += textwrap.wrap(f"read with {as_flags(reading.given())}", LETTERS)
    legend = [*(_segment_legend(scan, extraction) if marks is None else map(_key, marks)), (CROSS, "laser")]
    rows = in_rows(legend)
    foot = FOOT + ROW * (len(notes) + len(rows) - 1)
    close = near is not None and len(near) > 0
    place = Place(scan.xy[scan.valid], foot) if near is None or not close else Place(near, foot, laser=False)
    drawn = _segments(extraction, place) if marks is None else _marks(marks, place)
    return document(
        title or "laser scan",
        *([f'<clipPath id="room"><rect width="{WIDTH:g}" height="{HEIGHT - foot:g}"/></clipPath>'] if close else []),
        *(['<g clip-path="url(#room)">'] if close else []),
        *_points(scan, place),
        *drawn,
        *_laser(place),
        *(["</g>"] if close else []),
        *foot_of(rows, title, notes, place),
    )


def document(title: str, *parts: str) -> str:
    """An SVG document of WIDTH × HEIGHT with these parts on a plain ground."""
    whole = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH:g}" height="{HEIGHT:g}" '
        f'viewBox="0 0 {WIDTH:g} {HEIGHT:g}" font-family="sans-serif" font-size="14" fill="{INK}">',
        f"<title>{escape(title, quote=False)}</title>",
        f'<rect width="{WIDTH:g}" height="{HEIGHT:g}" fill="{GROUND}"/>',
        *parts,
        "</svg>",
    ]
    return "\n".join(whole) + "\n"


def figure_title(recording: Recording, frame: int, method: str) -> str:
    """ "corridor.bag, frame 17 of 0–299, Region growing", as the page counts frames."""
    if recording.pack is not None:
        return f"{recording.pack.recording}, frame {recording.pack.frame}, {method}"
    first, last = recording.number(0), recording.number(len(recording) - 1)
    return f"{recording.name}, frame {recording.number(frame)} of {first:,}–{last:,}, {method}"


class Place:
    """The position in the drawing [px] of a point in the frame [m]."""

    def __init__(self, xy: NDArray[np.floating], foot: float, laser: bool = True) -> None:
        """foot: height of what stands below [px]; laser: whether it must be seen."""
        self.foot = foot
        corners = np.vstack((xy, (0.0, 0.0))) if laser else xy
        low, high = corners.min(axis=0), corners.max(axis=0)
        room = np.array((WIDTH - 2 * MARGIN, HEIGHT - 2 * MARGIN - foot))
        self.scale = float((room / np.maximum(high - low, 1e-3)).min())
        self._middle = (low + high) / 2
        self._centre = np.array((WIDTH / 2, MARGIN + room[1] / 2))

    def __call__(self, x: float, y: float) -> tuple[float, float]:
        across, up = (np.array((x, y)) - self._middle) * self.scale
        return float(self._centre[0] + across), float(self._centre[1] - up)


def _points(scan: Scan, place: Place) -> Iterator[str]:
    spots = (place(x, y) for x, y in scan.xy[scan.valid].tolist())
    path = " ".join(f"M{x:.1f} {y:.1f}h0" for x, y in spots)
    yield f'<path class="points" d="{path}" stroke="{POINT}" stroke-width="3" stroke-linecap="round"/>'


def _segments(extraction: Extraction, place: Place) -> Iterator[str]:
    for number, (segment, colour) in enumerate(
        zip(extraction.segments, segment_colours(extraction.segments).tolist(), strict=True)
    ):
        (x1, y1), (x2, y2) = place(*segment.start), place(*segment.end)
        paint = f'stroke="rgb({colour[0]} {colour[1]} {colour[2]})" stroke-width="3" stroke-linecap="round"'
        words = f"segment {number}: beams {segment.first}–{segment.last}, {segment.length:.2f} m"
        line = f'<line class="segment" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {paint}>'
        yield f"{line}<title>{words}</title></line>"


def _laser(place: Place) -> Iterator[str]:
    x, y = place(0.0, 0.0)
    yield f'<path class="laser" d="M{x - 6:.1f} {y:.1f}h12M{x:.1f} {y - 6:.1f}v12" stroke="{INK}" stroke-width="2"/>'


def _marks(marks: Sequence[Mark], place: Place) -> Iterator[str]:
    for mark in marks:
        yield f'<g class="mark" stroke-width="{mark.width:g}" stroke-linecap="round"><title>{mark.words}</title>'
        for row, colour in zip(mark.xy.tolist(), mark.colours.tolist(), strict=True):
            spots = [place(*row[k : k + 2]) for k in range(0, len(row), 2)]
            (x1, y1), (x2, y2) = spots[0], spots[-1]
            yield f'<path d="M{x1:.2f} {y1:.2f}L{x2:.2f} {y2:.2f}" stroke="{_rgb(colour)}"/>'
        yield "</g>"


def _rgb(colour: Sequence[int]) -> str:
    return f"rgb({colour[0]} {colour[1]} {colour[2]})"


def _key(mark: Mark) -> tuple[str, str]:
    """The sign of a mark for the legend, around 0, 0, and its words."""
    colours = [_rgb(colour) for colour in dict.fromkeys(map(tuple, mark.colours.tolist()))][:4]
    if mark.xy.shape[1] == 2:
        sign = f'<circle r="{min(mark.width / 2, 5):g}" fill="{colours[0]}"/>'
        return sign, mark.words
    length = 20 / len(colours)
    strokes = (
        f'<path d="M{k * length - 10:g} 0h{length:g}" stroke="{colour}" stroke-width="{min(mark.width, 4):g}"/>'
        for k, colour in enumerate(colours)
    )
    return "".join(strokes), mark.words


def _segment_legend(scan: Scan, extraction: Extraction) -> list[tuple[str, str]]:
    segments, valid = extraction.segments, int(np.count_nonzero(scan.valid))
    counted = f"{len(segments)} segment{'' if len(segments) == 1 else 's'}"
    point = f'<circle r="3" fill="{POINT}"/>'
    lines = Mark(counted, 3.0, np.empty((len(segments), 4)), segment_colours(segments))
    return [(point, f"{valid} points, {extraction.covered} in segments"), _key(lines) if segments else ("", counted)]


def _told(thresholds: Thresholds) -> str:
    """ "ε = 0.03 m, δ = 0.1 m, …" """
    knobs = ((knob, getattr(thresholds, name)) for name, _, knob in thresholds.knobs())
    # A value stays with its name where the text is wrapped.
    return ", ".join(f"{knob.symbol} = {value:g} {knob.unit}".strip().replace(" ", "\u00a0") for knob, value in knobs)


def in_rows(legend: Sequence[tuple[str, str]]) -> list[list[tuple[float, str, str]]]:
    """The signs and words of the legend with their places [px], in as many rows as they need."""
    rows: list[list[tuple[float, str, str]]] = [[]]
    x = LEGEND_AT
    for sign, words in legend:
        width = 38 + 6.4 * len(words)
        if x + width > WIDTH and rows[-1]:
            x = LEGEND_AT
            rows.append([])
        rows[-1].append((x, sign, words))
        x += width
    return rows


def foot_of(
    legend: Sequence[Sequence[tuple[float, str, str]]], title: str, notes: Sequence[str], place: Place
) -> Iterator[str]:
    """Scale bar, legend, title and notes."""
    metres = bar_length(160 / place.scale)
    y, width = HEIGHT - place.foot + 24, metres * place.scale
    yield f'<path class="bar" d="M{MARGIN:g} {y - 5:g}v5h{width:.1f}v-5" fill="none" stroke="{INK}" stroke-width="2"/>'
    yield f'<text x="{MARGIN:g}" y="{y + 20:g}">{metres:g} m</text>'
    for row, entries in enumerate(legend):
        middle = y - 5 + ROW * row
        for x, sign, words in entries:
            yield f'<g transform="translate({x:.1f} {middle:g})">{sign}</g>'
            yield f'<text x="{x + 14:.1f}" y="{middle + 5:g}" font-size="{SMALL}">{words}</text>'
    below = y + 20 + ROW * (len(legend) - 1)
    yield f'<text x="{LEGEND_AT - 10:g}" y="{below:g}">{escape(title, quote=False)}</text>'
    for row, note in enumerate(notes):
        at = below + 2 + ROW * (row + 1)
        yield f'<text x="{MARGIN:g}" y="{at:g}" font-size="{SMALL}">{escape(note, quote=False)}</text>'


def bar_length(most: float) -> float:
    """The greatest of 1, 2 and 5 times a power of ten that is at most `most` [m], most > 0."""
    power = 10.0 ** math.floor(math.log10(most) + 1e-12)
    return power * max(step for step in STEPS if step * power <= most * (1 + 1e-9))
