"""The rays of many scans; scans with the same geometry share them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..scan import MOST_MISSING, SEAM, Recording, regular_fan


class Geometry(NamedTuple):
    """The geometry of consecutive frames, with the same numbers as `Scan` computes.

    bearings: (total,) [rad], one geometry after another; rays: (2·total,) cosines, then sines, of each geometry.
    place: (frames,) where the geometry of a frame starts in `bearings`; around: (frames,) see `Scan.around`.
    """

    bearings: NDArray[np.float64]
    rays: NDArray[np.float64]
    place: NDArray[np.int64]
    around: NDArray[np.int64]


def geometry_of(recording: Recording, start: int, stop: int) -> Geometry:
    """The geometry of the frames start..stop − 1 of a recording, stop > start."""
    lengths = np.diff(recording.offsets[start : stop + 1])
    new = _differs_from_the_one_before(recording, start, stop, lengths)
    which = np.cumsum(new) - 1
    frames = start + np.flatnonzero(new)
    places = np.concatenate(([0], np.cumsum(lengths[new])))
    if recording.bearings is None and len(frames) == 1:
        numbers = float(recording.angle_min[start]), float(recording.angle_increment[start]), int(lengths[0])
        bearings, rays, around = regular_fan(*numbers)
        turns = np.full(stop - start, around)
        return Geometry(bearings.astype(np.float64), rays.flatten().astype(np.float64), places[which], turns)
    bearings = _bearings(recording, frames, places)
    along = np.arange(places[-1]) + np.repeat(places[:-1], np.diff(places))
    rays = np.empty(2 * places[-1])
    rays[along] = np.cos(bearings)
    rays[along + np.repeat(np.diff(places), np.diff(places))] = np.sin(bearings)
    bearings = bearings.astype(np.float64)
    around = np.zeros(len(frames), np.int64)
    find_full_circles(bearings, places, around)
    return Geometry(bearings, rays, places[which], around[which])


def _differs_from_the_one_before(recording: Recording, start: int, stop: int, lengths: NDArray) -> NDArray[np.bool_]:
    new = np.ones(stop - start, np.bool_)
    new[1:] = np.diff(lengths) != 0
    if recording.bearings is not None:
        find_new(recording.bearings, recording.offsets[start : stop + 1], new)
        return new
    for column in (recording.angle_min[start:stop], recording.angle_increment[start:stop]):
        new[1:] |= column[1:] != column[:-1]
    return new


def _bearings(recording: Recording, frames: NDArray[np.int64], places: NDArray[np.int64]) -> NDArray[np.floating]:
    """The bearings of the given frames, concatenated."""
    if recording.bearings is not None:
        offsets = recording.offsets
        return np.concatenate([recording.bearings[offsets[frame] : offsets[frame + 1]] for frame in frames.tolist()])
    beams = np.diff(places)
    number = np.arange(places[-1]) - np.repeat(places[:-1], beams)
    angle_min = recording.angle_min[frames].astype(np.float64)
    increment = recording.angle_increment[frames].astype(np.float64)
    return np.repeat(angle_min, beams) + np.repeat(increment, beams) * number


@entry_kernel
def find_new(bearings, offsets, new):
    """Mark the frames whose bearings differ from the previous frame; `new` already marks other numbers of beams."""
    for frame in range(1, len(new)):
        before, here = offsets[frame - 1], offsets[frame]
        k, beams = 0, offsets[frame + 1] - here
        while not new[frame] and k < beams:
            new[frame] = bearings[before + k] != bearings[here + k]
            k += 1


@entry_kernel
def find_full_circles(bearings, places, around):
    """`Scan.around` of each geometry, with the median of the steps found without sorting; around: zeros."""
    for i in range(len(around)):
        first, last = places[i], places[i + 1] - 1
        seam = 2.0 * math.pi
        for k in range(first, last):
            seam -= abs(bearings[k + 1] - bearings[k])
        most, missing = MOST_MISSING if seam <= SEAM else 0, 0
        while missing <= most and not median_exceeds(bearings, first, last, seam / (missing + 1.5)):
            missing += 1
        if missing <= most and last - first >= 2:
            around[i] = last - first + 1 + missing


@kernel
def median_exceeds(bearings, first, last, limit):
    """Whether the median of |bearings[k + 1] − bearings[k]|, k = first..last − 1, is more than `limit`."""
    above, below, least_above, most_below = 0, 0, math.inf, -math.inf
    for k in range(first, last):
        step = abs(bearings[k + 1] - bearings[k])
        if step > limit:
            above += 1
            least_above = min(least_above, step)
        else:
            below += 1
            most_below = max(most_below, step)
    if above == below:
        return 0.5 * (least_above + most_below) > limit
    return above > below
