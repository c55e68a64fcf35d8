"""Compares a frame's segments with those of the previous and next frame: which only it has, or only it lacks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..scan import Recording
from ..total_least_squares import signed_distance

# A turn between two frames is sought within ±MOST_TURN [rad], its sine in steps of one VOTES-th.
MOST_TURN = 0.75
VOTES = 151
# Two lines closer than this [rad, m] are the same line.
SAME_ANGLE = 0.1
SAME_DISTANCE = 0.1
# Largest distance [m] between paired lines in each round of finding the motion.
REACHES = (0.4, 0.15)
# The work grows with the square of the segments, so a frame with more is not compared.
MOST_SEGMENTS = 256


@entry_kernel
def compare_frames(segments, offsets, views, start, stop, votes, brief, gone, jump, jolt, turn, cancelled):
    """Write five scores of the frames start..stop − 1; views: (frames, 2), see `views_of`; votes: (VOTES,) memory.

    brief: total length of the segments that neither the previous nor the next frame has, after correcting for motion
    [m]; gone: of those that both have and this frame lacks although it looks there [m]. jump: how many more, or fewer,
    segments the frame has than both. turn: angle by which the sensor turned since the previous frame [rad]; jolt: see
    `turned_back`; both 0 unless the lines show that it turned so, see `explains`. All are 0 for the first and the last
    frame.
    """
    known = -1
    forth = (1.0, 0.0, 0.0, 0.0)
    for frame in range(max(start, 1), min(stop, len(offsets) - 2)):
        if cancelled[0]:
            return
        here = segments[offsets[frame] : offsets[frame + 1]]
        before = segments[offsets[frame - 1] : offsets[frame]]
        behind = segments[offsets[frame + 1] : offsets[frame + 2]]
        fewest, most = min(len(before), len(behind)), max(len(before), len(behind))
        jump[frame] = max(0, len(here) - most, fewest - len(here))
        if max(len(here), most) <= MOST_SEGMENTS:
            come = forth if known == frame - 1 else motion_between(before, here, votes)
            forth, known = motion_between(here, behind, votes), frame
            back = reversed_motion(come)
            for i in range(len(here)):
                if is_brief(here[i], before, back, behind, forth):
                    brief[frame] += here[i].length
            past, sought = come, False
            for i in range(len(before)):
                if is_lost(before[i], here, come, views[frame]):
                    # Most frames lose nothing, so this motion is not needed.
                    if not sought:
                        past, sought = motion_between(before, behind, votes), True
                    if is_among(before[i], behind, past):
                        gone[frame] += before[i].length
            if explains(come, before, here):
                turn[frame] = abs(math.asin(come[1]))
                if explains(forth, here, behind):
                    jolt[frame] = turned_back(come, forth)


@entry_kernel
def mark_frame(before, here, behind, view, votes, brief, gone):
    """Mark the segments that `brief` and `gone` count: (len(here),) and (len(before),) bool; view: a row of `views_of`.

    Returns the motions from the previous frame to this one, and from this one to the next.
    """
    to_here, to_behind = motion_between(before, here, votes), motion_between(here, behind, votes)
    back, past = reversed_motion(to_here), motion_between(before, behind, votes)
    for i in range(len(here)):
        brief[i] = is_brief(here[i], before, back, behind, to_behind)
    for i in range(len(before)):
        gone[i] = is_gone(before[i], here, to_here, behind, past, view)
    return to_here, to_behind


def views_of(recording: Recording) -> NDArray[np.float64]:
    """(frames, 2) least and greatest bearing of each frame [rad], unwrapped."""
    if recording.bearings is None:
        last = recording.angle_min + recording.angle_increment * (np.diff(recording.offsets) - 1)
        return np.sort(np.column_stack((recording.angle_min, last)).astype(np.float64), axis=1)
    spans = [np.unwrap(scan.bearings) if len(scan) else np.zeros(1) for scan in recording]
    return np.array([(span.min(), span.max()) for span in spans]).reshape(-1, 2)


@kernel
def turned_back(come, forth):
    """Angle [rad] by which the sensor turned to this frame and back again to the next; 0 if it turned on, or rested.

    A robot that turns, or begins to, is no reason for doubt; a knock is.
    """
    turn, back = math.asin(come[1]), -math.asin(forth[1])
    return min(abs(turn), abs(back)) if turn * back > 0.0 else 0.0


@kernel
def explains(motion, here, there):
    """Whether more than half of the lines, by length, are those of the other frame after the motion.

    Where few lines are the same, any turn aligns some of them.
    """
    whole = found = 0.0
    for i in range(len(here)):
        whole += here[i].length
        if is_among(here[i], there, motion):
            found += here[i].length
    return 2.0 * found > whole


@kernel
def is_brief(segment, before, back, behind, forth):
    return not is_among(segment, before, back) and not is_among(segment, behind, forth)


@kernel
def is_gone(segment, here, to_here, behind, to_behind, view):
    return is_lost(segment, here, to_here, view) and is_among(segment, behind, to_behind)


@kernel
def is_lost(segment, here, to_here, view):
    """Whether this frame lacks a segment of the previous frame although it looks there."""
    return not is_among(segment, here, to_here) and is_in_view(segment, to_here, view)


@kernel
def is_in_view(segment, motion, view):
    """Whether some beam points at the middle of a moved segment."""
    x1, y1, x2, y2 = moved(segment, motion)
    return (math.atan2(y1 + y2, x1 + x2) - view[0]) % (2.0 * math.pi) <= view[1] - view[0]


@kernel
def reversed_motion(motion):
    cos, sin, x, y = motion
    return cos, -sin, -(cos * x + sin * y), sin * x - cos * y


@kernel
def motion_between(here, there, votes):
    """(cos, sin, x, y) of the motion that aligns the segments of one frame with those of another.

    The turn is the one that most pairs of segments agree on, weighted by shared length. The shift then minimises
    Σ w·(distance between paired lines)² in a few rounds, each line paired with the nearest one it overlaps. A
    direction that no line constrains, such as along a bare corridor, stays 0.
    """
    turn = turn_between(here, there, votes)
    motion = (math.cos(turn), math.sin(turn), 0.0, 0.0)
    for reach in REACHES:
        motion = shifted(here, there, motion, reach)
    return motion


@kernel
def turn_between(here, there, votes):
    votes[:] = 0.0
    wide = 2.0 * math.sin(MOST_TURN) / VOTES
    for i in range(len(here)):
        for j in range(len(there)):
            cross, dot = crossing(here[i], there[j])
            if dot > 0.0 and abs(cross) < math.sin(MOST_TURN):
                votes[int((cross + math.sin(MOST_TURN)) / wide)] += min(here[i].length, there[j].length)
    best, most = VOTES // 2, 0.0
    for k in range(1, VOTES - 1):
        total = votes[k - 1] + votes[k] + votes[k + 1]
        # In a tie the smaller turn wins; sums of the same lengths in another order count as equal.
        smaller = abs(k - VOTES // 2) < abs(best - VOTES // 2)
        if total > most * (1.0 + 1e-9) or (smaller and total >= most * (1.0 - 1e-9)):
            best, most = k, total
    if most == 0.0:
        return 0.0
    mean = votes[best + 1] - votes[best - 1]
    return math.asin((best + 0.5) * wide - math.sin(MOST_TURN) + wide * mean / most)


@kernel
def crossing(one, other):
    """sin and cos of the angle from the normal of one line to that of another."""
    return one.a * other.b - one.b * other.a, one.a * other.a + one.b * other.b


@kernel
def shifted(here, there, motion, reach):
    cos, sin, x, y = motion
    xx = xy = yy = gx = gy = total = 0.0
    for i in range(len(here)):
        ends, normal = moved(here[i], motion), turned(here[i], motion)
        nearest, off = -1, reach
        for j in range(len(there)):
            shared, distance = shared_with(ends, normal, there[j], abs(off))
            if shared > 0.0:
                nearest, off = j, distance
        if nearest >= 0:
            line = there[nearest]
            weight = min(here[i].length, line.length)
            xx, xy, yy = xx + weight * line.a * line.a, xy + weight * line.a * line.b, yy + weight * line.b * line.b
            gx, gy = gx - weight * line.a * off, gy - weight * line.b * off
            total += weight
    if total == 0.0:
        return motion
    xx, yy = xx + 1e-3 * total, yy + 1e-3 * total
    scale = 1.0 / (xx * yy - xy * xy)
    return cos, sin, x + scale * (yy * gx - xy * gy), y + scale * (xx * gy - xy * gx)


@kernel
def moved(segment, motion):
    """(x1, y1, x2, y2) of a segment after the motion."""
    cos, sin, x, y = motion
    return (
        cos * segment.x1 - sin * segment.y1 + x,
        sin * segment.x1 + cos * segment.y1 + y,
        cos * segment.x2 - sin * segment.y2 + x,
        sin * segment.x2 + cos * segment.y2 + y,
    )


@kernel
def turned(segment, motion):
    """The normal (a, b) of a segment's line after the motion."""
    cos, sin, _, _ = motion
    return cos * segment.a - sin * segment.b, sin * segment.a + cos * segment.b


@kernel
def shared_with(ends, normal, other, reach):
    """Length over which a moved segment lies beside another [m], and distance from its middle to the other's line [m].

    The length is 0 if they differ by more than SAME_ANGLE, or the distance is not below `reach`.
    """
    (x1, y1, x2, y2), (a, b) = ends, normal
    distance = signed_distance((other.a, other.b, other.c), 0.5 * (x1 + x2), 0.5 * (y1 + y2))
    if abs(a * other.b - b * other.a) > SAME_ANGLE or not abs(distance) < reach:
        return 0.0, distance
    start, end = other.x1 * other.b - other.y1 * other.a, other.x2 * other.b - other.y2 * other.a
    one, two = x1 * other.b - y1 * other.a, x2 * other.b - y2 * other.a
    return min(max(start, end), max(one, two)) - max(min(start, end), min(one, two)), distance


@kernel
def is_among(segment, others, motion):
    """Whether the others together cover more than half of this segment."""
    ends, normal, held = moved(segment, motion), turned(segment, motion), 0.0
    for j in range(len(others)):
        shared, _ = shared_with(ends, normal, others[j], SAME_DISTANCE)
        if shared > 0.0:
            held += shared
            if 2.0 * held > segment.length:
                return True
    return False
