"""Options for reading plain text files."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal, get_args

Unit = Literal["m", "cm", "mm"]
AngleUnit = Literal["rad", "deg"]
METRES: dict[Unit, float] = {"m": 1.0, "cm": 0.01, "mm": 0.001}


@dataclass(frozen=True)
class TextOptions:
    """How to read a text file of numbers; None: take the value from the file, or guess it if that is safe.

    A file may give these values in comment lines such as `# angle_min = -2.356`.
    """

    angle_min: float | None = None  # bearing of the first beam in a row [rad]
    angle_increment: float | None = None  # angle between beams in a row [rad]
    unit: Unit | None = None  # of the ranges
    skip_columns: int | None = None  # numbers before the ranges in a row
    angle_unit: AngleUnit | None = None  # of a column of angles
    range_min: float | None = None  # shorter ranges are not returns [m]
    range_max: float | None = None  # ranges from this value on are not returns [m]

    def __post_init__(self) -> None:
        for name, allowed in (("unit", get_args(Unit)), ("angle_unit", get_args(AngleUnit))):
            value = getattr(self, name)
            if value is not None and value not in allowed:
                raise ValueError(f"{name} is {value!r}; choose from {', '.join(allowed)}.")
        for name in ("angle_min", "angle_increment"):
            value = getattr(self, name)
            if value is not None and not math.isfinite(value):
                raise ValueError(f"{name} is {value}; it must be a finite number of radians.")
        if self.angle_increment == 0:
            raise ValueError("angle_increment is 0, which would put all beams on one ray; give another value.")
        if self.skip_columns is not None and self.skip_columns < 0:
            raise ValueError(
                f"skip_columns is {self.skip_columns}; a number of columns is never negative, give 0 or more."
            )

    @classmethod
    def names(cls) -> tuple[str, ...]:
        return tuple(entry.name for entry in fields(cls))
