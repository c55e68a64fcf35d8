"""Whether a frame that lacks a line of its neighbours shows enough of it for the lack to be a failure."""

from __future__ import annotations

import math

from ..kernel import entry_kernel, kernel
from ..region_growing.points import is_valid
from .neighbours import SAME_ANGLE, SAME_DISTANCE

# Lines of P_min points or L_min metres come and go as the robot moves: this many times as much counts.
AMPLE = 1.5
# A return differs by less than this from where its beam meets the line [m], or it is of something else.
OFF_LINE = 0.15
# So large a share of a wall is not hidden from one frame alone by what passes by.
ALL_HIDDEN = 0.9


@entry_kernel
def shows_enough(ends, rays, ranges, range_min, range_max, min_points, min_length):
    """Whether a line (x1, y1, x2, y2) should have been found; rays: (2·beams,) cosines, then sines.

    The beams that point at it count if they have no return or one that lies on it: AMPLE times P_min of them, along
    AMPLE times L_min. A line that something nearer hides in part is rightly missing. One that is hidden altogether is
    not, because neither neighbour sees anything there.
    """
    beams, nearer, beyond = beams_at(ends, rays, ranges, range_min, range_max)
    if beams < AMPLE * min_points:
        return False
    length = ((ends[2] - ends[0]) ** 2 + (ends[3] - ends[1]) ** 2) ** 0.5
    seen = beams - nearer - beyond
    ample = seen >= AMPLE * min_points and length * seen >= AMPLE * min_length * beams
    return ample or (nearer > ALL_HIDDEN * beams and length >= AMPLE * min_length)


@entry_kernel
def is_there(ends, segments, rays, ranges):
    """Whether most of the beams that point at a line are in segments of this frame that show the same wall.

    A segment shows it where its returns lie on the line, or if it is parallel to it. So nothing is missing where a wall
    is cut elsewhere in this frame, such as at a bend, or where the motion between the frames is misjudged.
    """
    n, pointing, told = len(ranges), 0, 0
    dx, dy = ends[2] - ends[0], ends[3] - ends[1]
    length = math.sqrt(dx * dx + dy * dy)
    for k in range(n):
        pointing += meeting(ends, rays[k], rays[n + k]) > 0.0
    for i in range(len(segments)):
        row = segments[i]
        parallel = abs(dx * row.a + dy * row.b) < SAME_ANGLE * length
        for step in range((row.last - row.first) % n + 1):
            k = (row.first + step) % n
            expected = meeting(ends, rays[k], rays[n + k])
            told += expected > 0.0 and (parallel or abs(ranges[k] - expected) < SAME_DISTANCE)
    return 2 * told > pointing


@kernel
def beams_at(ends, rays, ranges, range_min, range_max):
    """How many beams point at a line, and how many of them return from before it, and from beyond it."""
    n, beams, nearer, beyond = len(ranges), 0, 0, 0
    for k in range(n):
        expected, found = meeting(ends, rays[k], rays[n + k]), ranges[k]
        if expected > 0.0:
            beams += 1
            if is_valid(found, range_min, range_max):
                nearer += found < expected - OFF_LINE
                beyond += found > expected + OFF_LINE
    return beams, nearer, beyond


@kernel
def meeting(ends, cos, sin):
    """The range at which a beam meets a line between its ends, or −1."""
    x1, y1, dx, dy = ends[0], ends[1], ends[2] - ends[0], ends[3] - ends[1]
    across = cos * dy - sin * dx
    if across == 0.0:
        return -1.0
    along = (x1 * sin - y1 * cos) / across
    return (x1 * dy - y1 * dx) / across if 0.0 <= along <= 1.0 else -1.0
