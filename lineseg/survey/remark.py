"""One thing that looks wrong in a frame."""

from __future__ import annotations

from dataclasses import dataclass

Ghost = tuple[float, float, float, float]


@dataclass(frozen=True)
class Remark:
    """One thing that looks wrong. score: the name of its score; first, last: the beams concerned, or −1.

    doubt: how far the score stands out, times its weight; see suspicion.py. ghosts: x1, y1, x2, y2 [m] of the lines
    that it speaks of and that the frame lacks, in the frame of the laser.
    """

    score: str
    text: str
    first: int = -1
    last: int = -1
    doubt: float = 0.0
    ghosts: tuple[Ghost, ...] = ()
