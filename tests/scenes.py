"""Scenes for the tests, built from geometry."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from lineseg import Scan


def scan_of(walls, beams=180, field_of_view=np.pi, noise=0.0, seed=0, bump=None, lost=(), **fields) -> Scan:
    """Scan of walls (x1, y1, x2, y2) from the origin; `bump` adds to ranges, `lost` beams return nothing."""
    full = field_of_view >= 2 * np.pi
    bearings = np.linspace(-field_of_view / 2, field_of_view / 2, beams + full)[:beams]
    ranges = np.min([_ranges_to(np.array(wall, float), bearings) for wall in walls], axis=0)
    ranges += np.random.default_rng(seed).normal(0, noise, beams) if noise else 0
    for beam, extra in (bump or {}).items():
        ranges[beam] += extra
    ranges[list(lost)] = np.nan
    ranges[np.isinf(ranges)] = np.nan
    return Scan(ranges, bearings, **fields)


def _ranges_to(wall, bearings):
    start, along = wall[:2], wall[2:] - wall[:2]
    rays = np.column_stack((np.cos(bearings), np.sin(bearings)))
    cross = rays[:, 0] * along[1] - rays[:, 1] * along[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (start[0] * along[1] - start[1] * along[0]) / cross
        share = (start[0] * rays[:, 1] - start[1] * rays[:, 0]) / cross
    return np.where((distance > 0) & (share >= 0) & (share <= 1), distance, np.inf)


def wall_ahead(distance=2.0, half_width=1.5, **options) -> Scan:
    """A wall across the x axis, as wide as the field of view or narrower."""
    options.setdefault("field_of_view", 1.2)
    return scan_of([(distance, -half_width, distance, half_width)], **options)


def corner(**options) -> Scan:
    return scan_of([(3, -4, 3, 2), (3, 2, -4, 2)], **options)


def room(width=6.0, depth=4.0, **options) -> Scan:
    """A rectangular room around the laser, seen all round."""
    x, y = 0.55 * width, 0.45 * depth
    left, below = x - width, y - depth
    options.setdefault("beams", 360)
    return scan_of(
        [(x, below, x, y), (x, y, left, y), (left, y, left, below), (left, below, x, below)],
        field_of_view=2 * np.pi,
        **options,
    )


def chipped(scan: Scan, missing: int) -> Scan:
    """The scan without its last beams, as some drivers leave a full circle."""
    wall = None if scan.wall is None else scan.wall[:-missing]
    return Scan(scan.ranges[:-missing], scan.bearings[:-missing], wall=wall)


@st.composite
def scans(draw, full_circle=None) -> Scan:
    """Rooms with furniture, noise and lost beams, seen in part or all round."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    around = draw(st.booleans()) if full_circle is None else full_circle
    beams = draw(st.integers(40, 260))
    size = rng.uniform(1.5, 8, 2)
    offset = rng.uniform(-0.4, 0.4, 2) * size
    (x, y), (left, below) = size / 2 + offset, offset - size / 2
    walls = [(x, below, x, y), (x, y, left, y), (left, y, left, below), (left, below, x, below)]
    for _ in range(draw(st.integers(0, 4))):
        centre, half = rng.uniform(-0.5, 0.5, 2) * size + offset, rng.uniform(-0.6, 0.6, 2)
        walls.append((*(centre - half), *(centre + half)))
    noise = draw(st.sampled_from([0.002, 0.01, 0.03]))
    scan = scan_of(walls, beams, 2 * np.pi if around else rng.uniform(1, 5.5), noise, int(rng.integers(1 << 30)))
    lost = rng.random(beams) < draw(st.sampled_from([0, 0.02, 0.3]))
    spiky = rng.random(beams) < draw(st.sampled_from([0, 0.05]))
    ranges = np.where(spiky, scan.ranges * rng.uniform(0.3, 1.2, beams), scan.ranges)
    return Scan(np.where(lost, np.nan, ranges), scan.bearings)
