"""Colours that distinguish segments, also for colour-blind readers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .segment import Segment

# Found by search near Paul Tol's "vibrant" scheme. Each has a contrast of at least 3 : 1 to white and to the dark
# ground, and they stay far apart under the common colour deficiencies. None is red, which means refused, or the pink of
# a point under test.
SEGMENTS = np.array(
    [(39, 86, 240), (218, 117, 0), (21, 116, 95), (132, 96, 42), (13, 155, 220), (216, 0, 168)], dtype=np.uint8
)


def segment_hues(segments: Sequence[Segment]) -> list[int]:
    """Which of SEGMENTS each has: by direction and distance of the line, so that a wall keeps its colour from frame to
    frame.

    A segment never has the colour of either of the two before it.
    """
    chosen: list[int] = []
    for segment in segments:
        turn = segment.theta % (2 * math.pi) / (2 * math.pi)
        wish = round(turn * len(SEGMENTS)) + int(segment.rho / 2)
        while wish % len(SEGMENTS) in chosen[-2:]:
            wish += 1
        chosen.append(wish % len(SEGMENTS))
    return chosen


def segment_colours(segments: Sequence[Segment]) -> NDArray[np.uint8]:
    """(n, 3) sRGB."""
    return SEGMENTS[segment_hues(segments)] if segments else np.empty((0, 3), dtype=np.uint8)
