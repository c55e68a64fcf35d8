"""What a method can decide, and the sentence that each decision is told in."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

from .log import Row

Effect = Literal["none", "shown", "stands", "gone", "joined", "parted", "placed"]


class Kind(NamedTuple):
    """A kind of decision of a method.

    effect: what it does to the lines there are. "shown": its candidate is one at this moment only; "stands": from now
    on; "gone": no longer; "joined": it stands and its partner is gone; "parted": it ends before `beam`, where its
    partner begins; "placed": it has its endpoints. jump: by which button of the page it is found: seed (how a line of
    this method begins), line, drop, merge, cut, refusal. text: its sentence, with the fields of `Sentence`; within: the
    sentence where the value is below the limit, if that is another.
    """

    name: str
    phase: str
    effect: Effect
    jump: str
    text: str
    within: str = ""


class Check(NamedTuple):
    """What a decision compares, mostly with a threshold of that name.

    refuses: what it says of a point, a line or a merge that it refuses, with the fields of `Sentence`.
    """

    name: str
    refuses: str = ""


@dataclass(frozen=True)
class Vocabulary:
    """What a method decides, by which checks; a row of its log has numbers of these."""

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
        """The jumps that lead to a decision of this method."""
        return tuple(dict.fromkeys(kind.jump for kind in self.kinds if kind.jump))

    def jump_of(self, kind: str) -> str:
        return self.kinds[self.names.index(kind)].jump


@dataclass(slots=True)
class Sentence:
    """What a decision is told with: the texts of `Kind` and `Check` name these fields and properties.

    first, last, beam: beams. total: the points of the scan. A value prints as {value:m} in metres, as {value:deg} in
    degrees.
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
        """What the check says that refused, with the value, the limit and by how much it was missed."""
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
        """Why there is no further point for a line."""
        if self.points >= self.total:
            return "every point belongs to the line"
        return "the last valid beam is reached" if self.row.direction > 0 else "the first valid beam is reached"

    @property
    def value(self) -> Quantity:
        return Quantity(self.row.value)

    @property
    def limit(self) -> Quantity:
        return Quantity(self.row.limit)

    @property
    def over(self) -> Quantity:
        return Quantity(self.row.value - self.row.limit)

    @property
    def short(self) -> Quantity:
        return Quantity(self.row.limit - self.row.value)


class Quantity(float):
    """A number that prints as metres with the format "m", and from radians as degrees with "deg"."""

    def __format__(self, form: str) -> str:
        if form == "m":
            return metres(self)
        return degrees(self) if form == "deg" else float.__format__(self, form)


def metres(value: float) -> str:
    return f"{value:.3f} m" if math.isfinite(value) else "infinitely far"


def degrees(radians: float) -> str:
    return f"{math.degrees(radians):.1f}°"
