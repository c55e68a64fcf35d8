"""Cuts a run of bearings into scans: turns that begin anywhere, and parts of a turn."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...scan import Floats
from ..guessing import middle_of

# A beam so far ahead, where the angle also leaps back, begins the next scan rather than following a gap.
WIDE = np.deg2rad(30)
# So many steps one after the other in the other sense are a sweep back, and not jitter.
STEADY = 10
# Sweeps to and fro have so many beams.
LONG_SWEEP = 30
# A motor's steps are more even than those of anything else that goes to and fro.
OF_SERVO = 0.1


def turns(bearings: Floats) -> list[int]:
    """Half-open edges of the scans in `bearings` [rad]: 0, the start of each further scan, and the number of beams.

    A scan ends before the beam that would pass the direction of its first beam again, or where the angle leaps back.
    """
    edges = [0]
    for start, stop in pairwise([0, *_reversals(bearings), len(bearings)]):
        edges += [start + edge for edge in _one_way(bearings[start:stop])[1:]]
    return edges


def _reversals(bearings: Floats) -> list[int]:
    """Where a laser that sweeps to and fro turns back for good."""
    steps = np.sign((np.diff(bearings) + np.pi) % (2 * np.pi) - np.pi)
    if len(steps) < 2 * STEADY or (steps >= 0).all() or (steps <= 0).all():
        return []
    changes = np.flatnonzero(np.diff(steps)) + 1
    edges, last = [], 0.0
    for start, stop in pairwise([0, *changes.tolist(), len(steps)]):
        if stop - start >= STEADY and steps[start] and steps[start] != last:
            edges += [start] if last else []
            last = steps[start]
    return edges


def _one_way(bearings: Floats) -> list[int]:
    """The edges of scans that all go the same way."""
    if len(bearings) < 2:
        return [0, len(bearings)]
    raw = np.diff(bearings)
    step = _step(raw)
    if step < 0:
        raw = -raw
    step = abs(step)
    ahead = raw % (2 * np.pi)
    back = np.minimum(WIDE, 10 * step)
    # Angles jitter, so that a small step back is one.
    ahead = np.where(ahead > 2 * np.pi - back, ahead - 2 * np.pi, ahead)
    leaps = (raw < -back) & (ahead > WIDE)
    travelled = np.concatenate(([0.0], np.cumsum(ahead)))
    limit = 2 * np.pi - min(step / 2, np.pi)
    hard = (np.flatnonzero(leaps) + 1).tolist()
    edges, start = [0], 0
    farthest = np.maximum.accumulate(travelled)
    while True:
        passed = int(np.searchsorted(farthest, travelled[start] + limit))
        next_hard = next((at for at in hard if at > start), len(bearings))
        start = max(start + 1, min(passed, next_hard))
        if start >= len(bearings):
            return [*edges, len(bearings)]
        edges.append(start)
        hard = hard[hard.index(next_hard) :] if next_hard in hard else []


def evenness(bearings: Floats) -> float:
    """`regularity`, also of bearings that sweep to and fro: that of the least regular of its sweeps."""
    edges = [0, *_reversals(bearings[np.isfinite(bearings)]), len(bearings)]
    sweeps = [bearings[start:stop] for start, stop in pairwise(edges)]
    if 1 < len(sweeps) <= len(bearings) // LONG_SWEEP and (worst := max(map(regularity, sweeps))) < OF_SERVO:
        return worst
    return regularity(bearings)


def regularity(bearings: Floats) -> float:
    """How unequal the steps of bearings [rad] are: 0 if all are equal, large if they are not those of a laser."""
    bearings = bearings[np.isfinite(bearings)]
    if len(bearings) < 3:
        return 0.0
    steps = (np.diff(bearings) + np.pi) % (2 * np.pi) - np.pi
    middle = middle_of(np.sort(steps))
    if middle == 0:
        return np.inf
    sideways = np.count_nonzero(steps <= 0 if middle > 0 else steps >= 0) / len(steps)
    return middle_of(np.sort(np.abs(steps - middle))) / abs(middle) + (sideways if sideways > 0.1 else 0.0)


def _step(raw: Floats) -> float:
    """The usual step between beams, without the leaps of the seam."""
    small = raw[np.abs(raw) < np.pi]
    return middle_of(np.sort(small)) or middle_of(np.sort(raw)) or 1e-3
