"""Straight walls in the world, each seen from one side."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Walls(NamedTuple):
    """normal: (w, 2), towards the side it was seen from; offset: (w,), normal · p of its points; low, high: (w,) its
    ends, along (−normal_y, normal_x); rms: (w,) [m].
    """

    normal: NDArray[np.float64]
    offset: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    rms: NDArray[np.float64]

    @classmethod
    def of(cls, rows: NDArray[np.float64]) -> Walls:
        """From rows (w, 6) of normal, offset, low, high and rms."""
        return cls(np.ascontiguousarray(rows[:, :2]), *(rows[:, k].copy() for k in range(2, 6)))

    def __len__(self) -> int:
        return len(self.offset)

    @property
    def table(self) -> NDArray[np.float64]:
        """(w, 6) the rows from which `of` makes these walls."""
        return np.column_stack((self.normal, self.offset, self.low, self.high, self.rms))

    @property
    def along(self) -> NDArray[np.float64]:
        return np.column_stack((-self.normal[:, 1], self.normal[:, 0]))

    @property
    def ends(self) -> NDArray[np.float64]:
        """(w, 4) x1, y1, x2, y2 [m]."""
        foot = self.normal * self.offset[:, None]
        return np.hstack((foot + self.along * self.low[:, None], foot + self.along * self.high[:, None]))

    def only(self, kept: NDArray) -> Walls:
        return Walls(*(field[kept] for field in self))
