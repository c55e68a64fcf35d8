"""The kinds of decisions of a method, and the sentence for each."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .log import Row

# Digits of metres after the point.
MILLIMETRES, MICROMETRES = 3, 6

Effect = Literal["none", "shown", "stands", "gone", "joined", "parted", "placed"]


class Kind(NamedTuple):
    """A kind of decision of a method.

    effect: how it changes the set of lines. "shown": its candidate is a line at this moment only; "stands": from now
    on; "gone": no longer; "joined": it stays and its partner is removed; "parted": it ends before `beam`, where its
    partner starts; "placed": it gets its endpoints. jump: the button of the page that finds it: seed (how a line of
    this method starts), line, drop, merge, cut, refusal. text: its sentence, with fields of `Sentence`; within: a
    different sentence for a value below the limit, if needed.
    """

    name: str
    phase: str
    effect: Effect
    jump: str
    text: str
    within: str = ""


class Check(NamedTuple):
    """A comparison in a decision, usually with a threshold of the same name.

    refuses: its sentence about a refused point, line or merge, with fields of `Sentence`.
    """

    name: str
    refuses: str = ""


@dataclass(frozen=True)
class Vocabulary:
    """The kinds and checks of a method; rows of its log contain their numbers."""

    kinds: tuple[Kind, ...]
    checks: tuple[Check, ...]

    @cached_property
    def names(self) -> tuple[str, ...]:
        return tuple(kind.name for kind in self.kinds)

    @cached_property
    def check_names(self) -> tuple[str, ...]:
        return tuple(check.name for check in self.checks)

    @cached_property
    def phases(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(kind.phase for kind in self.kinds))

    @cached_property
    def jumps(self) -> tuple[str, ...]:
        """The jumps for which this method has decisions."""
        return tuple(dict.fromkeys(kind.jump for kind in self.kinds if kind.jump))

    @cached_property
    def leads_to(self) -> dict[str, NDArray[np.bool_]]:
        """For each jump, (kinds,) which decisions it leads to."""
        return {jump: np.array([kind.jump == jump for kind in self.kinds]) for jump in self.jumps}

    @cached_property
    def phase_of_kind(self) -> NDArray[np.int64]:
        """(kinds,) the index of each kind's phase."""
        return np.array([self.phases.index(kind.phase) for kind in self.kinds], np.int64)

    def jump_of(self, kind: str) -> str:
        return self.kinds[self.names.index(kind)].jump


@dataclass(slots=True)
class Sentence:
    """The fields and properties for the texts of `Kind` and `Check`.

    first, last, beam: beams. total: number of points of the scan. Write {value:m} for metres, {value:deg} for degrees.
    """

    row: Row
    kind: Kind
    check: Check
    first: int
    last: int
    beam: int
    total: int

    def __str__(self) -> str:
        below = self.kind.within and self.row.value < self.row.limit
        return (self.kind.within if below else self.kind.text).format_map(self)

    def __getitem__(self, field: str) -> Any:
        return getattr(self, field)

    @property
    def refusal(self) -> str:
        """The sentence of the check that refused, with the value, the limit and the difference."""
        return self.check.refuses.format_map(self)

    @property
    def span(self) -> str:
        return f"beams {self.first}–{self.last}"

    @property
    def points(self) -> int:
        return self.row.points

    @property
    def way(self) -> str:
        return "forward" if self.row.direction > 0 else "backward"

    @property
    def edge(self) -> str:
        """Why a line has no next point."""
        if self.points >= self.total:
            return "every point belongs to the line"
        return "the last valid beam is reached" if self.row.direction > 0 else "the first valid beam is reached"

    @property
    def value(self) -> Quantity:
        return self._quantity(self.row.value)

    @property
    def limit(self) -> Quantity:
        return self._quantity(self.row.limit)

    @property
    def over(self) -> Quantity:
        return self._quantity(self.row.value - self.row.limit)

    @property
    def short(self) -> Quantity:
        return self._quantity(self.row.limit - self.row.value)

    def _quantity(self, number: float) -> Quantity:
        return Quantity(number, _digits_that_tell(self.row.value, self.row.limit))


class Quantity(float):
    """A number that the format "m" prints as metres, and "deg" prints as degrees, converted from radians.

    digits: after the point, of metres.
    """

    digits: int

    def __new__(cls, number: float, digits: int = MILLIMETRES) -> Quantity:
        quantity = super().__new__(cls, number)
        quantity.digits = digits
        return quantity

    def __format__(self, form: str) -> str:
        if form == "m":
            return metres(self, self.digits)
        return degrees(self) if form == "deg" else float.__format__(self, form)


def _digits_that_tell(value: float, limit: float) -> int:
    """So many that a value that is refused does not look like its limit."""
    apart = abs(value - limit)
    if not 0.0 < apart < 0.0005:
        return MILLIMETRES
    return min(math.ceil(-math.log10(apart)), MICROMETRES)


def metres(value: float, digits: int = MILLIMETRES) -> str:
    return f"{value:.{digits}f} m" if math.isfinite(value) else "infinitely far"


def degrees(radians: float) -> str:
    return f"{math.degrees(radians):.1f}°"
