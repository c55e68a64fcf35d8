"""The other lasers of a robot: their scans that belong to a frame, or why they cannot be drawn with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording

from ..frame.geometry import Bounds, united
from ..told.drawn import Beside
from .palette import Colour, Theme
from .shapes import Points, points_at
from .world import MOST_LAST_POINTS, World

# A scan belongs to a frame if it was taken at most so much earlier or later [s].
LONGEST_APART = 0.5


@dataclass(frozen=True, eq=False)
class OtherLaser:
    """A topic of the recording.

    world: of its scans, None if they cannot be drawn; why: then the reason, None while it is being read.
    """

    topic: str
    world: World | None = None
    why: str | None = ""

    def frame_at(self, stamp: float) -> int | None:
        """The scan with a pose that was taken nearest to a time; None if there is none near it."""
        if self.world is None:
            return None
        known = self.world.known
        apart = np.abs(self.world.recording.stamps[known] - stamp)
        near = apart <= LONGEST_APART
        return int(known[np.argmin(np.where(near, apart, np.inf))]) if near.any() else None


def why_apart(one: Recording, other: Recording) -> str:
    """Why the scans of two lasers of a recording cannot be drawn in one world; "" if they can."""
    for each in (one, other):
        source = each.pose_source
        if each.poses is None:
            return f"{each.topic} has no poses: {source.missing}"
        if not source.mounted:
            return f"how {each.topic} is mounted on the robot is not known: {source.missing}"
    here, there = (each.pose_source.frames[:1] for each in (one, other))
    if here != there:
        return f"its poses are in {_root(there)}, those of {one.topic} in {_root(here)}"
    return ""


def _root(frames: tuple[str, ...]) -> str:
    return repr(frames[0]) if frames else "a frame without a name"


def scans_beside(lasers: Sequence[OtherLaser], stamp: float, theme: Theme) -> Points:
    """The scans of the other lasers at a time, each laser in its colour."""
    xy: list[NDArray[np.floating]] = [np.empty((0, 2))]
    colours = [np.empty((0, 3), np.uint8)]
    for number, laser in enumerate(lasers):
        frame = laser.frame_at(stamp)
        if laser.world is not None and frame is not None:
            xy.append(laser.world.points_of(np.array([frame]), MOST_LAST_POINTS))
            colours.append(np.tile(np.array(colour_of(number, theme), np.uint8), (len(xy[-1]), 1)))
    return points_at(np.concatenate(xy), np.concatenate(colours))


def bounds_around(world: World, lasers: Sequence[OtherLaser]) -> Bounds:
    """A box around a world and what the other lasers saw of it."""
    bounds = world.bounds
    for laser in lasers:
        bounds = united(bounds, laser.world.bounds) if laser.world is not None else bounds
    return bounds


def colour_of(number: int, theme: Theme) -> Colour:
    """The colour of the other laser with this number."""
    return (theme.second, theme.third, theme.fourth)[number % 3]


def beside_told(lasers: Sequence[OtherLaser], stamp: float, theme: Theme) -> list[Beside]:
    """What the page says of the other lasers."""
    told = list[Beside]()
    for number, laser in enumerate(lasers):
        absent = laser.world is not None and laser.frame_at(stamp) is None
        why = f"no scan with a pose within {LONGEST_APART:g} s of this one" if absent else laser.why
        colour = "#{:02x}{:02x}{:02x}".format(*colour_of(number, theme))
        told.append({"topic": laser.topic, "colour": colour, "why": why})
    return told
