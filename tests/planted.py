"""Known failures of extraction, planted in a recording: with the thresholds FAILING, each is one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lineseg import Params, Recording, Scan, Segment, extract

Plant = Callable[[Scan, np.random.Generator], np.ndarray | None]
# By default no line crosses an open door, and one of the failures is that it does. The weights of the suspicion were
# chosen without growth of ε.
FAILING = Params(max_void=0.0, epsilon_growth=0.0)


def _wall(scan: Scan, rng: np.random.Generator, points: int, length: float) -> np.ndarray | None:
    """The beams of a wall with at least this many points and metres, not seen at a grazing angle."""
    found = extract(scan)

    def is_good(wall: Segment) -> bool:
        middle = np.hypot(*np.add(wall.start, wall.end)) / 2
        return wall.points >= points and wall.length >= length and wall.rho > 0.5 * middle

    good = [label for label, wall in enumerate(found.segments) if is_good(wall)]
    return np.flatnonzero(found.labels == rng.choice(good)) if good else None


def split_wall(scan, rng):
    """A wall behind posts: groups of consecutive beams are lost, and one segment becomes several."""
    wall = _wall(scan, rng, 50, 1.8)
    if wall is None:
        return None
    ranges = scan.ranges.copy()
    along = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(scan.xy[wall], axis=0).T))))
    for post in np.arange(0.7, along[-1] - 0.7, 0.7):
        first = int(np.searchsorted(along, post))
        ranges[wall[first : first + 4]] = np.nan
    return ranges


def missed_wall(scan, rng):
    """A wall appears rougher than ε, so its line is not found."""
    wall = _wall(scan, rng, 40, 1.2)
    if wall is None:
        return None
    ranges = scan.ranges.copy()
    ranges[wall] += rng.normal(0, 0.045, len(wall))
    return ranges


def bridged_door(scan, rng):
    """A few beams pass through an open door in a wall seen at a grazing angle, and the line continues beyond it."""
    found = extract(scan, FAILING)
    doors = []
    for k in range(len(found.segments)):
        beams = np.flatnonzero(found.labels == k)[3:-6]
        doors += [beam for beam in beams if 0.8 < np.hypot(*(scan.xy[beam + 4] - scan.xy[beam])) < 2.0]
    for beam in rng.permutation(doors).astype(int):
        ranges = scan.ranges.copy()
        ranges[beam + 1 : beam + 4] = np.nan
        labels = extract(Scan(ranges, scan.bearings, scan.range_min, scan.range_max), FAILING).labels
        if labels[beam] == labels[beam + 4] >= 0:
            return ranges
    return None


def noise_burst(scan, rng):
    """Every range is noisy, as in sunlight."""
    return scan.ranges + rng.normal(0, 0.03, len(scan))


def shifted_sensor(scan, rng):
    """The whole sweep is turned by some degrees, as by a knock."""
    return np.roll(scan.ranges, int(rng.choice((-1, 1))) * int(rng.integers(40, 90)))


def dropped_sector(scan, rng):
    """The sector of one wall, and as much on either side, is lost, as behind a hand."""
    wall = _wall(scan, rng, 60, 1.2)
    if wall is None:
        return None
    ranges, half = scan.ranges.copy(), len(wall) // 2
    ranges[max(wall[0] - half, 0) : wall[-1] + half] = np.nan
    return ranges


def lost_beams(scan, rng):
    """Every third beam is lost, as in rain."""
    return np.where(rng.random(len(scan)) < 0.35, np.nan, scan.ranges)


def ghost_wall(scan, rng):
    """A board is carried past, one metre before the laser."""
    width = len(scan) // 4
    free = [k for k in range(0, len(scan) - width, 10) if np.nanmin(scan.ranges[k : k + width]) > 1.5]
    if not free:
        return None
    beams = rng.choice(free) + np.arange(width)
    ranges = scan.ranges.copy()
    middle = scan.bearings[beams[width // 2]]
    ranges[beams] = 1.0 / np.cos(scan.bearings[beams] - middle) + rng.normal(0, 0.005, width)
    return ranges


def bent_wall(scan, rng):
    """A wall bends, as when the sensor turns while it sweeps: the fits become poor."""
    wall = _wall(scan, rng, 60, 1.2)
    if wall is None:
        return None
    ranges = scan.ranges.copy()
    ranges[wall] += 0.12 * np.sin(np.linspace(0, 2 * np.pi, len(wall)))
    return ranges


def quantised(scan, rng):
    """Ranges come in steps of 8 cm, as from a wrongly configured device."""
    return np.round(scan.ranges / 0.08) * 0.08


PLANTS: tuple[Plant, ...] = (
    split_wall, missed_wall, bridged_door, noise_burst, shifted_sensor, dropped_sector, lost_beams, ghost_wall,
    bent_wall, quantised,
)  # fmt: skip


def planted(recording: Recording, seed: int) -> tuple[Recording, dict[int, str]]:
    """The recording with one of each of PLANTS in frames that are not neighbours, and which frame has which."""
    rng = np.random.default_rng(seed)
    free = list(rng.permutation(np.arange(2, len(recording) - 2)))
    ranges, where = recording.ranges.copy(), {}
    for plant in PLANTS:
        for frame in [int(each) for each in free if all(abs(each - taken) > 2 for taken in where)]:
            changed = plant(recording[frame], rng)
            if changed is not None:
                ranges[recording.offsets[frame] : recording.offsets[frame + 1]] = changed
                where[frame] = plant.__name__
                break
    return replace(recording, ranges=ranges), where
