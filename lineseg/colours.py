"""Colours that distinguish segments, also for colour-blind readers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .segment import Segment

# After Paul Tol's "vibrant" scheme, which keeps apart under the common colour deficiencies.
SEGMENTS = np.array(
    [(0, 119, 187), (238, 119, 51), (0, 153, 136), (204, 51, 17), (51, 187, 238), (238, 51, 119)], dtype=np.uint8
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
