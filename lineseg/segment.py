"""What an extractor returns: `Segment`, what it dropped, and both together as `Extraction`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray


class Segment(NamedTuple):
    """A line segment and the beams it was fitted to.

    line: (a, b, c) of a·x + b·y + c = 0 with the unit normal (a, b) pointing away from the laser, so that c ≤ 0.
    start, end: endpoints [m], the outermost points projected on the line (Eqs. 7, 8), in the order of the beams.
    first, last: beam indices, inclusive; last < first where the segment crosses the seam of a full-circle scan.
    points: number of valid beams in it; length [m]; rms: root mean square of the distances to the line [m].
    """

    line: tuple[float, float, float]
    start: tuple[float, float]
    end: tuple[float, float]
    first: int
    last: int
    points: int
    length: float
    rms: float

    @property
    def rho(self) -> float:
        """Distance of the line from the laser [m], ≥ 0."""
        return -self.line[2]

    @property
    def theta(self) -> float:
        """Bearing of the foot of the perpendicular from the laser [rad]: x·cos θ + y·sin θ = ρ."""
        return math.atan2(self.line[1], self.line[0])

    def distance(self, xy: NDArray) -> NDArray:
        """Distances of points (…, 2) to the infinite line [m]."""
        a, b, c = self.line
        return np.abs(a * xy[..., 0] + b * xy[..., 1] + c)


class Dropped(NamedTuple):
    """A line that was grown but not kept.

    check: "min_points", "min_length", or "nearer" where an overlapping line is the nearer one for every shared point;
    value: what was measured; limit: what was required, for "nearer" the distance to the other line. length: between
    its outermost points [m].
    """

    first: int
    last: int
    points: int
    length: float
    check: str
    value: float
    limit: float


class Rows(Protocol):
    """The output of a kernel, and how the parts of an `Extraction` are made of it."""

    def segments(self) -> tuple[Segment, ...]: ...
    def labels(self) -> NDArray[np.int32]: ...
    def dropped(self) -> tuple[Dropped, ...]: ...


@dataclass(frozen=True, eq=False)
class Extraction:
    """What a method finds in one scan.

    segments: in scan order, by their first beam. labels: (n,) int32, for each beam the index of its segment, or −1.
    dropped: the candidates that were not kept. method: its name in EXTRACTORS; params: its thresholds.
    """

    method: str
    params: Any
    segments: tuple[Segment, ...]
    labels: NDArray[np.int32]
    dropped: tuple[Dropped, ...]

    @classmethod
    def of_rows(cls, method: str, params: Any, rows: Rows) -> Extraction:
        """The same of a kernel's output; each part is made when it is first asked for."""
        made = cls.__new__(cls)
        made.__dict__.update(method=method, params=params, _rows=rows)
        return made

    def __getattr__(self, name: str) -> Any:
        rows = self.__dict__.get("_rows")
        if rows is None or name not in ("segments", "labels", "dropped"):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)
        return self.__dict__.setdefault(name, getattr(rows, name)())

    @cached_property
    def covered(self) -> int:
        """Number of beams that belong to a segment."""
        return int(np.count_nonzero(self.labels >= 0))
