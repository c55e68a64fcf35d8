"""A Picture as a list of nodes for a 2D canvas (static/stage/canvas.js), in the order in which they are drawn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lineseg.poses import in_world

from ..told.handout import FlatNode, FlatPicture, Look
from .looks import CLOUDS, IN_THE_WORLD, LINES, ORDER
from .palette import Colours
from .picture import Picture, Place
from .shapes import Lines, Points

# Coordinates are told to a hundredth of a millimetre, because close-ups stretch them.
DIGITS = 5
MOST_SHAPES = 30_000


def look_of(name: str) -> Look:
    """The look of a shape of a Picture."""
    if name in CLOUDS:
        px, shape = CLOUDS[name]
        return {"name": name, "kind": "points", "px": px, "shape": shape}
    return {"name": name, "kind": "lines", "px": LINES[name], "shape": ""}


def shapes_of(picture: Picture) -> list[tuple[str, NDArray[np.float32], Colours]]:
    """name, (n, 2 or 4) coordinates [m] and (n, 3) colours of each shape that is to be seen, in order."""
    every: dict[str, Points | Lines] = {**picture.points, **picture.lines}
    seen = [(name, every[name]) for name in ORDER if name in every and len(every[name].xyz)]
    return [_placed(name, shape, picture.place) for name, shape in seen]


def _placed(name: str, shape: Points | Lines, place: Place | None) -> tuple[str, NDArray[np.float32], Colours]:
    """A shape where it is in the world, if that is shown; a canvas draws fewer of many points."""
    step = -(-len(shape.xyz) // MOST_SHAPES)
    xy, colours = shape.xyz[::step, ..., :2], shape.colours[::step]
    if place is not None and place.pose is not None and name not in IN_THE_WORLD:
        corners = in_world(xy.reshape(-1, 2), np.array(place.pose), place.upside_down)
        xy = corners.reshape(xy.shape).astype(np.float32)
    return name, xy.reshape(len(xy), -1), colours


def flat(picture: Picture) -> FlatPicture:
    """The picture with its colours numbered."""
    palette: dict[str, int] = {}
    nodes: list[FlatNode] = []
    for name, xy, colours in shapes_of(picture):
        unique, each = np.unique(colours, axis=0, return_inverse=True)
        tones = np.array([palette.setdefault(code_of(colour), len(palette)) for colour in unique])
        rounded = np.round(xy.astype(float), DIGITS)
        nodes.append({**look_of(name), "xy": rounded.ravel().tolist(), "tones": tones[each.ravel()].tolist()})
    return {"palette": list(palette), "nodes": nodes}


def code_of(colour: NDArray[np.uint8]) -> str:
    """#rrggbb"""
    return "#" + bytes(colour.tolist()).hex()
