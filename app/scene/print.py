"""A Picture from near by as SVG on a light ground, with its names and distances, for paper."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

import numpy as np
from numpy.typing import NDArray

from lineseg.writers.figure import bar_length

from ..frame.framing import Framing
from ..frame.geometry import Bounds
from .flat import code_of, look_of, shapes_of
from .picture import Picture

WIDTH, HEIGHT, MARGIN = 640.0, 300.0, 44.0
INK, GROUND = "#14161a", "#ffffff"
# Between the edge of a picture and a word [px]; about as wide as a letter is.
EDGE, LETTER = 6.0, 6.4
LINE = 14.0
# A name moves no farther than this many lines of text to lie beside what is drawn.
MOST_MOVED = 3
# What names lie beside.
BESIDE = ("segments", "growing", "first", "other")
NOT_PRINTED = {"invalid"}
INDEX = re.compile(r"(?<=[^\W_])_(\w+)(.*)")


def print_svg(picture: Picture, framing: Framing, words: str) -> str:
    """words: what it shows, for those who do not see it."""
    place = _Place(framing)
    shapes = [_shape(name, xy, colours, place) for name, xy, colours in shapes_of(picture) if name not in NOT_PRINTED]
    across = f"distances across the line are drawn {framing.factor} times as long" if framing.factor > 1 else ""
    return "".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" '
            f'aria-label="{escape(words)}" font-family="sans-serif" font-size="12" fill="{INK}">',
            f'<rect x="0.5" y="0.5" width="{WIDTH - 1:g}" height="{HEIGHT - 1:g}" fill="{GROUND}" stroke="#b9bec6"/>',
            *shapes,
            *_names(framing, place, _drawn(picture, place)),
            *_bar(place),
            f'<text x="{WIDTH - EDGE:g}" y="{HEIGHT - EDGE:g}" text-anchor="end">{across}</text>',
            "</svg>",
        ]
    )


class _Place:
    """Where places of the plan are in the picture [px]."""

    def __init__(self, framing: Framing) -> None:
        x1, y1, x2, y2 = framing.box
        room = np.array((WIDTH, HEIGHT)) - 2 * MARGIN
        self.scale = float((room / np.maximum((x2 - x1, y2 - y1), 1e-3)).min())
        self._middle = np.array(((x1 + x2) / 2, (y1 + y2) / 2))
        self._normal, self._at, self._more = np.array(framing.normal), np.array(framing.at), framing.factor - 1

    def __call__(self, xy: NDArray[np.floating]) -> NDArray[np.float64]:
        """(n, 2) [px] of (n, 2) [m]"""
        xy = np.asarray(xy, float).reshape(-1, 2)
        xy = xy + self._more * ((xy - self._at) @ self._normal)[:, None] * self._normal
        return (xy - self._middle) * (self.scale, -self.scale) + (WIDTH / 2, HEIGHT / 2)


def _shape(name: str, xy: NDArray[np.float32], colours: NDArray[np.uint8], place: _Place) -> str:
    look, spots = look_of(name), place(xy).reshape(len(xy), -1, 2)
    low, high = spots.min(axis=1), spots.max(axis=1)
    seen = (high >= 0).all(axis=1) & (low <= (WIDTH, HEIGHT)).all(axis=1)
    width = 2 * look["px"] if look["kind"] == "points" else look["px"]
    paths = []
    for colour in np.unique(colours[seen], axis=0):
        same = spots[seen & (colours == colour).all(axis=1)]
        path = "".join(f"M{each[0, 0]:.1f} {each[0, 1]:.1f}L{each[-1, 0]:.1f} {each[-1, 1]:.1f}" for each in same)
        paths.append(f'<path d="{path}" stroke="{code_of(colour)}"/>')
    return f'<g stroke-width="{width:g}" stroke-linecap="round">{"".join(paths)}</g>'


def _drawn(picture: Picture, place: _Place) -> NDArray[np.float64]:
    """(n, 2, 2) the lines that names lie beside [px]."""
    lines = [picture.lines[name].xyz[..., :2].reshape(-1, 2) for name in BESIDE if name in picture.lines]
    return place(np.concatenate([*lines, np.empty((0, 2))])).reshape(-1, 2, 2)


def _names(framing: Framing, place: _Place, drawn: NDArray[np.float64]) -> Iterator[str]:
    """Names and distances, none over another. drawn: lines that they lie beside, where there is room."""
    taken: list[tuple[float, float, float]] = []
    for each in framing.measures:
        (x1, y1), (x2, y2) = place(np.array((each.start, each.end)))
        path = f"M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}"
        yield f'<path d="{path}" stroke="{INK}" stroke-width="1.2" stroke-dasharray="4 2"/>'
        yield _word(each.text, (x1 + x2) / 2 + 2 * EDGE, (y1 + y2) / 2, taken, drawn)
    for name in framing.names:
        ((x, y),) = place(np.array(name.at))
        yield _word(name.text, x + EDGE, y - 2 * EDGE, taken, drawn)


def _word(words: str, x: float, y: float, taken: list[tuple[float, float, float]], drawn: NDArray[np.float64]) -> str:
    """A word inside the picture, as near to its place as others leave room."""
    wide = LETTER * len(words)
    x = min(max(x, EDGE), WIDTH - wide - EDGE)
    y = min(max(y, LINE), HEIGHT - EDGE)

    def free(at: float) -> bool:
        return all(abs(at - other) >= LINE or x + wide < left or right < x for left, right, other in taken)

    steps = [k * way * LINE for k in range(int(HEIGHT / LINE)) for way in (-1, 1)]
    places = [y + by for by in steps if LINE <= y + by <= HEIGHT - EDGE and free(y + by)]
    near = (at for at in places if abs(at - y) <= MOST_MOVED * LINE)
    clear = (at for at in near if not _crossed(drawn, (x, at - LINE, x + wide, at + EDGE)).any())
    y = next(clear, places[0] if places else y)
    taken.append((x, x + wide, y))
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" paint-order="stroke" stroke="{GROUND}" stroke-width="5"'
        f' stroke-linejoin="round">'
        f"{INDEX.sub(_lowered, escape(words, quote=False))}</text>"
    )


def _crossed(lines: NDArray[np.float64], box: Bounds) -> NDArray[np.bool_]:
    """Which of the lines (n, 2, 2) have a part in the box."""
    start, step = lines[:, 0], lines[:, 1] - lines[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        ways = (np.array(box).reshape(2, 1, 2) - start) / step
    # A line along an axis is at all times between the edges across it, or at none.
    inside = (start >= box[:2]) & (start <= box[2:])
    enter = np.where(step == 0, np.where(inside, -np.inf, np.inf), ways.min(axis=0))
    leave = np.where(step == 0, np.inf, ways.max(axis=0))
    return np.maximum(enter.max(axis=1), 0) < np.minimum(leave.min(axis=1), 1)


def _lowered(index: re.Match[str]) -> str:
    """An index below the line; what follows goes back up."""
    return f'<tspan dy="3" font-size="75%">{index[1]}</tspan><tspan dy="-3">{index[2]}</tspan>'


def _bar(place: _Place) -> Iterator[str]:
    """The scale along the line."""
    metres = bar_length(160 / place.scale)
    words = f"{metres:g} m" if metres >= 1 else f"{100 * metres:g} cm"
    y = HEIGHT - 2 * EDGE
    yield f'<path d="M{EDGE:g} {y:g}h{metres * place.scale:.1f}" stroke="{INK}" stroke-width="2"/>'
    yield f'<text x="{2 * EDGE + metres * place.scale:.1f}" y="{y + 4:g}">{words}</text>'
