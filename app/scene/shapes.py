"""The shapes of a picture: points and line segments in the plane z = 0."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .palette import Colour, Colours


@dataclass(frozen=True, eq=False)
class Points:
    """xyz: (n, 3) float32 [m]; colours: (n, 3) sRGB."""

    xyz: NDArray[np.float32]
    colours: Colours


@dataclass(frozen=True, eq=False)
class Lines:
    """xyz: (n, 2, 3) float32 [m]; colours: (n, 3) sRGB, one for each line."""

    xyz: NDArray[np.float32]
    colours: Colours


def points_at(xy: ArrayLike, colours: Colours | Colour) -> Points:
    """Points at (n, 2), in one colour or one colour each; points that are not finite are left out."""
    flat = np.asarray(xy, dtype=float).reshape(-1, 2)
    each, finite = _each(colours, len(flat)), np.isfinite(flat)
    if finite.all():
        return Points(_raised(flat), each)
    kept = finite.all(axis=1)
    return Points(_raised(flat[kept]), each[kept])


def lines_between(starts: ArrayLike, ends: ArrayLike, colours: Colours | Colour) -> Lines:
    """Lines from (n, 2) to (n, 2); lines that are not finite are left out."""
    starts = np.asarray(starts, float).reshape(-1, 2)
    both = np.empty((len(starts), 2, 2))
    both[:, 0], both[:, 1] = starts, np.asarray(ends, float).reshape(-1, 2)
    each = _each(colours, len(both))
    finite = np.isfinite(both)
    if finite.all():
        return Lines(_raised(both), each)
    kept = finite.all(axis=(1, 2))
    return Lines(_raised(both[kept]), each[kept])


def joined(*parts: Lines) -> Lines:
    return Lines(np.concatenate([part.xyz for part in parts]), np.concatenate([part.colours for part in parts]))


def dashed(starts: NDArray, ends: NDArray, dash: float, colours: Colours | Colour, most: int = 4000) -> Lines:
    """The lines dashed, with gaps as long as the dashes; very long lines get longer dashes.

    Lines that are not finite are left out.
    """
    finite = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
    starts, ends, colours = starts[finite], ends[finite], _each(colours, len(starts))[finite]
    lengths = np.linalg.norm(ends - starts, axis=1)
    dash = max(dash, float(lengths.sum()) / (2 * most))
    dashes = np.ceil(lengths / (2 * dash)).astype(int)
    line = np.repeat(np.arange(len(lengths)), dashes)
    place = 2 * dash * (np.arange(len(line)) - np.repeat(np.cumsum(dashes) - dashes, dashes))
    start, along = starts[line], ((ends - starts) / np.maximum(lengths, 1e-12)[:, None])[line]
    stop = np.minimum(place + dash, lengths[line])
    return lines_between(start + place[:, None] * along, start + stop[:, None] * along, colours[line])


def _raised(xy: NDArray) -> NDArray[np.float32]:
    """(…, 2) → (…, 3) with z = 0."""
    xyz = np.zeros((*xy.shape[:-1], 3), np.float32)
    xyz[..., :2] = xy
    return xyz


def _each(colours: Colours | Colour, n: int) -> Colours:
    each = np.empty((n, 3), np.uint8)
    each[:] = colours
    return each
